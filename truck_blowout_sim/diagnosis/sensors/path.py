"""Speed against position where no lateral speed, or no heading, was recorded.

The distance along the path is reckoned from the positions; its derivative is the size of the
velocity, which a sideslip of 3 degrees makes 0.14 % larger than the forward speed. No lateral
speed and no heading is needed.

Known limits: forward speed only; positions that jump by more than the path's own smoothing show
as noise.
Validated with: test/diagnosis/test_sensors_identities.py.
"""

from __future__ import annotations

from functools import partial

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.sensors.identities import Identity, channel_names
from truck_blowout_sim.diagnosis.sensors.signals import Signals, smoothed

FloatArray = NDArray[np.float64]

_COURSE_S = 0.5
_SLOWEST_MPS = 2.0
_SIDESLIP_MPS = 0.02  # 0.1 % of 20 m/s: what sideslip adds, as white noise under each bump


def distance_name(unit: str) -> str:
    """The reckoned channel."""
    return f"{unit}_distance_reckoned_m"


def with_distance(signals: Signals) -> Signals:
    """Signals with the distance along the path where the velocity cannot be turned into the map."""
    added = {}
    for unit in ("tractor", "trailer"):
        n = channel_names(unit)
        whole = n["vy"] in signals and n["yaw"] in signals
        if n["x"] in signals and n["y"] in signals and n["vx"] in signals and not whole:
            added[distance_name(unit)] = _distance(signals, n["x"], n["y"])
    return signals.with_values(added) if added else signals


def path_identities(signals: Signals) -> tuple[Identity, ...]:
    """Forward speed is the rate of the distance."""
    found = []
    for unit in ("tractor", "trailer"):
        if distance_name(unit) in signals:
            speed = channel_names(unit)["vx"]
            found.append(
                Identity(
                    f"{unit} speed against position", "m/s", "d(distance)/dt = vx",
                    (speed, distance_name(unit)), (), partial(_moving, speed=speed),
                    ((distance_name(unit), 1.0),), _SIDESLIP_MPS,
                )
            )  # fmt: skip
    return tuple(found)


def _moving(signals: Signals, *, speed: str) -> FloatArray:
    """The speed where the course is defined at all."""
    value = signals[speed]
    return np.asarray(np.where(np.abs(value) > _SLOWEST_MPS, value, np.nan))


def _distance(signals: Signals, east: str, north: str) -> FloatArray:
    """Positions projected on the smooth course, step by step."""
    width = _COURSE_S / signals.period_s
    x, y = signals[east], signals[north]
    course = np.arctan2(np.gradient(smoothed(y, width)), np.gradient(smoothed(x, width)))
    course = 0.5 * (np.unwrap(course)[1:] + np.unwrap(course)[:-1])
    steps = np.diff(x) * np.cos(course) + np.diff(y) * np.sin(course)
    # a gap stays a gap, and the distance goes on behind it
    total = np.concatenate([[0.0], np.cumsum(np.nan_to_num(steps))])
    return np.asarray(np.where(np.isfinite(x) & np.isfinite(y), total, np.nan))
