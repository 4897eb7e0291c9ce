"""How well the instants of an event are known: 90 % intervals of onset and duration.

The sum of squares about its least is a parabola in the amount and in the start and end of each run,
all together; its curvature, nuisances projected out, is the information of a Gaussian model. An
onset alone would be taken for better known than it is: a later start and a stronger amount look
alike.

Known limits: symmetric; an edge that no recording shows has an open interval.
Validated with: test/diagnosis/test_intervals.py (coverage over noise).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.attribute import Ranked, with_effects
from truck_blowout_sim.diagnosis.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.result_parts import Interval
from truck_blowout_sim.diagnosis.runs import Run
from truck_blowout_sim.diagnosis.study import Study
from truck_blowout_sim.diagnosis.timed import REFINE_S

Floats = NDArray[np.float64]
_NINETY = 1.645
_STEP_S = 0.06  # finite difference of an instant
_GRID_SIGMA_S = REFINE_S[-1] / np.sqrt(3.0)  # instants were searched no finer
_OPEN = 0.25  # share of a run's length from which on nothing is known of an instant


@dataclass(frozen=True)
class Timing:
    """90 % intervals in one run; ``duration_s`` is None for an effect that stays."""

    onset_s: Interval
    duration_s: Interval | None


def time_intervals(study: Study, found: Ranked, others: Sequence[Hypothesis] = ()
                   ) -> Mapping[str, Timing]:
    """Intervals for each run that has the event, ``others`` in force."""
    event = found.hypothesis
    runs = [i for i in study.train if study.runs[i].recording.name in event.times]
    edges = 2 if event.effect.timing == "pulse" else 1
    columns = [_amount_column(study, event, others, runs)]
    priors = [event.effect.amount.high - event.effect.amount.low]
    for i in runs:
        columns += [_edge_column(study, i, event, others, edge) for edge in range(edges)]
        priors += [_length_s(study.runs[i])] * edges
    clean = study.projector([*others, event]).remove
    matrix = np.stack(columns, axis=1)
    information = matrix.T @ np.stack([clean(c) for c in columns], axis=1)
    covariance = np.linalg.inv(information + np.diag(1.0 / np.square(priors)))
    return {study.runs[i].recording.name: _timing(
        study.runs[i], event, covariance[np.ix_(at, at)])
        for k, i in enumerate(runs) for at in [1 + edges * k + np.arange(edges)]}


def _timing(run: Run, event: Hypothesis, covariance: Floats) -> Timing:
    """Intervals of one run from the covariance of its start (and end)."""
    start, end = event.times[run.recording.name]
    onset = _interval(start, float(covariance[0, 0]), run)
    if covariance.shape[0] == 1:
        return Timing(onset, None)
    spread = np.array([-1.0, 1.0])
    low, high = _interval(end - start, float(spread @ covariance @ spread), run)
    return Timing(onset, (max(low, 0.0), high))


def _interval(value: float, variance: float, run: Run) -> Interval:
    """90 % about a value, open where the data say nothing."""
    wide = _NINETY * float(np.sqrt(variance + _GRID_SIGMA_S**2))
    wide = wide if wide < _OPEN * _length_s(run) else float("inf")
    return value - wide, value + wide


def _length_s(run: Run) -> float:
    return float(run.edges_s[-1] - run.edges_s[0])


def _amount_column(study: Study, event: Hypothesis, others: Sequence[Hypothesis],
                   runs: Sequence[int]) -> Floats:
    """Whitened change of the training runs per unit of the amount."""
    amount = event.effect.amount
    step = abs(0.3 * amount.step)
    low, high = max(event.amount - step, amount.low), min(event.amount + step, amount.high)
    return study.stack({i: _change(study, i, event.at(low), event.at(high), others) / (high - low)
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


def _change(study: Study, i: int, before: Hypothesis, after: Hypothesis,
            others: Sequence[Hypothesis]) -> Floats:
    """What a run changes from one hypothesis to another."""
    run, name = study.runs[i], study.runs[i].recording.name
    truck = with_effects(study.packed, others, name)
    first, last = study.simulate([(run, h.apply(truck, name)) for h in (before, after)])
    return run.change(last, first)
