"""What each second of each run shows of an event's force: the evidence of `windows.py`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import block_diag

from truck_blowout_sim.diagnosis.algebra.linear import Projector
from truck_blowout_sim.diagnosis.case.runs import Run
from truck_blowout_sim.diagnosis.case.study import Study, rows_of
from truck_blowout_sim.diagnosis.effects import Effect
from truck_blowout_sim.diagnosis.effects.base import Timing
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.beside import Beside
from truck_blowout_sim.diagnosis.fit.instants import (
    PARTS,
    bins_between,
    delayed,
    grid_of,
    spacing_s,
)
from truck_blowout_sim.diagnosis.fit.run_weights import run_weights, weighed
from truck_blowout_sim.diagnosis.fit.stretches import of_stretches, parts_of, stretches
from truck_blowout_sim.diagnosis.fit.telling import tells_of_forces
from truck_blowout_sim.diagnosis.fit.windows import Windows
from truck_blowout_sim.diagnosis.result.parts import Place

Floats = NDArray[np.float64]
_WIDE = 0.25  # of its bound: an event is rarely as strong as can be
_DIM = 1e-9  # of the information that the clearest stretch shows: less is nothing


def windows_of(study: Study, projector: Projector, effect: Effect, place: Place,
               trained: Mapping[tuple[int, int], Floats], beside: Beside | None = None,
               telling: bool = False) -> Windows:
    """The seconds of all runs.

    Args:
        study: the case.
        projector: removes the nuisances.
        effect: the event.
        place: where it acts.
        trained: bin means of training runs with the event begun at each instant tried, by run
            and instant.
        beside: what is in force, with the unseen runs if these are asked.
        telling: only where that hides no force from outside; see `telling.py`.
    """
    fitted = len(study.runs)
    asked = beside is not None and bool(beside.unseen)
    residual, every = study.residual(), study.runs
    if beside is not None and asked:
        projector = Projector.of(beside.columns, projector.kept.tolist(), beside.gram)
        residual = np.concatenate([residual, *(run.residual(model) for run, model in zip(
            study.holdout, beside.unseen, strict=True))])
        every = (*study.runs, *study.holdout)
    rows, quiet = rows_of(every), _quiet(study, effect, place, asked)
    asked_of = [*study.train, *study.baseline, *range(fitted, len(every))]
    found = {i: quiet[i] if i in quiet else _seconds(study, effect, every[i], study.models[i], [
        trained[i, k] for k in range(grid_of(every[i], effect).size)]) for i in asked_of}
    columns = {i: np.stack([column for _, column in found[i]], axis=1) for i in asked_of}
    if beside is not None and telling:
        columns = {i: one * _told(study, i, beside)[:, None] for i, one in columns.items()}
    acting = [i for i in asked_of if i not in study.baseline]
    projector, size = _weighed(study, effect.timing, projector, residual,
                               {i: (rows[i], columns[i]) for i in acting})
    columns = {i: one * size[rows[i], None] for i, one in columns.items()}
    removed = projector.remove(residual * size)
    own = [columns[i].T @ columns[i] for i in asked_of]
    shared = np.concatenate([projector.reach(columns[i], rows[i]) for i in asked_of], axis=1)
    gradient = np.concatenate([columns[i].T @ removed[rows[i]] for i in asked_of])
    owner = np.repeat(asked_of, [len(found[i]) for i in asked_of])
    time_s = np.array([time for i in asked_of for time, _ in found[i]])
    return Windows(
        block_diag(*own) - shared.T @ projector.solve(shared), gradient, owner, time_s,
        np.isin(owner, study.train), owner >= fitted, effect.timing,
        (effect.amount.low, effect.amount.high), effect.strays(study.packed)[0],
        _WIDE * effect.amount.high)


def _told(study: Study, i: int, beside: Beside) -> Floats:
    """[rows] 1 where a run, or an unseen one behind these, tells of forces from outside."""
    fitted = len(study.runs)
    run = (*study.runs, *study.holdout)[i]
    if i in study.baseline:
        return np.ones(run.measured.size)
    named = beside.named if i < fitted else beside.placed[i - fitted]
    return tells_of_forces(study, run, named)


def _weighed(study: Study, timing: Timing, projector: Projector, residual: Floats,
             acting: Mapping[int, tuple[slice, Floats]]) -> tuple[Projector, Floats]:
    """Nuisances over weighed rows, and the root [rows] of each row's weight.

    A run weighs less where it is left with more than its widths allow, the event in force over its
    best stretch. ``acting``: rows of each run that may have it, and the responses of its seconds.
    """
    rest, removed = residual.copy(), projector.remove(residual)
    for rows, seconds in acting.values():
        rest[rows] -= _best_event(timing, seconds, removed[rows])
    weights = run_weights(study, projector, rest)
    if not (weights < 1.0).any():
        return projector, np.ones(rest.size)
    return weighed(study, projector, weights), np.sqrt(weights)


def _best_event(timing: Timing, seconds: Floats, residual: Floats) -> Floats:
    """[rows] what the event changes in a run, over the stretch and at the amount that fit best."""
    columns = seconds if timing == "pulse" else seconds[:, ::-1].cumsum(axis=1)[:, ::-1]
    first, end = stretches(timing, columns.shape[1])
    slope, bend = of_stretches(timing, columns.T @ residual, columns.T @ columns, first, end)
    shown = np.maximum(bend, _DIM * max(float(bend.max(initial=0.0)), _DIM))
    k = int(np.argmax(np.square(slope) / shown))
    event = columns[:, first[k]:end[k]].sum(axis=1) * parts_of(timing, first, end)[k]
    return np.asarray(event * slope[k] / shown[k])


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
