"""What the model gives with hypotheses in force, on top of one another."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.case.simulations import Job
from truck_blowout_sim.diagnosis.case.study import Progress, Study
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]


def with_effects(packed: Packed, effects: Sequence[Hypothesis], run: str) -> Packed:
    """The truck with several hypotheses in force."""
    for effect in effects:
        packed = effect.apply(packed, run)
    return packed


def jobs_with(study: Study, truck: Packed, named: Sequence[Hypothesis]) -> list[Job]:
    """A truck over all fitted runs: what is named acts in training only."""
    return [(run, with_effects(truck, named if run.role == "train" else (), run.recording.name))
            for run in study.runs]


def unseen_jobs(study: Study, truck: Packed, placed: Sequence[Sequence[Hypothesis]]) -> list[Job]:
    """A truck over all unseen runs, with what is placed in each."""
    return [(run, with_effects(truck, effects, run.recording.name))
            for run, effects in zip(study.holdout, placed, strict=True)]


def models_at(study: Study, hypotheses: Sequence[Hypothesis], named: Sequence[Hypothesis],
              what: str = "", progress: Progress | None = None) -> list[dict[int, Floats]]:
    """Training models under each hypothesis, on top of those already named.

    ``what``, ``progress``: see :meth:`Study.simulate`.
    """
    jobs = [study.job(study.runs[i], with_effects(
        study.packed, named, study.runs[i].recording.name), h)
        for h in hypotheses for i in study.train]
    results = study.simulate(jobs, what, progress)
    n = len(study.train)
    return [dict(zip(study.train, results[k * n:(k + 1) * n], strict=True))
            for k in range(len(hypotheses))]


def models_of(study: Study, cases: Sequence[Sequence[Hypothesis]]) -> list[dict[int, Floats]]:
    """Training models of each set of hypotheses, all of a set in force from the start."""
    results = iter(study.simulate([
        (study.runs[i], with_effects(study.packed, case, study.runs[i].recording.name))
        for case in cases for i in study.train]))
    return [{i: next(results) for i in study.train} for _ in cases]
