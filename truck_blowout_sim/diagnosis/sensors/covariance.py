"""Covariance of identity residuals, from the noise of the channels they read.

Validated with: test/diagnosis/test_sensors_windows.py (against Monte Carlo).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cholesky_banded

from truck_blowout_sim.diagnosis.sensors.identities import Identity
from truck_blowout_sim.diagnosis.sensors.noise import Noise
from truck_blowout_sim.diagnosis.sensors.windows import Windows

FloatArray = NDArray[np.float64]

Covariances = dict[
    tuple[tuple[str, ...], bytes], tuple[tuple[NDArray[np.float64], ...], NDArray[np.float64]]
]
"""Noise blocks and factor by identities and valid rows."""


# Satellite positions wander by 1.5 to 2 cm over 8 s; as a velocity error this is white with
# density 2 sigma²/tau over the bumps used here.
WANDER_M = {"tractor": 0.015, "trailer": 0.02}
WANDER_S = 8.0


def noise_blocks(
    windows: Windows, identities: Sequence[Identity], weights: FloatArray, names: Sequence[str],
    noise: Mapping[str, Noise], valid: NDArray[np.bool_],
) -> tuple[FloatArray, ...]:  # fmt: skip
    """Covariance of the rows, block by block; gains are taken as constant under one bump.

    Args:
        windows: the bumps.
        identities: in the order of the rows.
        weights: gain of each channel in each identity, (bumps, identities, channels).
        names: of the channels.
        noise: of the channels.
        valid: (bumps, identities).

    Returns:
        For each lag the covariance of a bump's rows (axis 1) with those ``lag`` later (axis 2).
    """
    sigma = np.array([white_equivalent(noise.get(name)) for name in names])
    gain = np.where(valid[:, :, None], weights * sigma, 0.0)
    differentiated = np.zeros((len(identities), len(names)))
    extra = np.zeros(len(identities))
    for a, identity in enumerate(identities):
        for channel, factor in identity.rates:
            i = names.index(channel)
            differentiated[a, i] = -factor * sigma[i]
            if channel.endswith(("_x_m", "_y_m", "_distance_reckoned_m")):
                wander_m = WANDER_M[channel.split("_")[0]]
                extra[a] = 2.0 * wander_m**2 / (WANDER_S * windows.period_s)
    moved = np.where(valid[:, :, None], differentiated[None], 0.0)
    h, d = windows.weight, windows.slope
    blocks = []
    for lag in range(windows.reach + 1):
        k = gain.shape[0] - lag
        if k <= 0:
            break
        g0, g1, m0, m1 = gain[:k], gain[lag:], moved[:k], moved[lag:]
        block = windows.overlap(h, h, lag) * np.einsum("kai,kbi->kab", g0, g1)
        block += windows.overlap(h, d, lag) * np.einsum("kai,kbi->kab", g0, m1)
        block += windows.overlap(d, h, lag) * np.einsum("kai,kbi->kab", m0, g1)
        block += windows.overlap(d, d, lag) * np.einsum("kai,kbi->kab", m0, m1)
        wander = windows.overlap(h, h, lag) * extra * (valid[:k] & valid[lag:])
        own = np.arange(len(identities))
        block[:, own, own] += wander
        if lag == 0:
            block[:, own, own] += np.array([i.model_sigma**2 for i in identities]) * valid
        blocks.append(block)
    return tuple(blocks)


def white_equivalent(noise: Noise | None) -> float:
    """Sigma of white noise with the same power at low frequency."""
    if noise is None:
        return 0.0
    return noise.sigma * float(np.sqrt(noise.correlation_s / noise.period_s))


def cholesky_factor(blocks: Sequence[FloatArray], valid: NDArray[np.bool_]) -> FloatArray:
    """Banded Cholesky factor; rows that are not valid get unit variance."""
    count, width = valid.shape
    band = np.zeros((len(blocks) * width, count * width))
    a, b = np.meshgrid(np.arange(width), np.arange(width), indexing="ij")
    for lag, block in enumerate(blocks):
        column = np.arange(block.shape[0])[:, None, None] * width + a
        offset = np.broadcast_to(lag * width + b - a, block.shape)
        lower = offset >= 0
        band[offset[lower], column[lower]] = block[lower]
    band[0, ~valid.ravel()] = 1.0
    return np.asarray(cholesky_banded(band, lower=True, check_finite=False))
