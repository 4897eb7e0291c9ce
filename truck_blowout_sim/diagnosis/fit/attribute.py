"""Rank the candidates: one sensitivity a candidate, nuisances projected out."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.case.driven import driven
from truck_blowout_sim.diagnosis.case.study import Progress, Study, row_ranges
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.linear import score
from truck_blowout_sim.diagnosis.fit.models import models_at, with_effects
from truck_blowout_sim.diagnosis.fit.scatter import Scatter, independent
from truck_blowout_sim.diagnosis.fit.shown import Question, parts_of
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Ranked:
    """A hypothesis with the evidence for it.

    Attributes:
        delta: fall of the sum of squares, nuisances refitted.
        sigma: standard error of the amount.
        refitted: whether the amount comes from the nonlinear refit.
        evidence: fall against a truck whose own number of this meaning stays within two prior
            sigmas; equals ``delta`` where calibration has no such number.
        promise: linear fall with that number held, by which candidates are ranked before a refit.
        support: twice the log of the likelihood ratio, the amount allowed to scatter from run to
            run, less what choosing its instants brings by chance; see `scatter.py`.
        unseen: share of the support of an event that unseen runs add to what the others say.
    """

    hypothesis: Hypothesis
    delta: float
    sigma: float
    refitted: bool = False
    evidence: float = 0.0
    promise: float = 0.0
    support: float = 0.0
    unseen: float = 0.0


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
    """Runs and trucks to simulate for a finite difference: what is named acts in training only.

    Baseline runs look alike in every round and are simulated in the first.
    """
    amount = hypothesis.amount + hypothesis.effect.amount.step
    runs = study.train if hypothesis.form in study.quiet else range(len(study.runs))
    return [(i, hypothesis.apply(
        with_effects(study.packed, named if i in study.train else (),
                     study.runs[i].recording.name), study.runs[i].recording.name, amount))
            for i in runs]


def rank_steady(study: Study, candidates: Sequence[Hypothesis],
                named: Sequence[Hypothesis] = (), progress: Progress | None = None) -> Ranking:
    """Linear scores of candidates without an onset.

    A candidate that a nuisance imitates is promising for what it buys with that nuisance held;
    its evidence is what it buys against a truck whose nuisance may move.
    """
    columns = _columns(study, candidates, named, progress)
    residual, rows = study.residual(), row_ranges(study)
    usual = study.projector(named)
    free, episode_s = usual.chi2(residual), study.settings.episode_s
    manner = driven(study)
    ranked, shown, questions, trained = [], [], [], np.zeros(residual.size)
    for i in study.train:
        trained[rows[i]] = 1.0
    cleaned: dict[str, Floats] = {}  # by the number that is held
    far = _far_columns(study, candidates, named, progress)
    acting = [column * trained for column in columns]
    cleaned_of = _cleaned(study, candidates, named, acting)
    for candidate, column, acts, clean in zip(candidates, columns, acting, cleaned_of,
                                              strict=True):
        amount, at = candidate.effect.amount, candidate.amount
        projector = study.projector([*named, candidate])
        held = study.meaning(candidate)
        removed = cleaned[held] if held in cleaned else projector.remove(residual)
        cleaned[held] = removed
        low, high = amount.low - at, amount.high - at
        found = max((score(projector, removed, acts, low, high, clean),
                     *(score(projector, removed, one, low, high)
                       for one in far.get(candidate.form, ()))), key=lambda s: s.delta)
        fall = max(found.delta - (float(residual @ removed) - free), 0.0)
        ranked.append(Ranked(candidate.at(at + found.amount), fall, found.sigma, evidence=fall,
                             promise=found.delta))
        question = Question.of(projector, removed, [
            part for i, at_i in enumerate(rows) for part in parts_of(
                study.runs[i], at_i.start, column[at_i], i in study.train, episode_s, manner[i])],
            candidate.effect.strays(study.packed, study.grip_used), (low, high))
        questions.append((candidate, question))
        shown.append(question.shown(removed - found.amount * clean) if question else None)
    scatter = Scatter.of([one for one in shown if one])
    ranked = [replace(r, support=scatter.support(one)) if one else r
              for r, one in zip(ranked, shown, strict=True)]
    asked = np.stack(acting, axis=1) if columns else np.zeros((0, 0))
    return Ranking(tuple(sorted(ranked, key=lambda r: (-r.promise, r.hypothesis.key))), scatter,
                   independent(asked, usual) if columns else 0.0,
                   tuple((which, one) for which, one in questions if one))


def _cleaned(study: Study, candidates: Sequence[Hypothesis], named: Sequence[Hypothesis],
             columns: Sequence[Floats]) -> list[Floats]:
    """What the nuisances leave of each candidate's column, all that hold one number at once."""
    found, groups = dict[int, Floats](), dict[str, list[int]]()
    for k, candidate in enumerate(candidates):
        groups.setdefault(study.meaning(candidate), []).append(k)
    for which in groups.values():
        projector = study.projector([*named, candidates[which[0]]])
        clean = projector.remove(np.stack([columns[k] for k in which], axis=1))
        found |= {k: np.ascontiguousarray(clean[:, j]) for j, k in enumerate(which)}
    return [found[k] for k in range(len(columns))]


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
