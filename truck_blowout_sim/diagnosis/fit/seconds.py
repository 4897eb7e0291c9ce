"""What each second of each run shows of an event's force: the evidence of `windows.py`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import block_diag

from truck_blowout_sim.diagnosis.case.study import Study, row_ranges
from truck_blowout_sim.diagnosis.effects import Effect
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.instants import (
    PARTS,
    bins_between,
    delayed,
    grid_of,
    spacing_s,
)
from truck_blowout_sim.diagnosis.fit.linear import Projector
from truck_blowout_sim.diagnosis.fit.windows import Windows
from truck_blowout_sim.diagnosis.result.parts import Place

Floats = NDArray[np.float64]
_WIDE = 0.25  # of its bound: an event is rarely as strong as can be


def windows_of(study: Study, projector: Projector, effect: Effect, place: Place, removed: Floats,
               trained: Mapping[tuple[int, int], Floats]) -> Windows:
    """The seconds of all runs.

    Args:
        study: the case.
        projector: removes the nuisances.
        effect: the event.
        place: where it acts.
        removed: what the projector leaves of the residual.
        trained: bin means of training runs with the event begun at each instant tried, by run
            and instant.
    """
    quiet, rows = _quiet(study, effect, place), row_ranges(study)
    own, reach, gradient, run, time_s = [], [], [], list[int](), list[float]()
    for i in (*study.train, *study.baseline):
        found = quiet[i] if i in quiet else _seconds(study, effect, i, [
            trained[i, k] for k in range(grid_of(study.runs[i], effect).size)])
        columns = np.stack([column for _, column in found], axis=1)
        own.append(columns.T @ columns)
        reach.append(projector.reach(columns, rows[i]))
        gradient.append(columns.T @ removed[rows[i]])
        run += [i] * len(found)
        time_s += [time for time, _ in found]
    shared = np.concatenate(reach, axis=1)
    amount = effect.amount
    return Windows(
        block_diag(*own) - shared.T @ projector.solve(shared), np.concatenate(gradient),
        np.array(run), np.array(time_s), np.isin(run, study.train), effect.timing,
        (amount.low, amount.high), effect.strays(study.packed)[0], _WIDE * amount.high)


def _quiet(study: Study, effect: Effect, place: Place
           ) -> Mapping[int, Sequence[tuple[float, Floats]]]:
    """The seconds of the baseline runs, simulated once for a case."""
    key = (effect, str(place))
    if key not in study.seconds:
        jobs, owners = [], []
        for i in study.baseline:
            run, name = study.runs[i], study.runs[i].recording.name
            still = Hypothesis(effect, place, effect.amount.step)
            for time in grid_of(run, effect).tolist():
                span = (time, effect.end_s(time, spacing_s(run)))
                jobs.append(study.job(run, study.packed, replace(still, times={name: span})))
                owners.append(i)
        models = study.simulate(jobs)
        study.seconds[key] = {i: _seconds(study, effect, i, [
            model for model, owner in zip(models, owners, strict=True) if owner == i])
            for i in study.baseline}
    return study.seconds[key]


def _seconds(study: Study, effect: Effect, i: int, models: Sequence[Floats]
             ) -> list[tuple[float, Floats]]:
    """When each second begins, and the whitened response to the force over that second."""
    if effect.timing == "ramp":
        return _creeping(study, effect, i, models)
    found = responses(study, effect, i, models, range(1))
    if effect.timing == "pulse":
        return found
    # what lasts is the sum of all seconds from its instant on
    later = [column for _, column in found[1:]] + [np.zeros_like(found[-1][1])]
    return [(time, column - rest) for (time, column), rest in zip(found, later, strict=True)]


def _creeping(study: Study, effect: Effect, i: int, models: Sequence[Floats]
              ) -> list[tuple[float, Floats]]:
    """The same of what is aside during a second, moved there bit by bit in the second before."""
    delays = bins_between(effect, study.runs[i], study.settings.bin_s)
    fine = responses(study, effect, i, models, delays)
    moved = [(time, np.mean([column for _, column in fine[k:k + PARTS]], axis=0))
             for k, (time, _) in enumerate(fine) if k % PARTS == 0]
    later = [column for _, column in moved[1:]] + [np.zeros_like(moved[-1][1])]
    return [(time, column - rest) for (time, column), rest in zip(moved, later, strict=True)]


def responses(study: Study, effect: Effect, i: int, models: Sequence[Floats], delays: range
              ) -> list[tuple[float, Floats]]:
    """When the event begins, and the whitened response per unit of its amount.

    Args:
        study: the case.
        effect: the event.
        i: position of the run.
        models: bin means with the event begun at each instant of the grid.
        delays: by how many bins each of these is delayed in turn.
    """
    run = study.runs[i]
    return [(time + bins * study.settings.bin_s,
             run.change(delayed(model - study.models[i], bins), np.zeros(1)) / effect.amount.step)
            for time, model in zip(grid_of(run, effect).tolist(), models, strict=True)
            for bins in delays]
