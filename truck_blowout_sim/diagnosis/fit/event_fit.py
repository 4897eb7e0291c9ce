"""Amount, starts and ends of an event, and what else its law leaves open, fitted together.

The instants are first searched one by one; then all numbers of the event move at once along the
least-squares step, nuisances projected out, because a later start and a stronger amount look alike.
Numbers of its law (`FormNumber`) begin where the law has them, and keep to their priors.

References: Levenberg-Marquardt (Nocedal and Wright 2006, section 10.3): on the curved valley of a
weaker and earlier event, a straight Gauss-Newton step soon leaves it.
Known limits: one descent, from where the search of the instants ended.
Validated with: test/diagnosis/test_timed.py (instants between the steps of the search are found).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects.base import CHANGED_IN_S
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.models import models_at, with_effects
from truck_blowout_sim.diagnosis.fit.ranked import Ranked
from truck_blowout_sim.diagnosis.fit.refit import chi2_of, least_step

Floats = NDArray[np.float64]
_STEP_S = 0.06  # finite difference of an instant
_STEP_SIGMA = 0.25  # finite difference of a number of the law
_SHORTEST_S = 0.06  # an event lasts at least this long
_ROUNDS = 8
_DAMPING = (0.0, 0.1, 1.0, 10.0, 100.0)  # times the information on each number alone
_ENOUGH = 0.5  # fall of the sum of squares below which a round is the last


def runs_with(study: Study, event: Hypothesis) -> list[int]:
    """Positions of the training runs that have the event."""
    return [i for i in study.train if study.runs[i].recording.name in event.times]


def event_columns(study: Study, event: Hypothesis, others: Sequence[Hypothesis] = ()
                  ) -> tuple[Floats, Floats]:
    """Whitened change per unit of the amount, of each instant, and of each number of the law.

    Returns [rows, 1 + edges * runs + numbers], and as many ranges: how far each may go.
    """
    runs, edges = runs_with(study, event), event.effect.edges
    columns = [amount_column(study, event, others, runs)]
    ranges = [event.effect.amount.high - event.effect.amount.low]
    for i in runs:
        columns += [_edge_column(study, i, event, others, edge) for edge in range(edges)]
        ranges += [study.runs[i].length_s] * edges
    numbers = range(len(event.effect.form_numbers))
    columns += [_shape_column(study, event, others, runs, k) for k in numbers]
    return np.stack(columns, axis=1), np.array([*ranges, *(1.0 for _ in numbers)])


def event_information(study: Study, event: Hypothesis, others: Sequence[Hypothesis],
                      columns: Floats, ranges: Floats) -> Floats:
    """Information on the numbers of an event, nuisances projected out, each within its range."""
    seen = study.projector([*others, event]).information(columns)
    return np.asarray(seen + np.diag(1.0 / np.square(ranges)))


def fit_event(study: Study, start: Ranked, chi2_null: float,
              named: Sequence[Hypothesis] = ()) -> Ranked:
    """The event at the best of all its numbers together, from those it has."""
    event = start.hypothesis
    projector = study.projector([*named, event])
    models = models_at(study, [event], named)[0]
    fall = chi2_null - chi2_of(study, projector, models) - event.shape_cost
    sigma = start.sigma
    for _ in range(_ROUNDS):
        columns, ranges = event_columns(study, event, named)
        information = event_information(study, event, named, columns, ranges)
        slope = columns.T @ projector.remove(study.residual(models))
        slope[slope.size - len(event.whole_shape):] -= event.whole_shape  # the prior pulls back
        sigma = float(np.linalg.inv(information)[0, 0] ** 0.5)
        before, alone = fall, np.diag(np.diag(information))
        for damping in _DAMPING:
            step = np.linalg.solve(information + damping * alone, slope)
            trial = _moved(study, event, np.asarray(step, dtype=np.float64))
            tried = models_at(study, [trial], named)[0]
            gain = chi2_null - chi2_of(study, projector, tried) - trial.shape_cost
            if gain > fall:
                event, models, fall = trial, tried, gain
                break
        if fall - before < _ENOUGH:
            break
    return Ranked(event, fall, sigma, refitted=True, evidence=fall + start.evidence - start.delta)


def _moved(study: Study, event: Hypothesis, step: Floats) -> Hypothesis:
    """The event with amount and instants moved, inside their bounds."""
    amount, edges = event.effect.amount, event.effect.edges
    times = dict(event.times)
    for k, i in enumerate(runs_with(study, event)):
        run = study.runs[i]
        by = step[1 + edges * k:1 + edges * (k + 1)]
        first, last = float(run.edges_s[0]), float(run.edges_s[-1])
        start, end = times[run.recording.name]
        start = float(np.clip(start + by[0], first, last - _SHORTEST_S))
        if edges == 2:
            longest = CHANGED_IN_S if event.effect.timing == "ramp" else np.inf
            end = float(np.clip(end + by[1], start + _SHORTEST_S, start + longest))
        times[run.recording.name] = (start, end)
    at = float(np.clip(event.amount + step[0], amount.low, amount.high))
    shape = event.whole_shape
    moved = tuple(float(one + by)
                  for one, by in zip(shape, step[step.size - len(shape):], strict=True))
    return replace(event, amount=at, times=times, shape=moved)


def amount_column(study: Study, h: Hypothesis, others: Sequence[Hypothesis],
                  runs: Sequence[int]) -> Floats:
    """Whitened change of some training runs per unit of the amount, of a steady cause too."""
    amount = h.effect.amount
    step = least_step(amount, h.amount)
    low, high = max(h.amount - step, amount.low), min(h.amount + step, amount.high)
    return study.stack({i: _change(study, i, h.at(low), h.at(high), others) / (high - low)
                        for i in runs})


def _edge_column(study: Study, i: int, event: Hypothesis, others: Sequence[Hypothesis], edge: int
                 ) -> Floats:
    """Whitened change of one run per second that its start (0) or end (1) moves."""
    name = study.runs[i].recording.name
    moved = []
    for by in (-_STEP_S, _STEP_S):
        span = list(event.times[name])
        span[edge] += by
        moved.append(replace(event, times={**event.times, name: (span[0], span[1])}))
    return study.stack({i: _change(study, i, moved[0], moved[1], others) / (2.0 * _STEP_S)})


def _shape_column(study: Study, event: Hypothesis, others: Sequence[Hypothesis],
                  runs: Sequence[int], k: int) -> Floats:
    """Whitened change of the training runs per sigma of one number of the law."""
    shape = event.whole_shape
    low, high = (replace(event, shape=(*shape[:k], shape[k] + by, *shape[k + 1:]))
                 for by in (-_STEP_SIGMA, _STEP_SIGMA))
    return study.stack({i: _change(study, i, low, high, others) / (2.0 * _STEP_SIGMA)
                        for i in runs})


def _change(study: Study, i: int, before: Hypothesis, after: Hypothesis,
            others: Sequence[Hypothesis]) -> Floats:
    """What a run changes from one hypothesis to another."""
    run, name = study.runs[i], study.runs[i].recording.name
    truck = with_effects(study.packed, others, name)
    first, last = study.simulate([study.job(run, truck, h) for h in (before, after)])
    return run.change(last, first)
