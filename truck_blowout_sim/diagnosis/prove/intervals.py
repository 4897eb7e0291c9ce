"""How well the instants of an event are known: 90 % intervals of onset and duration.

The sum of squares about its least is a parabola in the amount and in the start and end of each run,
all together; its curvature, nuisances projected out, is the information of a Gaussian model. An
onset alone would be taken for better known than it is: a later start and a stronger amount look
alike. Another form of law has another amount, and the instants move with it. What begins gradually,
in another way than modelled, adds `onset_form_s` of its effect, and what also ends a share of its
duration: a gust (1 - cos) of the same force, middle and width as one that is on or off begins 0.30
of that duration earlier; a load that slides faster and faster begins 0.32 earlier than one that
slides evenly. What was there before it showed is in `hidden.py`.

Known limits: symmetric, but for what hides; an edge that no recording shows has an open interval.
Validated with: test/diagnosis/test_intervals.py (coverage over noise).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.algebra.quantiles import NINETY
from truck_blowout_sim.diagnosis.case.runs import Run
from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.event_fit import event_columns, event_information, runs_with
from truck_blowout_sim.diagnosis.fit.ranked import Ranked
from truck_blowout_sim.diagnosis.prove.hidden import earliest_s, leak_shift_s
from truck_blowout_sim.diagnosis.result.parts import Interval

Floats = NDArray[np.float64]
_GRID_SIGMA_S = 0.02  # the descent stops where half a unit of the sum of squares is left
_SHAPE = 0.3  # of a duration: 1 sigma of either edge, for another shape in between
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
    runs = runs_with(study, event)
    edges = event.effect.edges
    matrix, priors = event_columns(study, event, others)
    covariance = np.asarray(
        np.linalg.inv(event_information(study, event, others, matrix, priors)), dtype=np.float64)
    # another form of law has another amount, and the instants move with it
    moved = covariance[0] / covariance[0, 0] * study.settings.form(event.effect.name) * (
        event.amount - event.effect.neutral(study.packed))
    form = np.outer(moved, moved)
    return {study.runs[i].recording.name: _timing(
        study, study.runs[i], found, (covariance + form)[np.ix_(at, at)])
        for k, i in enumerate(runs) for at in [1 + edges * k + np.arange(edges)]}


def _timing(study: Study, run: Run, found: Ranked, covariance: Floats) -> Timing:
    """Intervals of one run from the covariance of its start (and end)."""
    event = found.hypothesis
    start, end = event.times[run.recording.name]
    form, ends = event.effect.onset_form_s**2, event.effect.edges > 1
    later, leak = leak_shift_s(run, event, study.packed)
    shape = (_SHAPE * (end - start)) ** 2 if ends and end < run.edges_s[-1] else 0.0
    low, high = _interval(start + later, float(covariance[0, 0]) + form + leak**2 + shape, run)
    onset = earliest_s(study, run, found, low), high
    if not ends:
        return Timing(onset, None)
    spread = np.array([-1.0, 1.0])
    variance = float(spread @ covariance @ spread) + form + 2.0 * shape
    low, high = _interval(end - start, variance, run)
    return Timing(onset, (max(low, 0.0), high))


def _interval(value: float, variance: float, run: Run) -> Interval:
    """90 % about a value, open where the data say nothing."""
    wide = NINETY * float(np.sqrt(variance + _GRID_SIGMA_S**2))
    wide = wide if wide < _OPEN * run.length_s else float("inf")
    return value - wide, value + wide
