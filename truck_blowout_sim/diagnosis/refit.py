"""Fit one hypothesis nonlinearly: Gauss-Newton on its amount, nuisances projected out.

The nuisance sensitivities stay those of the reference; only the hypothesis itself is simulated
anew. Several starts where the effect is curved.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.attribute import Ranked, with_effects
from truck_blowout_sim.diagnosis.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.linear import Projector, score
from truck_blowout_sim.diagnosis.study import Study

Floats = NDArray[np.float64]
_ROUNDS = 6
_ENOUGH = 0.02  # of a standard error: the amount has converged
_SHEET = 2.0  # prior sigmas a truck of the kind may stray
_STEP_SHARE = 0.15  # of the amount, lower bound of the finite difference


def models_at(study: Study, hypotheses: Sequence[Hypothesis], named: Sequence[Hypothesis]
              ) -> list[dict[int, Floats]]:
    """Training models under each hypothesis, on top of those already named."""
    jobs = [(study.runs[i], h.apply(with_effects(
        study.packed, named, study.runs[i].recording.name), study.runs[i].recording.name))
        for h in hypotheses for i in study.train]
    results = study.simulate(jobs)
    n = len(study.train)
    return [dict(zip(study.train, results[k * n:(k + 1) * n], strict=True))
            for k in range(len(hypotheses))]


def chi2_of(study: Study, projector: Projector, models: Mapping[int, Floats]) -> float:
    """Sum of squares with some runs' models replaced, nuisances refitted."""
    return projector.chi2(study.residual(models))


def refit(study: Study, start: Ranked, chi2_null: float,
          named: Sequence[Hypothesis] = ()) -> Ranked:
    """The hypothesis at its best amount; calibration numbers that mean the same are held."""
    projector = study.projector([*named, start.hypothesis])
    amount = start.hypothesis.effect.amount
    tries = sorted({float(np.clip(a, amount.low, amount.high))
                    for a in (start.hypothesis.amount, *amount.grid)})
    models = models_at(study, [start.hypothesis.at(a) for a in tries], named)
    falls = [chi2_null - chi2_of(study, projector, m) for m in models]
    best = int(np.argmax(falls))
    value, fall, model = tries[best], falls[best], models[best]
    sigma = start.sigma
    for _ in range(_ROUNDS):
        step = _step(amount.step, value, amount.low, amount.high)
        ahead = models_at(study, [start.hypothesis.at(value + step)], named)[0]
        column = study.stack({i: study.runs[i].change(ahead[i], model[i]) for i in study.train})
        residual = study.residual(model)
        found = score(projector, residual, projector.remove(residual), column / step,
                      amount.low - value, amount.high - value)
        sigma = found.sigma
        value, fall, model, moved = _advance(study, projector, start.hypothesis, named, chi2_null,
                                             value, found.amount, fall, model)
        if moved <= _ENOUGH * sigma:
            break
    evidence = fall + _strayed(study, start.hypothesis, named, chi2_null)
    return Ranked(start.hypothesis.at(value), fall, sigma, refitted=True, evidence=evidence)


def _strayed(study: Study, hypothesis: Hypothesis, named: Sequence[Hypothesis],
             chi2_null: float) -> float:
    """How much worse the null gets if the number this effect stands for stays within the sheet.

    A calibration number far beyond its prior is the effect under another name, not the truck.
    """
    plain, kept = study.projector(named), study.kept(named)
    meaning = study.meaning(hypothesis)
    places = [k for k, j in enumerate(kept) if study.names[j] == meaning]
    if not places:
        return 0.0
    residual = study.residual()
    usual = study.expected(meaning)
    amount = float(np.clip(plain.amounts(residual)[places[0]], usual - _SHEET, usual + _SHEET))
    column = study.columns[:, kept[places[0]]]
    held = study.projector([*named, hypothesis]).chi2(residual - amount * column) + amount**2
    return max(held - chi2_null, 0.0)


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


def _step(base: float, value: float, low: float, high: float) -> float:
    """Finite difference that stays inside the bounds."""
    step = np.sign(base) * max(abs(base) * 0.3, _STEP_SHARE * abs(value))
    if not low <= value + step <= high:
        step = -step
    return float(step)
