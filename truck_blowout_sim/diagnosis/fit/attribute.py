"""Rank the candidates: one sensitivity a candidate, nuisances projected out."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.case.runs import Run
from truck_blowout_sim.diagnosis.case.study import Progress, Study
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.linear import Projector, Score, score
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
    """

    hypothesis: Hypothesis
    delta: float
    sigma: float
    refitted: bool = False
    evidence: float = 0.0
    promise: float = 0.0


def with_effects(packed: Packed, effects: Sequence[Hypothesis], run: str) -> Packed:
    """The truck with several hypotheses in force."""
    for effect in effects:
        packed = effect.apply(packed, run)
    return packed


def column_of(study: Study, hypothesis: Hypothesis, named: Sequence[Hypothesis],
              step: float) -> list[tuple[int, Packed]]:
    """Training runs and trucks to simulate for a finite difference of ``step``."""
    return [(i, hypothesis.apply(
        with_effects(study.packed, named, study.runs[i].recording.name),
        study.runs[i].recording.name, hypothesis.amount + step)) for i in study.train]


def rank_steady(study: Study, candidates: Sequence[Hypothesis],
                named: Sequence[Hypothesis] = (), progress: Progress | None = None
                ) -> tuple[Ranked, ...]:
    """Linear scores of candidates without an onset, the most promising first.

    A candidate that a nuisance imitates is promising for what it buys with that nuisance held;
    its evidence is what it buys against a truck whose nuisance may move.
    """
    jobs = [job for c in candidates for job in column_of(study, c, named, c.effect.amount.step)]
    results: list[Floats] = []
    portion = 24
    for first in range(0, len(jobs), portion):
        part = jobs[first:first + portion]
        results += study.simulate([(study.runs[i], truck) for i, truck in part])
        if progress:
            progress("candidates", len(results) / len(jobs))
    residual = study.residual()
    free = study.projector(named).chi2(residual)
    ranked: list[Ranked] = []
    cleaned: dict[str, Floats] = {}  # by the number that is held
    k = 0
    for candidate in candidates:
        parts = {}
        for i in study.train:
            parts[i] = study.runs[i].change(results[k], study.models[i])
            k += 1
        amount = candidate.effect.amount
        column = study.stack(parts) / amount.step
        at = candidate.amount
        projector = study.projector([*named, candidate])
        held = study.meaning(candidate)
        removed = cleaned[held] if held in cleaned else projector.remove(residual)
        cleaned[held] = removed
        found = score(projector, removed, column, amount.low - at, amount.high - at)
        fall = max(found.delta - (float(residual @ removed) - free), 0.0)
        ranked.append(Ranked(candidate.at(at + found.amount), fall, found.sigma, evidence=fall,
                             promise=found.delta))
    return tuple(sorted(ranked, key=lambda r: (-r.promise, r.hypothesis.key)))


def score_channel(study: Study, projector: Projector, removed: Floats, channel: str,
                  change: Callable[[Run, Floats], Floats]) -> Score:
    """What a change of one channel alone buys in training, where it is recorded.

    ``removed``: what is left, as :meth:`Projector.remove` gives it; ``change``: by run and its bin
    means of the channel, what these would change by for each unit of the amount.
    """
    parts = {}
    for i in study.train:
        run = study.runs[i]
        column = np.zeros(run.measured.shape)
        if channel in run.channels:
            k = run.channels.index(channel)
            column[:, k] = np.nan_to_num(change(run, run.measured[:, k]) / run.sigma[:, k])
        parts[i] = column.ravel()
    return score(projector, removed, study.stack(parts))
