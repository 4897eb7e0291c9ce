"""An event begun at each instant of the grid, and how many of these explain as much as the best.

The likelihood of an event at a free instant is the mean over all instants, not that of the best.
Where grip is lost long before a turn needs it, many instants explain as much, and the mean is
hardly less than the best; where a tire bursts, one instant explains more than all others.

References: Kass and Raftery 1995 (marginal likelihood); MacKay 2003, ch. 28 (Occam factor).
Known limits: for wind, slope and moving load, one instant is taken to explain more than all others,
at each free end.
Validated with: test/diagnosis/test_begun.py.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.case.study import Progress, Study, row_ranges
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.instants import grid_of, spacing_s
from truck_blowout_sim.diagnosis.fit.models import models_at, with_effects
from truck_blowout_sim.diagnosis.fit.refit import chi2_of, chi2_with_each
from truck_blowout_sim.diagnosis.fit.run_weights import run_weights

Floats = NDArray[np.float64]
Begun = dict[tuple[int, int], Floats]


def begun_everywhere(study: Study, events: Sequence[Hypothesis], named: Sequence[Hypothesis] = (),
                     progress: Progress | None = None) -> list[Begun]:
    """Bin means with each event begun at each instant of the grid, by training run and instant."""
    jobs, keys = [], []
    for j, event in enumerate(events):
        for i in study.train:
            run, effect = study.runs[i], event.effect
            truck = with_effects(study.packed, named, run.recording.name)
            for k, time in enumerate(grid_of(run, effect).tolist()):
                span = (time, effect.end_s(time, spacing_s(run)))
                jobs.append(study.job(run, truck, replace(event, times={
                    run.recording.name: span})))
                keys.append((j, i, k))
    found: list[Begun] = [{} for _ in events]
    for (j, i, k), bins in zip(keys, study.simulate(jobs, "events", progress), strict=True):
        found[j][i, k] = bins
    return found


def log_choices(study: Study, event: Hypothesis, named: Sequence[Hypothesis] = ()) -> float:
    """Log of how many combinations of instants the best was in effect taken from.

    Runs are weighed by what the event leaves of them: widths that are too small would make every
    instant seem sharp.
    """
    acting = [i for i in study.train if study.runs[i].recording.name in event.times]
    if event.effect.adds_up or not acting:
        tried = [grid_of(study.runs[i], event.effect).size for i in acting]
        return float(event.effect.edges * np.log(np.maximum(tried, 1)).sum())
    begun, = begun_everywhere(study, [event], named)
    projector, models = study.projector([*named, event]), models_at(study, [event], named)[0]
    weights = run_weights(study, projector, study.residual(models))
    best = chi2_of(study, projector, models)
    total = 0.0
    for i in acting:
        run = study.runs[i]
        grid = grid_of(run, event.effect)
        sums = chi2_with_each(study, projector, models, i,
                              [begun[i, k] for k in range(grid.size)])
        start, _ = event.times[run.recording.name]
        total += choices(sums, best, int(np.argmin(np.abs(grid - start))),
                         float(weights[row_ranges(study)[i].start]))
    return total


def choices(sums: Floats, best: float, nearest: int, weight: float) -> float:
    """Log of how many instants of one run the best was in effect taken from.

    Args:
        sums: [n] sum of squares with the event begun at each instant of the grid.
        best: with the instant that was fitted; ``nearest``: that of the grid it stands for.
        weight: of the run.
    """
    falls = np.append(np.delete(sums, nearest), best)
    return float(np.log(sums.size) - np.log(
        np.exp(-0.5 * weight * (falls - falls.min())).sum()))
