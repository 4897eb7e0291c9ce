"""Fit one hypothesis nonlinearly: Gauss-Newton on its amount, nuisances projected out.

The nuisance sensitivities stay those of the reference; only the hypothesis itself is simulated
anew. Several starts where the effect is curved.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.algebra.linear import Projector, score
from truck_blowout_sim.diagnosis.case.study import Study, row_ranges
from truck_blowout_sim.diagnosis.effects.base import Amount
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.models import jobs_with, models_at
from truck_blowout_sim.diagnosis.fit.ranked import Ranked

Floats = NDArray[np.float64]
_ROUNDS = 6
_ENOUGH = 0.02  # of a standard error: the amount has converged
_SHEET = 2.0  # prior sigmas a truck of the kind may stray
_SHEET_POINTS = 5  # amounts of it that are simulated
_STEP_SHARE = 0.15  # of the amount: finite difference
_STEP_LEAST = 0.3  # of an amount's step: at least so much, where the amount may be 0


def chi2_of(study: Study, projector: Projector, models: Mapping[int, Floats]) -> float:
    """Sum of squares with some runs' models replaced, nuisances refitted."""
    return projector.chi2(study.residual(models))


def chi2_with_each(study: Study, projector: Projector, models: Mapping[int, Floats], i: int,
                   trials: Sequence[Floats]) -> Floats:
    """:func:`chi2_of` with each of several models of one run ``i`` besides ``models``."""
    rows, residual = row_ranges(study)[i], study.residual(models)
    others = residual.copy()
    others[rows] = 0.0
    each = np.stack([study.runs[i].residual(trial) for trial in trials], axis=1)
    common = projector.reach(others)[:, None] + projector.reach(each, rows)
    squares = others @ others + np.einsum("rk,rk->k", each, each)
    return np.asarray(squares - np.einsum("ck,ck->k", common, projector.solve(common)))


def refit(study: Study, start: Ranked, chi2_null: float,
          named: Sequence[Hypothesis] = ()) -> Ranked:
    """The hypothesis at its best amount; calibration numbers that mean the same are held."""
    projector = study.projector([*named, start.hypothesis])
    chi2_null -= start.hypothesis.shape_cost
    amount = start.hypothesis.effect.amount
    tries = sorted({float(np.clip(a, amount.low, amount.high))
                    for a in (start.hypothesis.amount, *amount.grid)})
    models = models_at(study, [start.hypothesis.at(a) for a in tries], named)
    falls = [chi2_null - chi2_of(study, projector, m) for m in models]
    best = int(np.argmax(falls))
    value, fall, model = tries[best], falls[best], models[best]
    sigma = start.sigma
    for _ in range(_ROUNDS):
        step = difference_step(amount, value)
        ahead = models_at(study, [start.hypothesis.at(value + step)], named)[0]
        column = study.stack({i: study.runs[i].change(ahead[i], model[i]) for i in study.train})
        residual = study.residual(model)
        found = score(projector, projector.remove(residual), column / step,
                      amount.low - value, amount.high - value)
        sigma = found.sigma
        value, fall, model, moved = _advance(study, projector, start.hypothesis, named, chi2_null,
                                             value, found.amount, fall, model)
        if moved <= _ENOUGH * sigma:
            break
    beyond = _beyond_sheet(study, start.hypothesis, named, chi2_null - fall)
    evidence = fall if beyond is None else beyond
    return Ranked(start.hypothesis.at(value), fall, sigma, refitted=True, evidence=evidence)


def _beyond_sheet(study: Study, hypothesis: Hypothesis, named: Sequence[Hypothesis],
                  chi2_with: float) -> float | None:
    """What the effect buys against a truck whose own number of this meaning keeps to its sheet.

    A calibration number far beyond its prior is the effect under another name, not the truck; one
    within it is the truck. Both are simulated, because far from the reference neither is linear.
    None where no number of that meaning is open.
    """
    name = study.meaning(hypothesis)
    if name not in study.names or name not in study.amounts:
        return None
    column, here = study.columns[:, study.names.index(name)], study.amounts[name]
    nuisance = next(n for n in study.settings.nuisances if n.name == name)
    # usual is the sheet, and what baseline runs seem to show, though they do not determine it
    usual = (0.0, study.expected(name))
    amounts = np.linspace(min(usual) - _SHEET, max(usual) + _SHEET, _SHEET_POINTS)
    trucks = [study.packed.unchecked(nuisance.values(study.packed, nuisance.between(here, a)))
              for a in amounts.tolist()]
    runs = range(len(study.runs))
    results = iter(study.simulate([job for truck in trucks
                                   for job in jobs_with(study, truck, named)]))
    projector = study.projector([*named, hypothesis])
    # the runs were shifted by what the columns say of the reference: its own number comes twice
    sums = np.array([
        projector.chi2(study.residual({i: next(results) for i in runs}) - here * column)
        + amount**2 for amount in amounts.tolist()])
    return max(_valley(sums) - chi2_with, 0.0)


def _valley(sums: Floats) -> float:
    """Least of a smooth function sampled evenly: of the parabola about the least sample."""
    k = int(np.clip(np.argmin(sums), 1, sums.size - 2))
    before, here, after = sums[k - 1:k + 2]
    bend = 0.5 * (before + after) - here
    if bend <= 0.0:
        return float(np.min(sums))
    at = float(np.clip(0.25 * (before - after) / bend, -1.0, 1.0))
    return float(min(here + 0.5 * (after - before) * at + bend * at * at, np.min(sums)))


def _advance(study: Study, projector: Projector, hypothesis: Hypothesis,
             named: Sequence[Hypothesis], chi2_null: float, value: float, move: float,
             fall: float, model: dict[int, Floats]
             ) -> tuple[float, float, dict[int, Floats], float]:
    """Take the step, or half, or a quarter, whichever first lowers the sum of squares."""
    for share in (1.0, 0.5, 0.25):
        trial = value + share * move
        models = models_at(study, [hypothesis.at(trial)], named)[0]
        gain = chi2_null - chi2_of(study, projector, models)
        if gain > fall:
            return trial, gain, models, abs(share * move)
    return value, fall, model, 0.0


def least_step(amount: Amount, value: float) -> float:
    """Finite difference that is never too small, without a sign.

    What is always positive, as a hole, is changed by a share of it: its sizes differ by decades.
    """
    return _STEP_SHARE * abs(value) if amount.low > 0.0 else _STEP_LEAST * abs(amount.step)


def difference_step(amount: Amount, value: float) -> float:
    """Finite difference that stays inside the bounds."""
    least = max(least_step(amount, value), _STEP_SHARE * abs(value))
    step = float(np.sign(amount.step)) * least
    return step if amount.low <= value + step <= amount.high else -step
