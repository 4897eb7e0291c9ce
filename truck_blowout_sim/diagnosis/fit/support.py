"""How well one fitted hypothesis is supported, at the amount it was fitted to.

Runs of every role are asked how much of it each of them shows: baseline runs, where the truck has
none of it, and unseen runs, which the amount was not fitted to.

References, known limits: see `scatter.py`. What begins at an instant, or is met on the way, is
asked of training only; wind, slope and load from an instant on by `windows.py`. What nothing
explains weighs less: `run_weights.py`.
Validated with: test/diagnosis/test_support.py.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.algebra.linear import Projector
from truck_blowout_sim.diagnosis.case.study import Study, row_ranges
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.begun import log_choices
from truck_blowout_sim.diagnosis.fit.beside import Beside, unseen_models
from truck_blowout_sim.diagnosis.fit.models import models_at
from truck_blowout_sim.diagnosis.fit.ranked import Ranked
from truck_blowout_sim.diagnosis.fit.run_weights import run_weights, weighed
from truck_blowout_sim.diagnosis.fit.scatter import Chance
from truck_blowout_sim.diagnosis.fit.shown import Part, Shown, parts_of
from truck_blowout_sim.diagnosis.fit.telling import tells_of, while_loads_rest
from truck_blowout_sim.diagnosis.fit.width_error import degrees_of, most_supported

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class _Asked:
    """What all runs that are asked hold of a hypothesis.

    Attributes:
        projector: of the nuisances; ``residual``: [rows] before the hypothesis is in force.
        column: [rows] of what it changes per unit, where it may act.
        parts: the same run by run, of baseline runs too.
    """

    projector: Projector
    residual: Floats
    column: Floats
    parts: tuple[Part, ...]

    def weighed(self, study: Study, away: float) -> _Asked:
        """Every run with its weight: less where it is left with more than its widths allow.

        Else a run that nothing explains would set the nuisances of all.
        """
        weights = run_weights(study, self.projector, self.residual - away * self.column)
        if not (weights < 1.0).any():
            return self
        size = np.sqrt(weights)
        return replace(self.times(size), projector=weighed(study, self.projector, weights),
                       residual=self.residual * size, column=self.column * size)

    def times(self, factors: Floats) -> _Asked:
        """What the runs show of it, each row times its factor."""
        return replace(self, parts=tuple(
            replace(part, column=part.column * factors[part.rows]) for part in self.parts))

    def left(self, away: float) -> Floats:
        """What remains of the rows with the hypothesis ``away`` from neutral."""
        return self.projector.remove(self.residual - away * self.column)

    def shown(self, strays: tuple[float, ...], away: float) -> Shown | None:
        """What each run shows of amounts up to ``away``."""
        return Shown.of(self.projector, self.projector.remove(self.residual), self.parts, strays,
                        (min(away, 0.0), max(away, 0.0)), self.left(away))


def supported(study: Study, one: Ranked, beside: Beside, chance: Chance) -> Ranked:
    """The same with its support, for amounts up to the one that was fitted.

    No more than what it explains supports where widths are estimates; see `width_error.py`. Beside
    a load that moves it must be supported at all times and at those that tell; see `telling.py`.
    """
    h = one.hypothesis
    away = h.amount - h.effect.neutral(study.packed)
    if away == 0.0 or (one.refitted and one.delta <= 0.0):
        return replace(one, support=0.0)
    asked, strays = _asked(study, h, beside, away), h.effect.strays(study.packed, study.grip_used)
    weighed_runs = asked.weighed(study, away)
    shown = weighed_runs.shown(strays, away)
    if shown is None:
        return replace(one, support=0.0)
    change = away * asked.column[:study.columns.shape[0]]
    scatter = chance.beside(h.key, change, study.columns.T @ change, asked.left(away))
    choices = log_choices(study, h, beside.named)
    support = scatter.support(shown, choices)
    if support > 0.0 and any(other.effect.pushes_back for other in beside.named):
        still = weighed_runs.times(_still(study, beside)).shown(strays, away)
        support = 0.0 if still is None else min(support, scatter.support(still, choices))
    if one.refitted:
        runs = len(study.baseline or study.train)
        support = min(support, most_supported(one.evidence, degrees_of(runs)))
    return replace(one, support=support)


def _still(study: Study, beside: Beside) -> Floats:
    """[rows] 1 of all runs, unseen ones last, while no named load moves in them."""
    runs = [(run, beside.named) for run in study.runs]
    runs += list(zip(study.holdout, beside.placed, strict=False))  # none where instants are open
    return np.concatenate([while_loads_rest(study, run, named) for run, named in runs])


def support_of_unseen(study: Study, one: Ranked, beside: Beside, chance: Chance) -> float:
    """What the unseen runs add to the support of a hypothesis; less than 0: they speak against it.

    Only of one whose support knows them, see :func:`asks_unseen`.
    """
    fitted = supported(study, one, replace(beside, unseen=()), chance)
    return one.support - fitted.support


def _asked(study: Study, h: Hypothesis, beside: Beside, away: float) -> _Asked:
    """What the fitted runs hold of a hypothesis, and the unseen ones where these are asked."""
    models, rows = beside.models, row_ranges(study)
    changed = models_at(study, [h], beside.named)[0]
    if not h.effect.timed:
        changed |= dict(zip(study.baseline, study.simulate(
            [(study.runs[i], h.apply(study.packed, "")) for i in study.baseline]), strict=True))
    columns = {i: study.runs[i].change(model, models[i]) / away for i, model in changed.items()}
    parts = tuple(part for i, column in columns.items() for part in parts_of(
        study.runs[i], rows[i].start, column * tells_of(study, study.runs[i], h),
        i in study.train, study.settings.episode_s, None if h.effect.timed else beside.driven[i]))
    seen = _Asked(study.projector([*beside.named, h]), study.residual(dict(enumerate(models))),
                  study.stack({i: c for i, c in columns.items() if i in study.train}), parts)
    if asks_unseen(h, beside):
        return _with_unseen(study, seen, h, beside, away)
    return seen


def asks_unseen(h: Hypothesis, beside: Beside) -> bool:
    """Whether the support of a hypothesis beside what is named knows the unseen runs."""
    return bool(beside.unseen) and not (h.effect.timed or h.effect.met)


def _with_unseen(study: Study, seen: _Asked, h: Hypothesis, beside: Beside, away: float) -> _Asked:
    """The same with the unseen runs behind the fitted ones."""
    kept = seen.projector.kept.tolist()
    residuals, changes, parts = [seen.residual], [seen.column], list(seen.parts)
    first = seen.residual.size
    models = unseen_models(study, [(*one, h) for one in beside.placed])
    for run, base, model, manner in zip(study.holdout, beside.unseen, models,
                                        beside.driven[len(study.runs):], strict=True):
        change = run.change(model, base) / away
        parts += parts_of(run, first, change * tells_of(study, run, h), True,
                          study.settings.episode_s, manner)
        changes.append(change)
        residuals.append(run.residual(base))
        first += change.size
    return _Asked(Projector.of(beside.columns, kept, beside.gram), np.concatenate(residuals),
                  np.concatenate(changes), tuple(parts))
