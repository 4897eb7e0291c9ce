"""Rank the steady candidates: one sensitivity a candidate, nuisances projected out.

Validated with: test/diagnosis/test_refit.py, test/diagnosis/test_shortlist.py.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.algebra.linear import Projector, Score, score
from truck_blowout_sim.diagnosis.case.driven import driven
from truck_blowout_sim.diagnosis.case.study import Progress, Study, row_ranges
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.models import jobs_with, models_at
from truck_blowout_sim.diagnosis.fit.ranked import Ranked
from truck_blowout_sim.diagnosis.fit.scatter import Scatter, independent
from truck_blowout_sim.diagnosis.fit.shown import Question, parts_of
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Ranking:
    """Linear scores of all steady candidates.

    Attributes:
        ranked: the most promising first, each supported as far as its linear column goes.
        scatter: how far apparent amounts differ from run to run in this case.
        independent: how many independent questions were asked.
        questions: with each candidate that a training run shows.
    """

    ranked: tuple[Ranked, ...]
    scatter: Scatter
    independent: float
    questions: tuple[tuple[Hypothesis, Question], ...]


def _jobs(study: Study, hypothesis: Hypothesis, named: Sequence[Hypothesis]
          ) -> list[tuple[int, Packed]]:
    """Runs and trucks to simulate for a finite difference, on top of what is named.

    Baseline runs look alike in every round and are simulated in the first.
    """
    amount = hypothesis.amount + hypothesis.effect.amount.step
    return [(i, hypothesis.apply(truck, run.recording.name, amount))
            for i, (run, truck) in enumerate(jobs_with(study, study.packed, named))
            if run.role == "train" or hypothesis.form not in study.quiet]


def rank_steady(study: Study, candidates: Sequence[Hypothesis],
                named: Sequence[Hypothesis] = (), progress: Progress | None = None) -> Ranking:
    """Linear scores of candidates without an onset.

    A candidate that a nuisance imitates is promising for what it buys with that nuisance held;
    its evidence is what it buys against a truck whose nuisance may move.
    """
    columns = _columns(study, candidates, named, progress)
    far = _far_columns(study, candidates, named, progress)
    acting = _in_training(study, columns)
    left, manner = _left(study, candidates, named), driven(study)
    cleaned = _cleaned(study, candidates, left, acting)
    ranked, shown, questions = [], [], []
    for candidate, column, acts, clean in zip(candidates, columns, acting, cleaned, strict=True):
        own, bounds = left[study.meaning(candidate)], _bounds(candidate)
        best = _clearest(own, acts, clean, far.get(candidate.form, ()), bounds)
        fall = max(best.delta - own.cost, 0.0)
        ranked.append(Ranked(candidate.at(candidate.amount + best.amount), fall, best.sigma,
                             evidence=fall, promise=best.delta))
        question = _question(study, candidate, own, column, bounds, manner)
        questions.append((candidate, question))
        shown.append(question.shown(own.residual - best.amount * clean) if question else None)
    scatter = Scatter.of([one for one in shown if one])
    ranked = [replace(r, support=scatter.support(one)) if one else r
              for r, one in zip(ranked, shown, strict=True)]
    asked = independent(np.stack(acting, axis=1), study.projector(named)) if acting else 0.0
    return Ranking(tuple(sorted(ranked, key=lambda r: (-r.promise, r.hypothesis.key))), scatter,
                   asked, tuple((which, one) for which, one in questions if one))


def _in_training(study: Study, columns: Sequence[Floats]) -> list[Floats]:
    """The columns where a candidate may act: zero in baseline runs."""
    rows = row_ranges(study)
    trained = np.zeros(study.columns.shape[0])
    for i in study.train:
        trained[rows[i]] = 1.0
    return [column * trained for column in columns]


@dataclass(frozen=True, eq=False)
class _Left:
    """What the nuisances leave of the residual where one of their numbers is held.

    ``cost``: by how much more its squares sum up than with that number free.
    """

    projector: Projector
    residual: Floats
    cost: float


def _left(study: Study, candidates: Sequence[Hypothesis], named: Sequence[Hypothesis]
          ) -> dict[str, _Left]:
    """By the number that a candidate holds."""
    residual, found = study.residual(), dict[str, _Left]()
    free = study.projector(named).chi2(residual)
    for candidate in candidates:
        held = study.meaning(candidate)
        if held not in found:
            projector = study.projector([*named, candidate])
            removed = projector.remove(residual)
            found[held] = _Left(projector, removed, float(residual @ removed) - free)
    return found


def _cleaned(study: Study, candidates: Sequence[Hypothesis], left: Mapping[str, _Left],
             columns: Sequence[Floats]) -> list[Floats]:
    """What the nuisances leave of each candidate's column, all that hold one number at once."""
    found, groups = dict[int, Floats](), dict[str, list[int]]()
    for k, candidate in enumerate(candidates):
        groups.setdefault(study.meaning(candidate), []).append(k)
    for held, which in groups.items():
        clean = left[held].projector.remove(np.stack([columns[k] for k in which], axis=1))
        found |= {k: np.ascontiguousarray(clean[:, j]) for j, k in enumerate(which)}
    return [found[k] for k in range(len(columns))]


