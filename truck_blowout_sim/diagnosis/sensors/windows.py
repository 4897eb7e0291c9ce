"""Weak form: identities weighted with short smooth bumps instead of differentiated.

An identity ``f(channels) = d/dt c`` is multiplied with a bump ``h`` that vanishes with its slope
at both ends, and integrated; the derivative moves onto the bump, ``∫ h ċ dt = -∫ ḣ c dt``. No
noisy channel is ever differentiated, and the covariance of what is left is known exactly from
the channels' noise.

References: M. Shinbrot, NACA TN 3288 (1954), method functions; later called modulating functions.
Known limits: motion faster than about 3 Hz is averaged out.
Validated with: test/diagnosis/test_sensors_windows.py (derivative of a sine, Monte Carlo noise).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

_HALF_WIDTH_S = 0.2
_SPACING_S = 0.1
_MIN_SAMPLES = 7


@dataclass(frozen=True)
class Windows:
    """A row of equal bumps on an even grid.

    Attributes:
        weight: the bump times the sampling interval; sums to 1.
        slope: ``d/dt`` in weak form; gives the mean derivative under the bump.
        step: samples between neighbouring bumps.
        period_s: sampling interval.
    """

    weight: FloatArray
    slope: FloatArray
    step: int
    period_s: float

    @property
    def length(self) -> int:
        """Samples under one bump."""
        return int(self.weight.size)

    @property
    def reach(self) -> int:
        """Neighbours to one side that share samples with a bump."""
        return (self.length - 1) // self.step

    def count(self, samples: int) -> int:
        """Bumps that fit into a series."""
        return 0 if samples < self.length else (samples - self.length) // self.step + 1

    def centres(self, samples: int) -> NDArray[np.int64]:
        """Index of the middle sample of each bump."""
        return self.length // 2 + self.step * np.arange(self.count(samples), dtype=np.int64)

    def mean(self, values: FloatArray) -> FloatArray:
        """Weighted mean under each bump; values (..., samples) -> (..., bumps)."""
        return self._apply(values, self.weight)

    def derivative(self, values: FloatArray) -> FloatArray:
        """Mean derivative under each bump; values (..., samples) -> (..., bumps)."""
        return self._apply(values, self.slope)

    def overlap(self, first: FloatArray, second: FloatArray, lag: int) -> float:
        """Covariance of two weightings of the same unit white noise, second ``lag`` bumps later."""
        shift = lag * self.step
        return float(first[shift:] @ second[: self.length - shift])

    def _apply(self, values: FloatArray, kernel: FloatArray) -> FloatArray:
        views = sliding_window_view(values, self.length, axis=-1)[..., :: self.step, :]
        return np.asarray(views @ kernel, dtype=np.float64)


def make_windows(period_s: float) -> Windows:
    """Bumps ``(1 - u²)³`` of 0.4 s every 0.1 s, longer where sampling is slow.

    Args:
        period_s: sampling interval of the grid.
    """
    half = max(round(_HALF_WIDTH_S / period_s), _MIN_SAMPLES // 2)
    step = max(1, round(_SPACING_S / period_s))
    u = np.arange(-half, half + 1) / (half + 1.0)
    bump = (1.0 - u**2) ** 3
    slope = 6.0 * u * (1.0 - u**2) ** 2
    # Exact for straight lines on the grid: the discrete moment replaces the integral.
    slope /= slope @ (u * (half + 1.0) * period_s)
    return Windows(bump / bump.sum(), slope, step, period_s)
