"""Where each unit of a truck was: recorded where recorded, otherwise from what was.

Position without a recorded position is the integral of the velocity. A trailer without a recorded
heading has that of its articulation angle or of its yaw rate, else it rolls behind its kingpin
without side slip. A trailer's place is always behind its kingpin.

References: kinematics of a towed axle (tractrix), any text on articulated vehicles.
Known limits: the trailer that follows without side slip is right at low speed only.
Validated with: test/motion/test_motion.py.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from truck_blowout_sim.motion.source import Floats, Source
from truck_blowout_sim.vehicle import Vehicle
from truck_blowout_sim.vehicle.places import hitch_of

PLACE = "place of the"
"""Begins every sentence on a place that was not recorded."""

_HEADING_FROM_S = 1.0  # the first second of a path gives its heading
_LEAST_PATH_M = 0.5


@dataclass(frozen=True, eq=False)
class UnitTrack:
    """Pose of a unit's ``base_link`` at every instant; SI, axes after ISO 8855."""

    x_m: Floats
    y_m: Floats
    z_m: Floats
    yaw_rad: Floats
    roll_rad: Floats
    pitch_rad: Floats


def unit_tracks(source: Source, vehicle: Vehicle) -> dict[str, UnitTrack]:
    """The track of every unit, front to rear."""
    first = vehicle.units[0]
    tracks = {first: _leading(source, vehicle, first)}
    for unit in vehicle.units[1:]:
        tracks[unit] = _towed(source, vehicle, tracks[first], first, unit)
    return tracks


def _leading(source: Source, vehicle: Vehicle, unit: str) -> UnitTrack:
    x, y = source.get(f"{unit}_x_m"), source.get(f"{unit}_y_m")
    yaw = _heading(source, unit, x, y)
    if x is None or y is None:
        x, y = _dead_reckoned(source, unit, yaw, x, y)
    level = np.full(yaw.size, _sheet_height_m(vehicle, unit))
    return UnitTrack(x, y, *_attitude(source, unit, yaw, level))


def _heading(source: Source, unit: str, x: Floats | None, y: Floats | None) -> Floats:
    yaw = source.angle(f"{unit}_yaw_rad")
    if yaw is not None:
        return yaw
    rate = source.get(f"{unit}_yaw_rate_radps")
    first = _first_course(source, x, y)
    if rate is not None:
        source.assume(f"heading of the {unit}: its yaw rate, integrated")
        return first + source.integral(rate)
    if x is not None and y is not None:
        source.assume(f"heading of the {unit}: the direction of its path")
        return _course(x, y, first)
    source.assume(f"heading of the {unit}: straight ahead, neither yaw nor yaw rate was recorded")
    return np.zeros(source.times_s.size)


def _first_course(source: Source, x: Floats | None, y: Floats | None) -> float:
    if x is None or y is None:
        return 0.0
    last = min(int(np.searchsorted(source.times_s, source.times_s[0] + _HEADING_FROM_S)),
               source.times_s.size - 1)
    dx, dy = float(x[last] - x[0]), float(y[last] - y[0])
    return math.atan2(dy, dx) if math.hypot(dx, dy) > _LEAST_PATH_M else 0.0


def _course(x: Floats, y: Floats, first: float) -> Floats:
    """Direction of the path; held while the truck stands."""
    dx, dy = np.gradient(x), np.gradient(y)
    moving = np.hypot(dx, dy) > 1e-4 * _LEAST_PATH_M
    course = np.where(moving, np.arctan2(dy, dx), np.nan)
    held = np.maximum.accumulate(np.where(moving, np.arange(x.size), -1))
    filled = np.where(held >= 0, course[np.maximum(held, 0)], first)
    return np.unwrap(np.nan_to_num(filled, nan=first))


