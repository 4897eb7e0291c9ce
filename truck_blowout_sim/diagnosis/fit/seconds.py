"""What each second of each run shows of an event's force: the evidence of `windows.py`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import block_diag

from truck_blowout_sim.diagnosis.case.runs import Run
from truck_blowout_sim.diagnosis.case.study import Study, rows_of
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
from truck_blowout_sim.diagnosis.fit.support import Beside
from truck_blowout_sim.diagnosis.fit.windows import Windows
from truck_blowout_sim.diagnosis.result.parts import Place

Floats = NDArray[np.float64]
_WIDE = 0.25  # of its bound: an event is rarely as strong as can be


def windows_of(study: Study, projector: Projector, effect: Effect, place: Place,
               trained: Mapping[tuple[int, int], Floats], beside: Beside | None = None) -> Windows:
    """The seconds of all runs.

    Args:
        study: the case.
        projector: removes the nuisances.
        effect: the event.
        place: where it acts.
        trained: bin means of training runs with the event begun at each instant tried, by run
            and instant.
        beside: what is in force, with the unseen runs if these are asked.
    """
    fitted = len(study.runs)
    asked = beside is not None and bool(beside.unseen)
    residual, every = study.residual(), study.runs
    if beside is not None and asked:
        projector = Projector.of(beside.columns, projector.kept.tolist(), beside.gram)
        residual = np.concatenate([residual, *(run.residual(model) for run, model in zip(
            study.holdout, beside.unseen, strict=True))])
        every = (*study.runs, *study.holdout)
    removed, rows = projector.remove(residual), rows_of(every)
    quiet = _quiet(study, effect, place, asked)
    own, reach, gradient, run, time_s = [], [], [], list[int](), list[float]()
    for i in (*study.train, *study.baseline, *range(fitted, len(every))):
        found = quiet[i] if i in quiet else _seconds(study, effect, every[i], study.models[i], [
            trained[i, k] for k in range(grid_of(every[i], effect).size)])
        columns = np.stack([column for _, column in found], axis=1)
        own.append(columns.T @ columns)
        reach.append(projector.reach(columns, rows[i]))
        gradient.append(columns.T @ removed[rows[i]])
        run += [i] * len(found)
        time_s += [time for time, _ in found]
    shared = np.concatenate(reach, axis=1)
    amount, owner = effect.amount, np.array(run)
    return Windows(
        block_diag(*own) - shared.T @ projector.solve(shared), np.concatenate(gradient),
        owner, np.array(time_s), np.isin(owner, study.train), owner >= fitted, effect.timing,
        (amount.low, amount.high), effect.strays(study.packed)[0], _WIDE * amount.high)


def _quiet(study: Study, effect: Effect, place: Place, unseen: bool
           ) -> Mapping[int, Sequence[tuple[float, Floats]]]:
    """The seconds of the baseline runs, and of unseen ones; simulated once for a case."""
    found = study.seconds.setdefault((effect, str(place)), {})
    every, models = (*study.runs, *study.holdout), (*study.models, *study.holdout_models)
    wanted = [i for i in (*study.baseline, *(range(len(study.runs), len(every)) if unseen else ()))
              if i not in found]
    jobs, owners = [], []
    for i in wanted:
        run, name = every[i], every[i].recording.name
        still = Hypothesis(effect, place, effect.amount.step)
        for time in grid_of(run, effect).tolist():
            span = (time, effect.end_s(time, spacing_s(run)))
            jobs.append(study.job(run, study.packed, replace(still, times={name: span})))
            owners.append(i)
    results = study.simulate(jobs)
    for i in wanted:
        found[i] = _seconds(study, effect, every[i], models[i], [
            model for model, owner in zip(results, owners, strict=True) if owner == i])
    return found


def _seconds(study: Study, effect: Effect, run: Run, base: Floats, models: Sequence[Floats]
             ) -> list[tuple[float, Floats]]:
    """When each second begins, and the whitened response to the force over that second."""
    if effect.timing == "ramp":
        return _creeping(study, effect, run, base, models)
    found = responses(study, effect, run, base, models, range(1))
    if effect.timing == "pulse":
        return found
    # what lasts is the sum of all seconds from its instant on
    later = [column for _, column in found[1:]] + [np.zeros_like(found[-1][1])]
    return [(time, column - rest) for (time, column), rest in zip(found, later, strict=True)]


def _creeping(study: Study, effect: Effect, run: Run, base: Floats, models: Sequence[Floats]
              ) -> list[tuple[float, Floats]]:
    """The same of what is aside during a second, moved there bit by bit in the second before."""
    delays = bins_between(effect, run, study.settings.bin_s)
    fine = responses(study, effect, run, base, models, delays)
    moved = [(time, np.mean([column for _, column in fine[k:k + PARTS]], axis=0))
             for k, (time, _) in enumerate(fine) if k % PARTS == 0]
    later = [column for _, column in moved[1:]] + [np.zeros_like(moved[-1][1])]
    return [(time, column - rest) for (time, column), rest in zip(moved, later, strict=True)]


def responses(study: Study, effect: Effect, run: Run, base: Floats, models: Sequence[Floats],
              delays: range) -> list[tuple[float, Floats]]:
    """When the event begins, and the whitened response per unit of its amount.

    Args:
        study: the case.
        effect: the event.
        run: in which it begins.
        base: its bin means without the event.
        models: bin means with the event begun at each instant of the grid.
        delays: by how many bins each of these is delayed in turn.
    """
    return [(time + bins * study.settings.bin_s,
             run.change(delayed(model - base, bins), np.zeros(1)) / effect.amount.step)
            for time, model in zip(grid_of(run, effect).tolist(), models, strict=True)
            for bins in delays]
