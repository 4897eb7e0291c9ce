"""The two loops of the rating that are too slow as plain Python: best shift, dynamic time warp.

References: Sakoe and Chiba, "Dynamic programming algorithm optimization for spoken word
recognition", IEEE ASSP 26 (1978), symmetric steps of weight 1 inside a band; ISO/TS 18571:2024.
Validated with: test/comparison/test_iso18571.py, against exhaustive search on short signals.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics.jit import core

Floats = NDArray[np.float64]

NO_CORRELATION = -2.0
_DIAGONAL, _TEST, _MODEL = 0, 1, 2


@core
def correlation(x: Floats, y: Floats) -> float:
    """Pearson's correlation; ``NO_CORRELATION`` where either signal is constant."""
    mean_x, mean_y = x.mean(), y.mean()
    xx = yy = xy = 0.0
    for i in range(x.size):
        dx, dy = x[i] - mean_x, y[i] - mean_y
        xx += dx * dx
        yy += dy * dy
        xy += dx * dy
    if xx <= 0.0 or yy <= 0.0:
        return NO_CORRELATION
    return xy / np.sqrt(xx * yy)


@core
def best_shift(test: Floats, model: Floats, largest: int) -> tuple[int, float]:
    """Samples by which the model is late (negative: early) where it correlates best.

    Of equal correlations the smallest shift counts, and late before early.

    Returns:
        Shift and its correlation, ``NO_CORRELATION`` if no shift has any.
    """
    n = test.size
    best, at = correlation(test, model), 0
    for shift in range(1, largest + 1):
        late = correlation(test[: n - shift], model[shift:])
        if late > best:
            best, at = late, shift
        early = correlation(test[shift:], model[: n - shift])
        if early > best:
            best, at = early, -shift
    return at, best


@core
def warp_distance(test: Floats, model: Floats, window: int) -> tuple[float, float]:
    """Sums of ``|model - test|`` and ``|test|`` along the warp of least squared distance.

    Args:
        test, model: signals of one length.
        window: width of the band: samples less than this apart may be paired.
    """
    n = test.size
    half = min(max(window, 1), n) - 1
    width = 2 * half + 1
    step = np.zeros((n, width), dtype=np.int8)
    above = np.full(width + 1, np.inf)  # costs of the row before; column k is j = i - half + k
    row = np.full(width + 1, np.inf)
    for i in range(n):
        row[:] = np.inf
        for k in range(width):
            j = i - half + k
            if j < 0 or j >= n:
                continue
            diagonal, from_above = above[k], above[k + 1]
            from_left = row[k - 1] if k > 0 else np.inf
            least, way = diagonal, _DIAGONAL
            if i == 0 and j == 0:
                least = 0.0
            if from_above < least:
                least, way = from_above, _TEST
            if from_left < least:
                least, way = from_left, _MODEL
            step[i, k] = way
            row[k] = least + (test[i] - model[j]) ** 2
        above, row = row, above
    return _sums(test, model, step, half)


@core
def _sums(test: Floats, model: Floats, step: NDArray[np.int8], half: int) -> tuple[float, float]:
    """Walk the warp backwards and add up what lies on it."""
    i = j = test.size - 1
    difference, norm = abs(model[j] - test[i]), abs(test[i])
    while i > 0 or j > 0:
        way = step[i, j - i + half]
        if way != _MODEL:
            i -= 1
        if way != _TEST:
            j -= 1
        difference += abs(model[j] - test[i])
        norm += abs(test[i])
    return difference, norm
