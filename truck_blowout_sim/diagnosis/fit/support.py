"""How well one fitted hypothesis is supported, at the amount it was fitted to.

Runs of every role are asked how much of it each of them shows: baseline runs, where the truck has
none of it, and unseen runs, which the amount was not fitted to.

References, known limits: see `scatter.py`. What begins at an instant, or is met on the way, is
asked of training only; wind, slope and load from an instant on by `windows.py`.
Validated with: test/diagnosis/test_support.py.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.case.driven import driven
from truck_blowout_sim.diagnosis.case.runs import Run
from truck_blowout_sim.diagnosis.case.study import Study, row_ranges
from truck_blowout_sim.diagnosis.case.trust import comparable_rows
from truck_blowout_sim.diagnosis.effects.base import axles_at
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.attribute import Ranked
from truck_blowout_sim.diagnosis.fit.instants import grid_of
from truck_blowout_sim.diagnosis.fit.linear import Projector
from truck_blowout_sim.diagnosis.fit.models import models_at, with_effects
from truck_blowout_sim.diagnosis.fit.scatter import Chance
from truck_blowout_sim.diagnosis.fit.shown import Part, Shown, parts_of
from truck_blowout_sim.diagnosis.fit.width_error import degrees_of, most_supported

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Beside:
    """What is in force already, beside a hypothesis.

    Attributes:
        named: hypotheses; ``models``: of all runs with them in force, ``unseen``: of the holdout,
            none where one of them begins at an instant.
        columns: [rows, k] of the nuisances over all runs, unseen too, and ``gram``, their products;
            empty where no unseen run is asked.
        driven: what each run asks of the sheet, unseen ones last.
    """

    named: tuple[Hypothesis, ...]
    models: tuple[Floats, ...]
    unseen: tuple[Floats, ...]
    columns: Floats
    gram: Floats
    driven: tuple[Floats, ...]

    @staticmethod
    def of(study: Study, named: Sequence[Hypothesis], models: Sequence[Floats]) -> Beside:
        """With the holdout simulated."""
        nothing: Floats = np.zeros((0, 0))
        manners = tuple(driven(study))
        if not study.holdout or any(h.effect.timed for h in named):
            return Beside(tuple(named), tuple(models), (), nothing, nothing, manners)
        unseen = _unseen(study, named) if named else study.holdout_models
        columns = np.concatenate([study.columns, *study.holdout_columns])
        return Beside(tuple(named), tuple(models), tuple(unseen), columns, columns.T @ columns,
                      manners)


def supported(study: Study, one: Ranked, beside: Beside, chance: Chance) -> Ranked:
    """The same with its support, for amounts up to the one that was fitted.

    No more than what it explains supports where widths are estimates; see `width_error.py`.
    """
    h, models = one.hypothesis, beside.models
    away = h.amount - h.effect.neutral(study.packed)
    if away == 0.0 or (one.refitted and one.delta <= 0.0):
        return replace(one, support=0.0)
    changed = models_at(study, [h], beside.named)[0]
    if not h.effect.timed:
        changed |= dict(zip(study.baseline, study.simulate(
            [(study.runs[i], h.apply(study.packed, "")) for i in study.baseline]), strict=True))
    rows, residual = row_ranges(study), study.residual(dict(enumerate(models)))
    columns = {i: study.runs[i].change(model, models[i]) / away for i, model in changed.items()}
    parts = [part for i, column in columns.items() for part in parts_of(
        study.runs[i], rows[i].start, column * _telling(study, study.runs[i], h),
        i in study.train, study.settings.episode_s, None if h.effect.timed else beside.driven[i])]
    projector, more, changes = study.projector([*beside.named, h]), list[Part](), list[Floats]()
    if beside.unseen and asks_unseen(h, beside.named):
        projector, residual, more, changes = _with_unseen(study, projector, residual, h, beside,
                                                          away)
    fitted = np.concatenate([study.stack({i: c for i, c in columns.items() if i in study.train}),
                             *changes])
    removed = projector.remove(residual)
    left = removed - away * projector.remove(fitted)
    shown = Shown.of(projector, removed, [*parts, *more],
                     h.effect.strays(study.packed, study.grip_used),
                     (min(away, 0.0), max(away, 0.0)), left)
    if shown is None:
        return replace(one, support=0.0)
    change = away * fitted[:study.columns.shape[0]]
    scatter = chance.beside(h.key, change, study.columns.T @ change, left)
    support = scatter.support(shown, _log_choices(study, h))
    if one.refitted:
        runs = len(study.baseline or study.train)
        support = min(support, most_supported(one.evidence, degrees_of(runs)))
    return replace(one, support=support)


def asks_unseen(h: Hypothesis, named: Sequence[Hypothesis]) -> bool:
    """Whether the support of a hypothesis beside what is named knows the unseen runs, if any."""
    return not (h.effect.timed or h.effect.met or any(one.effect.timed for one in named))


def _telling(study: Study, run: Run, h: Hypothesis) -> Floats:
    """[rows] 1 where a run can tell of the hypothesis, else 0.

    Not from where only training lost a tire of the axle at which it acts, unless it is about the
    lost tire: what that tire does differs among good models, and acts at the same place.
    """
    if h.effect.timed or h.effect.applies == "blowout" or not _at_lost_tire(study, run, h):
        return np.ones(run.measured.size)
    return comparable_rows(study, run)


def _at_lost_tire(study: Study, run: Run, h: Hypothesis) -> bool:
    """Whether the hypothesis acts at an axle, or a hub of it, that loses a tire in the run."""
    vehicle = study.packed.vehicle
    own = axles_at(vehicle, h.place) if h.place.axle else ()
    lost = {vehicle.axle_of_hub(vehicle.hub_of_tire(tire))
            for event in run.recording.blowouts for tire in event.tires}
    return bool(lost & set(own))


def _with_unseen(study: Study, seen: Projector, residual: Floats, h: Hypothesis, beside: Beside,
                 away: float) -> tuple[Projector, Floats, list[Part], list[Floats]]:
    """Nuisances and residual of the unseen runs too, and what the hypothesis changes in these."""
    projector = Projector.of(beside.columns, seen.kept.tolist(), beside.gram)
    first, parts, changes = residual.size, list[Part](), list[Floats]()
    for run, base, model, manner in zip(
            study.holdout, beside.unseen, _unseen(study, (*beside.named, h)),
            beside.driven[len(study.runs):], strict=True):
        change = run.change(model, base) / away
        parts += parts_of(run, first, change * _telling(study, run, h), True,
                          study.settings.episode_s, manner)
        changes.append(change)
        residual = np.concatenate([residual, run.residual(base)])
        first += change.size
    return projector, residual, parts, changes


def _unseen(study: Study, effects: Sequence[Hypothesis]) -> list[Floats]:
    """Models of the holdout with steady effects in force."""
    return study.simulate([(run, with_effects(study.packed, effects, run.recording.name))
                           for run in study.holdout])


def _log_choices(study: Study, hypothesis: Hypothesis) -> float:
    """Log of how many combinations of instants the best was taken from; many runs have too many."""
    tried = [grid_of(run, hypothesis.effect).size for run in study.runs
             if run.recording.name in hypothesis.times]
    return float(hypothesis.effect.edges * np.log(np.maximum(tried, 1)).sum())
