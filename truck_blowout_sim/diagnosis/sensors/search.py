"""Which faults there are: one after another, each tested against all others.

A fault is accepted if dropping its prior (its normal size) lowers the sum of squares by more than
chance would, over all candidates together, and never if another accepted fault already explains
the same, nor if one that was refused explains more. Candidates that do almost as well as the
accepted one are its aliases.

References: forward selection with backward check; family-wise error by Bonferroni.
Validated with: test/diagnosis/test_sensors_gate.py (power, naming, false alarms).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import permutations

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.sensors.case import Applied, Case, Hypothesis, with_amounts
from truck_blowout_sim.diagnosis.sensors.judgement import (
    ALIAS_CHI2,
    ALIAS_SHARE,
    CLEAR,
    FALSE_ALARMS,
    admissible,
    determined,
    family_p,
    handicap,
)
from truck_blowout_sim.diagnosis.sensors.reversal import made_by_noise
from truck_blowout_sim.diagnosis.sensors.solve import (
    Estimate,
    in_full,
    noise_inflation,
    refine,
    slices_of,
    solve,
)
from truck_blowout_sim.diagnosis.sensors.steady import chances, independent_candidates
from truck_blowout_sim.diagnosis.sensors.system import System, assemble, normal_equations

FloatArray = NDArray[np.float64]
Amounts = Sequence[tuple[float, ...]]

_FAMILY_P = 1e-4
_MOST_FAULTS = 5
_MOST_REFUSED = 3  # each costs a nonlinear fit; the next is rarely better than the first
_FORBIDDEN = 1e9
_LEADERS = 4
_WORTH_A_LOOK = 0.5  # share of the leader's linear gain that earns a nonlinear try


@dataclass(frozen=True)
class Found:
    """An accepted fault.

    Attributes:
        hypothesis: what and where.
        amounts: of its parameters.
        covariance: of its parameters, all else free.
        delta_chi2: rise of the sum of squares without it, everything else re-estimated.
        p_value: chance of that anywhere among the candidates.
        rivals: other hypotheses that do as well, best first, with their sums of squares above it.
    """

    hypothesis: Hypothesis
    amounts: tuple[float, ...]
    covariance: FloatArray
    delta_chi2: float
    p_value: float
    rivals: tuple[tuple[Hypothesis, float], ...]


@dataclass(frozen=True)
class SearchResult:
    """Accepted faults and what is left.

    Attributes:
        found: strongest first.
        before: system as measured.
        after: system with the faults taken out.
        inflation: noise factor by identity with the faults taken out.
        chi2: penalised sum of squares that is left, with ``rows`` rows.
        rows: number of rows.
        usual: estimates of the normal imperfections.
        usual_in_baseline: the same in the baseline recordings.
        usual_sigma: standard errors of ``usual``.
    """

    found: tuple[Found, ...]
    before: System
    after: System
    inflation: Mapping[str, float]
    chi2: float
    rows: int
    usual: FloatArray
    usual_in_baseline: FloatArray
    usual_sigma: FloatArray


@dataclass(frozen=True, eq=False)
class _Best:
    """The hypothesis that explains most of what is left, beside what was chosen.

    Attributes:
        estimate: of all faults together; ``chi2``: its sum of squares, handicap included.
        room: within which others explain as much; ``near``: those, best first.
    """

    hypothesis: Hypothesis
    estimate: Estimate
    chi2: float
    room: float
    near: tuple[tuple[Hypothesis, float], ...]


def search(case: Case, false_alarms: float = FALSE_ALARMS) -> SearchResult:
    """Find the sensor faults of a case.

    Args:
        case: the recordings.
        false_alarms: share of sound logs in which anything may be named.
    """
    before = system = assemble(case)
    chosen: list[Hypothesis] = []
    refused: list[Hypothesis] = []
    rivals: dict[Hypothesis, tuple[tuple[Hypothesis, float], ...]] = {}
    inflation = noise_inflation(before)
    normal = normal_equations(before, inflation)
    estimate = solve(case, normal, ())
    highest = false_alarms / independent_candidates(case, normal)
    most = np.inf  # sum of squares of what explains as much as a hypothesis that was refused
    while len(chosen) < _MOST_FAULTS and len(refused) < _MOST_REFUSED:
        best = _next(case, system, chosen, refused, estimate, inflation)
        if best is None or best.chi2 > most:
            break
        hypothesis, tried = best.hypothesis, best.estimate
        rivals[hypothesis] = best.near
        trial = [*chosen, hypothesis]
        cleaned = assemble(case, with_amounts(trial, tried.amounts))
        scatter = noise_inflation(cleaned)
        kept, refined = _pruned(case, trial, tried, scatter, highest)
        if hypothesis in kept:
            chosen, estimate, system, inflation = kept, refined, cleaned, scatter
            most = np.inf
        else:  # as before it was tried
            refused.append(hypothesis)
            most = min(most, best.chi2 + best.room)
    sound = _sound_in_training(chosen, estimate)
    if len(sound) < len(chosen):
        amounts = [estimate.amounts[chosen.index(h)] for h in sound]
        cleaned = assemble(case, with_amounts(sound, amounts))
        chosen, estimate = sound, refine(case, sound, noise_inflation(cleaned), amounts)
    return _summary(case, chosen, rivals, before, estimate)


def _next(
    case: Case, system: System, chosen: Sequence[Hypothesis], refused: Sequence[Hypothesis],
    found: Estimate, inflation: Mapping[str, float],
) -> _Best | None:  # fmt: skip
    """The best further hypothesis; ``None`` if none counts."""
    normal = normal_equations(system, inflation)
    base = solve(case, normal, chosen)
    scored: list[tuple[float, int, Hypothesis]] = []
    starts: dict[Hypothesis, Amounts] = {}
    for order, hypothesis in enumerate(case.hypotheses):
        if hypothesis in chosen or hypothesis in refused:
            continue
        trial = solve(case, normal, [*chosen, hypothesis])
        gain = base.chi2 - trial.chi2
        size = len(hypothesis.distortion.parameters)
        significant = family_p(gain, size, len(case.hypotheses)) < _FAMILY_P
        if significant and admissible(hypothesis, trial.amounts[-1]):
            scored.append((handicap(case, hypothesis) - gain, order, hypothesis))
            # with nothing taken out yet, this trial is the first step of the nonlinear fit
            starts[hypothesis] = [*found.amounts, (0.0,) * size] if chosen else trial.amounts
    if not scored:
        return None
    scored.sort()
    return _refined_best(case, scored, chosen, starts, inflation, base.chi2)


def _refined_best(
    case: Case, scored: Sequence[tuple[float, int, Hypothesis]], chosen: Sequence[Hypothesis],
    starts: Mapping[Hypothesis, Amounts], inflation: Mapping[str, float], without: float,
) -> _Best:  # fmt: skip
    """Compare the leaders at their own nonlinear optimum; the linear score ranks the rest.

    ``without``: sum of squares without any of them.
    """
    linear = {h: score for score, _, h in scored}
    close = [h for score, _, h in scored if score < _WORTH_A_LOOK * scored[0][0]]
    short = leaders_of_each_kind([h for _, _, h in scored], len(close))
    exact: dict[Hypothesis, float] = {}
    estimates: dict[Hypothesis, Estimate] = {}
    for hypothesis in short:
        estimates[hypothesis] = refine(case, [*chosen, hypothesis], inflation, starts[hypothesis])
        exact[hypothesis] = estimates[hypothesis].chi2 + handicap(case, hypothesis)
        if not admissible(hypothesis, estimates[hypothesis].amounts[-1]):
            exact[hypothesis] += _FORBIDDEN
    best = min(exact, key=lambda h: exact[h])
    above = {h: value - exact[best] for h, value in exact.items() if h != best}
    for hypothesis in close:
        if hypothesis not in exact:
            above[hypothesis] = max(0.0, linear[hypothesis] - linear[best])
    room = max(ALIAS_CHI2, ALIAS_SHARE * (without - exact[best]))
    near = sorted((v, i, h) for i, (h, v) in enumerate(above.items()) if v <= room)
    return _Best(best, estimates[best], exact[best], room, tuple((h, v) for v, _, h in near))


def leaders_of_each_kind(ranked: Sequence[Hypothesis], close: int) -> list[Hypothesis]:
    """The leaders among the ``close`` first, and the first of each other kind of fault.

    A delay that is long against the motion gains little in its first, linear step.
    """
    short = list(ranked[:min(close, _LEADERS)])
    for hypothesis in ranked:
        if hypothesis.distortion.name not in {one.distortion.name for one in short}:
            short.append(hypothesis)
    return short


def _pruned(
    case: Case, chosen: Sequence[Hypothesis], estimate: Estimate,
    inflation: Mapping[str, float], highest: float,
) -> tuple[list[Hypothesis], Estimate]:  # fmt: skip
    """Drop, weakest first, what later faults, true noise or its own scatter make insignificant."""
    kept = list(chosen)
    estimate = refine(case, kept, inflation, estimate.amounts)
    while kept:
        gains = [_gain(kept, estimate, k) for k in range(len(kept))]
        wander = chances(case, kept, estimate.amounts, inflation)
        doubtful = [
            not admissible(h, _stated(kept, estimate, k))
            or family_p(g, len(h.distortion.parameters), len(case.hypotheses)) >= _FAMILY_P
            or wander[k] > highest
            for k, (h, g) in enumerate(zip(kept, gains, strict=True))
        ]
        if not any(doubtful):
            doubtful = made_by_noise(case, kept, estimate.amounts, inflation)
        if not any(doubtful):
            break
        weakest = int(np.argmin([g if d else np.inf for g, d in zip(gains, doubtful, strict=True)]))
        amounts = [a for k, a in enumerate(estimate.amounts) if k != weakest]
        del kept[weakest]
        estimate = refine(case, kept, inflation, amounts)
    return kept, estimate


def _sound_in_training(chosen: Sequence[Hypothesis], estimate: Estimate) -> list[Hypothesis]:
    """Without what acts in all runs and is undone in training: then only baseline runs have it."""
    undone: set[Hypothesis] = set()
    for i, j in permutations(range(len(chosen)), 2):
        if chosen[i].distortion == chosen[j].distortion and chosen[i].everywhere:
            (one, a), (other, b) = (part(chosen, estimate, k) for k in (i, j))
            if not np.any(np.abs(one + other) > CLEAR * np.sqrt(np.diag(a) + np.diag(b))):
                undone |= {chosen[i], chosen[j]}
    return [h for h in chosen if h not in undone]


def _stated(chosen: Sequence[Hypothesis], estimate: Estimate, which: int) -> list[float]:
    """Amounts of one fault that the answer would state, zero for those that it would not."""
    amounts, covariance = part(chosen, estimate, which)
    shown = determined(amounts.tolist(), np.sqrt(np.diag(covariance)))
    return [float(a) if k in shown else 0.0 for k, a in enumerate(amounts)]


def _gain(chosen: Sequence[Hypothesis], estimate: Estimate, which: int) -> float:
    """Rise of the sum of squares without one fault (Wald: all else re-estimated)."""
    amounts, covariance = part(chosen, estimate, which)
    return float(amounts @ np.linalg.solve(covariance, amounts))


def part(
    chosen: Sequence[Hypothesis], estimate: Estimate, which: int
) -> tuple[FloatArray, FloatArray]:
    """Amounts of one fault and their covariance."""
    own = slices_of(chosen)[which]
    return np.array(estimate.amounts[which]), estimate.covariance[own, own]


def _summary(
    case: Case, chosen: Sequence[Hypothesis],
    rivals: Mapping[Hypothesis, tuple[tuple[Hypothesis, float], ...]],
    before: System, estimate: Estimate,
) -> SearchResult:  # fmt: skip
    after = assemble(case, with_amounts(chosen, estimate.amounts))
    inflation = noise_inflation(after)
    normal = normal_equations(after, inflation)
    final = solve(case, normal, chosen)
    final = replace(final, amounts=estimate.amounts,
                    covariance=in_full(chosen, estimate.amounts, final))  # fmt: skip
    found = []
    for k, hypothesis in enumerate(chosen):
        amounts, covariance = part(chosen, final, k)
        gain = _gain(chosen, final, k)
        p_value = family_p(gain, amounts.size, len(case.hypotheses))
        found.append(
            Found(hypothesis, final.amounts[k], covariance, gain, p_value,
                  rivals.get(hypothesis, ()))
        )  # fmt: skip
    order = sorted(found, key=lambda f: -f.delta_chi2)
    return SearchResult(
        tuple(order), before, after, inflation, final.chi2, normal.count, final.usual,
        final.usual_in_baseline, final.usual_sigma,
    )  # fmt: skip


def applied(found: Sequence[Found]) -> tuple[Applied, ...]:
    """Found faults as amounts to take out."""
    return tuple(Applied(f.hypothesis, f.amounts) for f in found)