def _bounds(candidate: Hypothesis) -> tuple[float, float]:
    """Between which the amount lies, from where it is now."""
    amount = candidate.effect.amount
    return amount.low - candidate.amount, amount.high - candidate.amount


def _clearest(left: _Left, acts: Floats, clean: Floats, far: Sequence[Floats],
              bounds: tuple[float, float]) -> Score:
    """Of a small amount, or a large one of the grid, whichever explains most."""
    small = score(left.projector, left.residual, acts, *bounds, clean)
    return max((small, *(score(left.projector, left.residual, one, *bounds) for one in far)),
               key=lambda s: s.delta)


def _question(study: Study, candidate: Hypothesis, left: _Left, column: Floats,
              bounds: tuple[float, float], manner: Sequence[Floats]) -> Question | None:
    """What is asked of all runs for the candidate's amount; ``manner``: see :func:`driven`."""
    parts = [part for i, rows in enumerate(row_ranges(study)) for part in parts_of(
        study.runs[i], rows.start, column[rows], i in study.train, study.settings.episode_s,
        manner[i])]
    return Question.of(left.projector, left.residual, parts,
                       candidate.effect.strays(study.packed, study.grip_used), bounds)


def _far_columns(study: Study, candidates: Sequence[Hypothesis], named: Sequence[Hypothesis],
                 progress: Progress | None) -> dict[tuple[str, str, str], list[Floats]]:
    """By law, the whitened change of training per unit of a large amount, at each of its grid.

    What acts near a limit only, as a tire that levels off early, shows nothing for a small one.
    """
    starts = [c.at(a) for c in candidates for a in c.effect.amount.grid]
    found: dict[tuple[str, str, str], list[Floats]] = {}
    everything = models_at(study, starts, named, "large amounts", progress)
    for one, models in zip(starts, everything, strict=True):
        away = one.amount - one.effect.neutral(study.packed)
        column = study.stack({i: study.runs[i].change(model, study.models[i]) / away
                              for i, model in models.items()})
        found.setdefault(one.form, []).append(column)
    return found


def _columns(study: Study, candidates: Sequence[Hypothesis], named: Sequence[Hypothesis],
             progress: Progress | None) -> list[Floats]:
    """Whitened change over all runs per unit of each candidate's amount."""
    jobs = [(c, i, truck) for c in candidates for i, truck in _jobs(study, c, named)]
    parts: dict[tuple[str, str, str], dict[int, Floats]] = {c.form: {} for c in candidates}
    results = study.simulate([(study.runs[i], truck) for _, i, truck in jobs], "candidates",
                             progress)
    for (c, i, _), model in zip(jobs, results, strict=True):
        parts[c.form][i] = study.runs[i].change(model, study.models[i]) / c.effect.amount.step
    for form, found in parts.items():
        if form not in study.quiet:
            study.quiet[form] = {i: found[i] for i in study.baseline}
    return [study.stack({**study.quiet[c.form], **parts[c.form]}) for c in candidates]
