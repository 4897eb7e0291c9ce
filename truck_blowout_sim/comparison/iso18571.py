"""Objective rating of a simulated against a measured signal after ISO/TS 18571.

Four scores from 0 to 1, weighted 0.4, 0.2, 0.2, 0.2:

    corridor   1 within 0.05 max|T| of the test T, 0 beyond 0.5 max|T|, quadratic between
    phase      1 at no shift, 0 at a fifth of the interval; the shift is the one of best correlation
    magnitude  after the shift and a dynamic time warp: 1 - (sum|C - T| / sum|T|) / 0.5
    slope      of the shifted signals, 9-point mean of central differences:
               1 - (sum|C' - T'| / sum|T'|) / 2

References: ISO/TS 18571:2024, clauses 5-7; Barbat, Fu, Zhan, Yang, Gehre, "Objective rating metric
for dynamic systems", ESV 2013, 13-0448.
Known limits: the standard asks for 10 kHz signals of crash tests; here the samples are the
recording's own, so that nine points span 90 ms at 100 Hz. Where the test signal is constant there
is nothing to rate.
Validated with: test/comparison/test_iso18571.py.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.comparison.warp import best_shift, warp_distance

Floats = NDArray[np.float64]

_WEIGHTS = (0.4, 0.2, 0.2, 0.2)
_INNER, _OUTER = 0.05, 0.5
_LARGEST_SHIFT = 0.2
_WARP_WINDOW = 0.1
_LARGEST_MAGNITUDE_ERROR = 0.5
_LARGEST_SLOPE_ERROR = 2.0
_SMOOTHING = 9
_SHORTEST = 2 * _SMOOTHING
_GRADES = ((0.94, "excellent"), (0.80, "good"), (0.58, "fair"))


@dataclass(frozen=True)
class Rating:
    """Scores of one signal, 0 to 1.

    Attributes:
        corridor, phase, magnitude, slope: see the module.
        shift_s: by how much the simulated signal comes late.
    """

    corridor: float
    phase: float
    magnitude: float
    slope: float
    shift_s: float

    @property
    def overall(self) -> float:
        """Weighted sum of the four scores."""
        scores = (self.corridor, self.phase, self.magnitude, self.slope)
        return float(np.dot(_WEIGHTS, scores))

    @property
    def grade(self) -> str:
        """``excellent`` above 0.94, ``good`` above 0.80, ``fair`` above 0.58, else ``poor``."""
        return grade(self.overall)


def grade(overall: float) -> str:
    """Word of the standard for an overall rating."""
    return next((word for limit, word in _GRADES if overall > limit), "poor")


def rate(measured: Floats, simulated: Floats, period_s: float = 1.0) -> Rating:
    """Rate one signal.

    Args:
        measured: test, evenly sampled.
        simulated: model, same instants.
        period_s: sampling interval.

    Raises:
        ValueError: other lengths, too few samples, numbers that are not finite, or a constant test.
    """
    _check(measured, simulated)
    test = np.ascontiguousarray(measured, dtype=np.float64)
    model = np.ascontiguousarray(simulated, dtype=np.float64)
    shift, correlation = best_shift(test, model, int(np.floor(test.size * _LARGEST_SHIFT)))
    test_ts, model_ts = _shifted(test, model, shift)
    # A model without any motion correlates with nothing, which is not the same as being in time.
    phase = 0.0 if correlation < -1.0 else _falling(abs(shift), test.size * _LARGEST_SHIFT)
    return Rating(
        corridor=_corridor(test, model),
        phase=phase,
        magnitude=_magnitude(test_ts, model_ts),
        slope=_falling(_relative(_slope(test_ts), _slope(model_ts)), _LARGEST_SLOPE_ERROR),
        shift_s=shift * period_s,
    )


def _check(measured: Floats, simulated: Floats) -> None:
    if measured.shape != simulated.shape or measured.ndim != 1:
        raise ValueError(f"shapes {measured.shape} and {simulated.shape} differ")
    if measured.size < _SHORTEST:
        raise ValueError(f"{measured.size} samples, at least {_SHORTEST} are needed")
    if not (np.isfinite(measured).all() and np.isfinite(simulated).all()):
        raise ValueError("a signal holds finite numbers only")
    if np.ptp(measured) == 0.0:
        raise ValueError("the measured signal is constant")


def _corridor(test: Floats, model: Floats) -> float:
    """Mean over time of how far inside the corridors the model runs."""
    norm = np.abs(test).max()
    distance = np.abs(test - model) / norm
    score = np.clip((_OUTER - distance) / (_OUTER - _INNER), 0.0, 1.0) ** 2
    return float(np.where(distance <= _INNER, 1.0, score).mean())


def _magnitude(test: Floats, model: Floats) -> float:
    """Score of the difference in size that neither shift nor warp removes."""
    window = int(np.ceil(_WARP_WINDOW * test.size))
    difference, norm = warp_distance(test, model, window)
    if norm == 0.0:
        return 1.0 if difference == 0.0 else 0.0
    return _falling(difference / norm, _LARGEST_MAGNITUDE_ERROR)


def _shifted(test: Floats, model: Floats, shift: int) -> tuple[Floats, Floats]:
    """The overlapping parts once a model that is ``shift`` samples late is moved back."""
    if shift > 0:
        return test[:-shift], model[shift:]
    if shift < 0:
        return test[-shift:], model[:shift]
    return test, model


def _slope(signal: Floats) -> Floats:
    """Central differences, smoothed over nine points, over fewer towards the ends."""
    slope = np.gradient(signal)
    total = np.concatenate(([0.0], np.cumsum(slope)))
    at = np.arange(slope.size)
    half = np.minimum(np.minimum(at, slope.size - 1 - at), _SMOOTHING // 2)
    return np.asarray((total[at + half + 1] - total[at - half]) / (2 * half + 1))


def _relative(test: Floats, model: Floats) -> float:
    norm = float(np.abs(test).sum())
    difference = float(np.abs(model - test).sum())
    if norm == 0.0:
        return 0.0 if difference == 0.0 else np.inf
    return difference / norm


def _falling(error: float, limit: float) -> float:
    """1 at no error, falling in a straight line to 0 at the limit."""
    return float(max(0.0, 1.0 - error / limit))
