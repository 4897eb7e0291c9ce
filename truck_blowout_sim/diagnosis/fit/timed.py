"""Effects that begin at an instant: find the instant in each run, then the amount.

Linear first: the response to the effect switched on at each grid time is simulated once; for a
pulse the responses to short windows add up. Then the instants are refined by simulation. What is
far from linear in its amount, as a loss of grip, begins where simulations of several amounts at
each grid time explain most.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_solve

from truck_blowout_sim.diagnosis.algebra.linear import Projector, score
from truck_blowout_sim.diagnosis.case.study import Study, row_ranges
from truck_blowout_sim.diagnosis.effects import Effect
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.begun import Begun, begun_everywhere
from truck_blowout_sim.diagnosis.fit.beside import Beside
from truck_blowout_sim.diagnosis.fit.instants import bins_between, grid_of, spacing_s
from truck_blowout_sim.diagnosis.fit.models import models_at, with_effects
from truck_blowout_sim.diagnosis.fit.ranked import Ranked
from truck_blowout_sim.diagnosis.fit.refit import chi2_of, chi2_with_each
from truck_blowout_sim.diagnosis.fit.seconds import responses, windows_of
from truck_blowout_sim.diagnosis.fit.stretches import of_stretches, parts_of, stretches
from truck_blowout_sim.diagnosis.fit.telling import hides_forces
from truck_blowout_sim.diagnosis.result.parts import Place

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
_REFINE_S = (0.5, 0.25, 0.12)
_SWEEPS = 6  # at most, until no run's instant moves
_SHOWN = 4.0  # of the sum of squares, two standard errors: below it a run has no event
_DIM = 1e-12  # information on an amount: less shows nothing


def scan(study: Study, projector: Projector, effect: Effect, place: Place, begun: Begun,
         beside: Beside | None = None) -> Ranked:
    """Best instants on the grid in all training runs, the common amount, and its support.

    Args:
        study: the case.
        projector: removes the nuisances.
        effect: the event.
        place: where it acts.
        begun: bin means with one step of its amount begun at each instant (`begun_everywhere`).
        beside: what is in force, to ask the unseen runs too whether they show such an event.
    """
    removed = projector.remove(study.residual())
    support = unseen = 0.0
    if effect.adds_up:
        windows = windows_of(study, projector, effect, place, begun, beside)
        support = windows.support()
        if support > 0.0 and beside is not None and any(map(hides_forces, beside.named)):
            # both: where fewer seconds tell, those that do may agree by chance
            telling = windows_of(study, projector, effect, place, begun, beside, telling=True)
            told = telling.support()
            if told < support:
                windows, support = telling, told
        if support > 0.0 and windows.unseen.any():
            unseen = support - windows.without_unseen.support()
    shown = {i: _Shown.of(study, projector, effect, i, begun, removed) for i in study.train}
    best = max((_best_of_sign(study, projector, effect, place, shown, removed, sign)
                for sign in (1.0, -1.0)), key=lambda found: found.delta)
    return replace(best, support=support, unseen=unseen)


@dataclass(frozen=True, eq=False)
class _Shown:
    """What one run shows of an event in each stretch of it.

    Attributes:
        grid: instants; ``matrix`` [rows, instants] the whitened response to each.
        first, end: of each stretch; ``slope`` and ``information`` of its amount.
    """

    grid: Floats
    matrix: Floats
    first: Integers
    end: Integers
    slope: Floats
    information: Floats

    @staticmethod
    def of(study: Study, projector: Projector, effect: Effect, i: int,
           begun: Begun, removed: Floats) -> _Shown:
        """From the bin means with the event begun at each instant, nuisances removed."""
        rows = row_ranges(study)[i]
        grid, single = _responses(study, effect, i, begun)
        matrix = np.stack(single, axis=1)
        reach = projector.reach(matrix, rows)
        gram = matrix.T @ matrix - reach.T @ cho_solve(projector.factor, reach)
        apart_s = float(grid[1] - grid[0]) if grid.size > 1 else 0.0
        first, end = stretches(effect.timing, grid.size, apart_s=apart_s)
        slope, information = of_stretches(effect.timing, matrix.T @ removed[rows], gram, first, end)
        return _Shown(grid, matrix, first, end, slope, information)


def _best_of_sign(study: Study, projector: Projector, effect: Effect, place: Place,
                  shown: Mapping[int, _Shown], removed: Floats, sign: float) -> Ranked:
    """Choose the instants for a positive or a negative amount, run by run, then join them."""
    low = max(effect.amount.low, 0.0) if sign > 0 else effect.amount.low
    high = effect.amount.high if sign > 0 else min(effect.amount.high, 0.0)
    times: dict[str, tuple[float, float]] = {}
    total: Floats = np.zeros(removed.size)
    for i in study.train:
        run = study.runs[i]
        delta, span, column = _best_span(effect, shown[i], spacing_s(run), low, high)
        if delta > _SHOWN:
            times[run.recording.name] = span
            total = total + study.stack({i: column})
    found = score(projector, removed, total, low, high)
    return Ranked(Hypothesis(effect, place, found.amount, times), found.delta, found.sigma,
                  evidence=found.delta)


def _responses(study: Study, effect: Effect, i: int, begun: Begun
               ) -> tuple[Floats, list[Floats]]:
    """Instants in one run, and the whitened response per unit of the amount to each."""
    run = study.runs[i]
    models = [begun[i, k] for k in range(grid_of(run, effect).size)]
    delays = bins_between(effect, run, study.settings.bin_s)
    times, found = zip(*responses(study, effect, run, study.models[i], models, delays),
                        strict=True)
    return np.array(times), list(found)


def _best_span(effect: Effect, shown: _Shown, apart_s: float, low: float, high: float
               ) -> tuple[float, tuple[float, float], Floats]:
    """Best instant, or interval of what ends or grows, in one run."""
    grid, first, end, slope = shown.grid, shown.first, shown.end, shown.slope
    seen = shown.information > _DIM
    amount = np.clip(slope / np.where(seen, shown.information, 1.0), low, high)
    fall = np.where(seen, 2.0 * amount * slope - amount**2 * shown.information, 0.0)
    k = int(np.argmax(fall))
    if fall[k] <= 0.0:
        return 0.0, (float(grid[0]), np.inf), shown.matrix[:, 0]
    span = (float(grid[first[k]]), effect.end_s(float(grid[end[k] - 1]), apart_s))
    parts = shown.matrix[:, first[k]:end[k]].sum(axis=1)
    return float(fall[k]), span, parts * parts_of(effect.timing, first, end)[k]


def refine_times(study: Study, start: Ranked, chi2_null: float,
                 named: Sequence[Hypothesis] = ()) -> Ranked:
    """Move each run's instants by simulation, coarse to fine, at the present amount."""
    projector = study.projector([*named, start.hypothesis])
    best = start.hypothesis
    chi2_null -= best.shape_cost
    models = models_at(study, [best], named)[0]
    fall = chi2_null - chi2_of(study, projector, models)
    for width in _REFINE_S:
        for i in study.train:
            name = study.runs[i].recording.name
            if name not in best.times:
                continue
            trials = _moved(best, name, width)
            truck = with_effects(study.packed, named, name)
            results = study.simulate([study.job(study.runs[i], truck, t) for t in trials])
            falls = chi2_null - chi2_with_each(study, projector, models, i, results)
            k = int(np.argmax(falls))
            if falls[k] > fall:
                best, fall = trials[k], falls[k]
                models[i] = results[k]
    return Ranked(best, fall, start.sigma, refitted=True,
                  evidence=fall + start.evidence - start.delta)