def _dead_reckoned(source: Source, unit: str, yaw: Floats, x: Floats | None, y: Floats | None
                   ) -> tuple[Floats, Floats]:
    forward, known = source.or_constant(f"{unit}_vx_mps", 0.0)
    left, slipping = source.or_constant(f"{unit}_vy_mps", 0.0)
    if not known:
        source.assume(f"{PLACE} {unit}: it is drawn standing, neither position nor speed was"
                      " recorded")
    else:
        source.assume(f"{PLACE} {unit}: its speed, integrated"
                      + ("" if slipping else ", without side slip"))
    c, s = np.cos(yaw), np.sin(yaw)
    along = source.integral(forward * c - left * s)
    across = source.integral(forward * s + left * c)
    return (along if x is None else x), (across if y is None else y)


def _sheet_height_m(vehicle: Vehicle, unit: str) -> float:
    return vehicle.unit_specs[unit].base_link.z_m


def _attitude(source: Source, unit: str, yaw: Floats, level: Floats
              ) -> tuple[Floats, Floats, Floats, Floats]:
    """Height, yaw, roll, pitch: upright and at a given height where not recorded."""
    height = source.get(f"{unit}_z_m")
    if height is None:
        source.assume(f"height of the {unit}: that of the vehicle file")
        height = level
    angles = []
    for angle in ("roll", "pitch"):
        value = source.get(f"{unit}_{angle}_rad")
        if value is None:
            source.assume(f"{angle} of the {unit}: none, it was not recorded")
            value = np.zeros(source.times_s.size)
        angles.append(value)
    return height, yaw, angles[0], angles[1]


def _towed(source: Source, vehicle: Vehicle, ahead: UnitTrack, first: str, unit: str) -> UnitTrack:
    """The unit behind: heading as recorded or as it follows, place behind its kingpin."""
    front, own = hitch_of(vehicle, first)[0], hitch_of(vehicle, unit)[0]
    kingpin_x = ahead.x_m + front * np.cos(ahead.yaw_rad)
    kingpin_y = ahead.y_m + front * np.sin(ahead.yaw_rad)
    yaw = _towed_heading(source, vehicle, ahead, unit, kingpin_x, kingpin_y)
    x, y = kingpin_x - own * np.cos(yaw), kingpin_y - own * np.sin(yaw)
    # a receiver gives an altitude: what is towed stays on the road of what tows it
    level = ahead.z_m + (_sheet_height_m(vehicle, unit) - _sheet_height_m(vehicle, first))
    return UnitTrack(x, y, *_attitude(source, unit, yaw, level))


def _towed_heading(source: Source, vehicle: Vehicle, ahead: UnitTrack, unit: str, x: Floats,
                   y: Floats) -> Floats:
    yaw = source.angle(f"{unit}_yaw_rad")
    if yaw is not None:
        return yaw
    fold = source.angle("articulation_rad")
    if fold is not None:
        return ahead.yaw_rad + fold
    rate = source.get(f"{unit}_yaw_rate_radps")
    if rate is not None:
        source.assume(f"heading of the {unit}: its yaw rate, integrated from in line")
        return ahead.yaw_rad[0] + source.integral(rate)
    source.assume(f"heading of the {unit}: it rolls behind its kingpin without side slip,"
                  " nothing of it was recorded")
    return _tractrix(x, y, float(ahead.yaw_rad[0]), _reach(vehicle, unit))


def _reach(vehicle: Vehicle, unit: str) -> float:
    """From the kingpin to the middle of a unit's axles."""
    spec = vehicle.unit_specs[unit]
    axles = [axle.x_m for axle in vehicle.spec.axles.values() if axle.unit == unit]
    return float(np.mean(axles)) - (spec.hitch.x_m if spec.hitch else 0.0)


def _tractrix(x: Floats, y: Floats, yaw: float, reach_m: float) -> Floats:
    out = np.empty(x.size)
    out[0] = yaw
    for k in range(1, x.size):
        dx, dy = x[k] - x[k - 1], y[k] - y[k - 1]
        yaw += (dy * math.cos(yaw) - dx * math.sin(yaw)) / reach_m
        out[k] = yaw
    return out
