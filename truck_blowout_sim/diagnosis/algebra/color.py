"""The color of what good models leave: each channel's residual as an autoregression.

What a model leaves of a channel lasts, swings as the body on its springs does, or trembles as on a
bad road. Least squares wants it white, so what the bins before foretell is taken from each bin,

    w_t = (z_t - sum_k a_k z_(t-k)) / s,    k = 1 .. p,

and the first p bins by the shorter autoregressions of the same autocovariance, so that the whole is
exactly white for a process of that color. The same is done to every column.

References: Levinson 1946 and Durbin 1960 (autoregressions of each length from an autocovariance);
Cochrane and Orcutt 1949 (least squares with such errors); Worsley et al. 2002 (the same in brain
imaging).
Known limits: one color a channel in all runs; a bin without a sample counts as one that the model
met.
Validated with: test/diagnosis/test_color.py (exact against a dense covariance; there and back).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Color:
    """Autoregressions of some channels.

    Attributes:
        foretold: [m, p + 1, p] share of each of the p bins before, the last one first, in a bin
            that has none, one, ... or p before it.
        surprise: [m, p + 1] standard deviation of what is not foretold, in widths.
    """

    foretold: Floats
    surprise: Floats

    @staticmethod
    def white(channels: int) -> Color:
        """Nothing is foretold."""
        return Color(np.zeros((channels, 1, 0)), np.ones((channels, 1)))

    @staticmethod
    def of(autocovariances: Floats) -> Color:
        """From autocovariances [m, p + 1], lag 0 first."""
        both = [_levinson(one) for one in autocovariances]
        return Color(np.stack([a for a, _ in both]), np.stack([s for _, s in both]))

    @staticmethod
    def joined(each: Sequence[Color | None], lags: int) -> Color:
        """Of several channels; None: white."""
        white = Color.of(np.eye(1, lags + 1))
        return Color(*(np.concatenate([getattr(one or white, name) for one in each])
                       for name in ("foretold", "surprise")))

    @property
    def lags(self) -> int:
        """How many bins before are asked, p."""
        return int(self.foretold.shape[2])

    def whitened(self, z: Floats) -> Floats:
        """[n, m, ...] of a residual [n, m, ...] in widths."""
        if not self.lags and np.all(self.surprise == 1.0):
            return z
        first, left = min(self.lags, z.shape[0]), np.empty_like(z)
        left[:first] = np.einsum("mts,sm...->tm...", self._begins[:, :first, :first], z[:first])
        if z.shape[0] > self.lags:
            before = sliding_window_view(z, self.lags + 1, axis=0)
            left[self.lags:] = np.einsum("tm...k,mk->tm...", before, self._goes_on)
        return left

    @cached_property
    def _begins(self) -> Floats:
        """[m, p, p] what each of the first p bins takes from itself and those before it."""
        p = self.lags
        taken: Floats = np.zeros((len(self.foretold), p, p))
        for t in range(p):
            taken[:, t, t] = 1.0
            taken[:, t, :t] = -self.foretold[:, t, :t][:, ::-1]
        return taken / self.surprise[:, :p, None]

    @cached_property
    def _goes_on(self) -> Floats:
        """[m, p + 1] the same of every later bin, itself last."""
        taken = np.concatenate([-self.foretold[:, -1, ::-1], np.ones((len(self.foretold), 1))], 1)
        return np.asarray(taken / self.surprise[:, -1:])

    def colored(self, white: Floats) -> Floats:
        """The reverse of :meth:`whitened`."""
        if not self.lags and np.all(self.surprise == 1.0):
            return white
        z, shape = np.zeros_like(white), (-1, *(1,) * (white.ndim - 2))
        for t in range(white.shape[0]):
            order = min(t, self.lags)
            z[t] = white[t] * self.surprise[:, order].reshape(shape)
            for k in range(1, order + 1):
                z[t] += self.foretold[:, order, k - 1].reshape(shape) * z[t - k]
        return z


def autocovariance(series: Floats, lags: int) -> Floats:
    """Sums of products [lags + 1] of a series with itself, some bins later; for pooling."""
    n = series.size
    return np.array([float(series[k:] @ series[:n - k]) if k < n else 0.0
                     for k in range(lags + 1)])


def _levinson(covariance: Floats) -> tuple[Floats, Floats]:
    """Autoregressions of each length [p + 1, p], and standard deviations [p + 1] of surprise."""
    p = covariance.size - 1
    foretold, variance = np.zeros((p + 1, p)), np.zeros(p + 1)
    variance[0] = covariance[0]
    for k in range(1, p + 1):
        before = foretold[k - 1, :k - 1]
        reflection = (covariance[k] - before @ covariance[k - 1:0:-1]) / variance[k - 1]
        foretold[k, :k - 1] = before - reflection * before[::-1]
        foretold[k, k - 1] = reflection
        variance[k] = variance[k - 1] * (1.0 - reflection**2)
    return foretold, np.sqrt(variance)
