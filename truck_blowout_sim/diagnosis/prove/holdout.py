"""Predict runs that were never fitted: do the named effects help there?

Nuisances carry over from training as a Gaussian posterior; an effect's amount stays as found. Only
the instant of an event is located anew in each run, and which of its lengths in training it has.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cholesky

from truck_blowout_sim.diagnosis.algebra.linear import Projector
from truck_blowout_sim.diagnosis.case.runs import Run
from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.instants import bins_between, delayed, grid_of
from truck_blowout_sim.diagnosis.fit.models import with_effects

Floats = NDArray[np.float64]
_REFINE_S = (0.4, 0.2, 0.1)


@dataclass(frozen=True, eq=False)
class Prediction:
    """How a holdout run is predicted.

    Attributes:
        run: which.
        chi2: sum of squares against prediction uncertainty.
        left: [n, m] whitened residual after the carried-over calibration.
        named: effects in force, events at their instants in this run.
    """

    run: Run
    chi2: float
    left: Floats
    named: tuple[Hypothesis, ...]


def predict(study: Study, residual: Floats, named: Sequence[Hypothesis]
            ) -> tuple[Prediction, ...]:
    """Predict every holdout run with the nuisances that ``residual`` asks for.

    A calibration number carries over no further than a truck of its kind can stray: what would
    need more is a missing effect, not a property of the truck.
    """
    projector, kept = study.projector(named), study.kept(named)
    amounts = study.amounts_of_kind(named, residual)
    spread = cholesky(projector.covariance() + 1e-12 * np.eye(amounts.size), lower=True)
    found = []
    for run, every, null in zip(study.holdout, study.holdout_columns, study.holdout_models,
                                strict=True):
        columns = every[:, kept]
        carried = _Carried(columns @ amounts, Projector.of(columns @ spread))
        seen = [h for h in named if run.shows(h.effect.applies)]
        placed = _locate_events(study, run, carried, seen)
        model = null
        if placed:
            model = study.simulate([(run, with_effects(study.packed, placed,
                                                       run.recording.name))])[0]
        left = run.residual(model) - carried.change
        found.append(Prediction(run, carried.spread.chi2(left), left.reshape(run.measured.shape),
                                tuple(placed)))
    return tuple(found)


@dataclass(frozen=True, eq=False)
class _Carried:
    """What the calibration of training does in a run, ``change`` [rows], and how surely."""

    change: Floats
    spread: Projector

    def left(self, run: Run, model: Floats) -> float:
        """Sum of squares against prediction uncertainty."""
        return self.spread.chi2(run.residual(model) - self.change)


def _locate_events(study: Study, run: Run, carried: _Carried, named: Sequence[Hypothesis]
                   ) -> list[Hypothesis]:
    """Give timed effects their instant in this run; leave out those that do not help."""
    placed = [h for h in named if not h.effect.timed]
    for h in (h for h in named if h.effect.timed):
        best = _place(study, run, carried, placed, h)
        if best is not None:
            placed.append(best)
    return placed


def _place(study: Study, run: Run, carried: _Carried, others: Sequence[Hypothesis],
           event: Hypothesis) -> Hypothesis | None:
    """The best instant of one event, coarse to fine; None if the run is better without.

    It lasts as long as it did in one of the training runs, whichever explains this run best.
    """
    name, bin_s = run.recording.name, study.settings.bin_s
    base = with_effects(study.packed, others, name)

    def models(intervals: Sequence[tuple[float, float]]) -> list[Floats]:
        return study.simulate([study.job(run, base, replace(event, times={name: (t, t + length)}))
                               for t, length in intervals])

    without = study.simulate([(run, base)])[0]
    tried = [(float(t), length) for t in grid_of(run, event.effect) for length in _lengths(event)]
    sums = {(t + bins * bin_s, length): carried.left(run, without + delayed(model - without, bins))
            for (t, length), model in zip(tried, models(tried), strict=True)
            for bins in bins_between(event.effect, run, bin_s)}
    at, length = min(sums, key=lambda interval: sums[interval])
    best = carried.left(run, models([(at, length)])[0])
    for width in _REFINE_S:
        either = [(at - width, length), (at + width, length)]
        found = {t: carried.left(run, model)
                 for (t, _), model in zip(either, models(either), strict=True)}
        nearest = min(found, key=lambda time: found[time])
        if found[nearest] < best:
            at, best = nearest, found[nearest]
    least = carried.left(run, without)
    return replace(event, times={name: (at, at + length)}) if best < least else None


def _lengths(event: Hypothesis) -> list[float]:
    """How long an event lasted in the training runs: shortest, usual and longest."""
    lasted = [end - start for start, end in event.times.values()] or [np.inf]
    return sorted({float(length) for length in (min(lasted), np.median(lasted), max(lasted))})
