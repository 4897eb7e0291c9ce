"""How much later or earlier than recorded a channel fits best.

A rating forgives a shift (ISO/TS 18571 aligns curves by up to a fifth of their length before it
looks at their shape), so a gyro that is 0.4 s late may be rated excellent.

References: the shift of least squared error; the parabola through its neighbors refines it.
Known limits: shifts up to `FURTHEST_S`; a channel that hardly changes has no lag.
Validated with: test/comparison/test_lag.py.
"""

from __future__ import annotations

import numpy as np

from truck_blowout_sim.comparison.pairing import Pair

FURTHEST_S = 1.0  # drivers react within a second; instruments and filters are faster
GRID_S = 0.01
REMAINING = 2.0 / 3.0  # a lag counts where it leaves at most this part of the rms error


def best_lag_s(pair: Pair, resolved: float = 0.0) -> float | None:
    """Shift [s] by which the model fits best, positive: the model comes too early.

    None where the best shift lies at the end of the search, or removes less than a third of the
    rms error, or less of it than ``resolved``, what an instrument resolves: then nothing says that
    the difference is one of time.
    """
    start, end = float(pair.time_s[0]) + FURTHEST_S, float(pair.time_s[-1]) - FURTHEST_S
    if end - start < 2.0 * FURTHEST_S:
        return None
    grid = np.arange(start, end, GRID_S)
    measured = np.interp(grid, pair.time_s, pair.measured)
    shifts = np.arange(-FURTHEST_S, FURTHEST_S + 0.5 * GRID_S, GRID_S)
    errors = np.array([
        np.mean((np.interp(grid - shift, pair.time_s, pair.model) - measured) ** 2)
        for shift in shifts
    ])  # fmt: skip
    k = int(np.argmin(errors))
    unshifted = errors[shifts.size // 2]
    if k in (0, shifts.size - 1) or errors[k] > REMAINING**2 * unshifted:
        return None
    if np.sqrt(unshifted) - np.sqrt(errors[k]) < resolved:
        return None
    left, middle, right = errors[k - 1 : k + 2]
    bend = left - 2.0 * middle + right
    return float(shifts[k] + (0.5 * GRID_S * (left - right) / bend if bend > 0.0 else 0.0))