def simulated_starts(study: Study, start: Ranked, chi2_null: float,
                     named: Sequence[Hypothesis] = ()) -> list[Ranked]:
    """Where to begin with an event that is far from linear in its amount, best first.

    For each amount of the effect's grid, the best instants by simulation. Without one that explains
    more, ``start`` alone.
    """
    event = start.hypothesis
    projector = study.projector([*named, event])
    tries = at_best_instants(study, [event.at(amount) for amount in event.effect.amount.grid],
                             named)
    models = models_at(study, [event, *tries], named)
    falls = [chi2_null - chi2_of(study, projector, one) for one in models]
    better = sorted((k for k in range(len(tries)) if tries[k].times and falls[k + 1] > falls[0]),
                    key=lambda k: -falls[k + 1])
    return [replace(start, hypothesis=tries[k]) for k in better] or [start]


def at_best_instants(study: Study, events: Sequence[Hypothesis],
                     named: Sequence[Hypothesis] = ()) -> list[Hypothesis]:
    """Each event at the instants of the grid that explain most together, by simulation."""
    return [_together_best(study, study.projector([*named, event]), event, begun)
            for event, begun in zip(events, begun_everywhere(study, events, named), strict=True)]


def _together_best(study: Study, projector: Projector, event: Hypothesis, begun: Begun
                   ) -> Hypothesis:
    """Run by run in turn, the one first that shows most; in a run that contradicts it, never.

    What is missing in one run moves the numbers of the sheet, and with them all other runs.
    """
    models: dict[int, Floats] = {}
    starts: dict[int, int] = {}  # of the grid; -1: never
    order = list(study.train)
    for sweep in range(_SWEEPS):
        before, falls = dict(starts), {}
        for i in order:
            trials = [study.models[i], *(begun[i, k] for k in range(
                grid_of(study.runs[i], event.effect).size))]
            # first each run by itself, to find out which shows most
            others = {j: model for j, model in models.items() if sweep and j != i}
            sums = chi2_with_each(study, projector, others, i, trials)
            starts[i] = int(np.argmin(sums)) - 1
            models[i], falls[i] = trials[starts[i] + 1], float(sums[0] - sums.min())
        if starts == before:
            break
        order = sorted(order, key=lambda i: -falls[i])
    times = {}
    for i, k in starts.items():
        if k >= 0:
            run = study.runs[i]
            start = float(grid_of(run, event.effect)[k])
            times[run.recording.name] = (start, event.effect.end_s(start, spacing_s(run)))
    return replace(event, times=times)


def _moved(hypothesis: Hypothesis, run: str, width: float) -> list[Hypothesis]:
    """The hypothesis with one run's start, or end, moved to either side; a ramp moves whole."""
    start, end = hypothesis.times[run]
    if hypothesis.effect.timing == "ramp":
        spans = [(start - width, end - width), (start + width, end + width)]
    else:
        spans = [(start - width, end), (start + width, end)]
    if hypothesis.effect.edges == 2:
        spans += [(start, end - width), (start, end + width)]
    return [replace(hypothesis, times={**hypothesis.times, run: span})
            for span in spans if span[1] > span[0] + 0.05]
