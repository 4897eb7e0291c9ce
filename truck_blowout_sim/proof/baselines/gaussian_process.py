"""A Gaussian process on what the recalibrated model leaves.

Squared-exponential kernel with one length for all inputs, plus the instrument's noise; length and
size by the marginal likelihood on a grid, all channels sharing the length. Exact, on at most
MOST_POINTS bins.

References: C. E. Rasmussen, C. K. I. Williams, "Gaussian Processes for Machine Learning", 2006,
algorithm 2.1.
Validated with: test/proof/test_baselines.py.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve
from scipy.spatial.distance import cdist

from truck_blowout_sim.proof.baselines.features import Stretch

Floats = NDArray[np.float64]
MOST_POINTS = 400
_LENGTHS = (0.3, 1.0, 3.0)
_NOISE_SHARES = (0.1, 0.5, 1.0)  # variance of the noise over that of the signal


def predict_residual(learned: Sequence[Stretch], unseen: Stretch, names: Sequence[str]) -> Floats:
    """[n, len(names)] predicted measured - model of a run that was not learned from."""
    inputs = np.concatenate([s.inputs for s in learned])
    wide = np.where(inputs.std(axis=0) > 1e-6, inputs.std(axis=0), np.inf)
    known, asked = inputs / wide, unseen.inputs / wide
    result = np.zeros((unseen.inputs.shape[0], len(names)))
    for k, name in enumerate(names):
        target = np.concatenate([s.column(name) for s in learned])
        use = np.flatnonzero(np.isfinite(target))
        use = use[:: max(1, -(-use.size // MOST_POINTS))]
        if use.size > 2:
            result[:, k] = gaussian_process(known[use], target[use], asked)
    return result


def gaussian_process(x: Floats, y: Floats, asked: Floats) -> Floats:
    """Posterior mean at ``asked`` [n, d], from ``y`` at ``x``; zero far from the data."""
    size = float(np.mean(y**2))
    if size == 0.0:
        return np.zeros(asked.shape[0])
    squares = cdist(x, x, "sqeuclidean")
    best, chosen = -np.inf, (1.0, 1.0)
    for length in _LENGTHS:
        for share in _NOISE_SHARES:
            value = _log_likelihood(np.exp(-0.5 * squares / length**2), y, size, share)
            if value > best:
                best, chosen = value, (length, share)
    length, share = chosen
    factor = cho_factor(np.exp(-0.5 * squares / length**2) + share * np.eye(y.size))
    cross = np.exp(-0.5 * cdist(asked, x, "sqeuclidean") / length**2)
    return np.asarray(cross @ cho_solve(factor, y))


def _log_likelihood(kernel: Floats, y: Floats, size: float, share: float) -> float:
    """Log marginal likelihood up to a constant; signal and noise together have variance size."""
    scale = size / (1.0 + share)
    factor = cho_factor(scale * (kernel + share * np.eye(y.size)))
    return float(-0.5 * y @ cho_solve(factor, y) - np.log(np.diag(factor[0])).sum())
