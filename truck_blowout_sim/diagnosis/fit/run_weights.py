"""How much each run weighs: less where it is left with more than its widths allow.

A run that nothing explains, as one in which the truck jackknifes, would otherwise set the nuisances
of all. Weights and nuisances are fitted in turn until neither moves.

References: Birge 1932 (widths by what is left); Holland and Welsch 1977 (iteratively reweighted
least squares).
Known limits: a run weighs as one; where two runs contradict each other, the better explained one
wins.
Validated with: test/diagnosis/test_run_weights.py.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.algebra.linear import Projector
from truck_blowout_sim.diagnosis.case.runs import Run
from truck_blowout_sim.diagnosis.case.study import Study, rows_of

Floats = NDArray[np.float64]
_ROUNDS = 30
_SETTLED = 0.05  # weights change by a smaller share


def run_weights(study: Study, projector: Projector, rest: Floats) -> Floats:
    """[rows] the weight of each row's run, 1 at most.

    Args:
        study: the case.
        projector: of the nuisances, over the rows.
        rest: [rows] what they are to explain: of the fitted runs, and of the unseen ones behind
            these if there are so many rows.
    """
    every = (*study.runs, *study.holdout)
    runs = [(run, rows) for run, rows in zip(every, rows_of(every), strict=True)
            if rows.start < rest.size]
    kept = np.ix_(projector.kept, projector.kept)
    grams = np.stack([study.gram(k)[kept] for k in range(len(runs))])
    common = np.stack([projector.reach(rest[rows], rows) for _, rows in runs])
    weights: Floats = np.ones(len(runs))
    for _ in range(_ROUNDS):
        amounts: Floats = np.asarray(np.linalg.solve(
            np.eye(projector.kept.size) + np.tensordot(weights, grams, 1), weights @ common),
            dtype=np.float64)
        left = rest - projector.explained(amounts)
        before, weights = weights, np.array([_weight(run, left[rows]) for run, rows in runs])
        if np.allclose(weights, before, rtol=_SETTLED, atol=0.0):
            break
    found: Floats = np.ones(rest.size)
    for weight, (_, rows) in zip(weights, runs, strict=True):
        found[rows] = weight
    return found


def weighed(study: Study, projector: Projector, weights: Floats) -> Projector:
    """The same nuisances over rows that are multiplied by the root of their run's weight."""
    every = (*study.runs, *study.holdout)
    rows = [at for at in rows_of(every) if at.start < weights.size]
    gram = np.sum([weights[at.start] * study.gram(k) for k, at in enumerate(rows)], axis=0)
    return Projector.of(projector.columns * np.sqrt(weights)[:, None], projector.kept.tolist(),
                        np.asarray(gram))


def _weight(run: Run, left: Floats) -> float:
    """By the mean square of what is left of the samples that there are."""
    seen = max(int(np.isfinite(run.measured).sum()), 1)
    return 1.0 / max(float(left @ left) / seen, 1.0)
