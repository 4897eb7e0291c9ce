"""What a truck can do: numbers beyond it are a wrong unit, and which one is said.

References: bounds from the machine, not from data: 60 m/s is beyond any truck's top speed; a hand
wheel turns 2 to 3 times each way; a truck that spins or rolls over stays below 4 rad/s in yaw;
compressed-air systems open their relief valve below 1.3 MPa (SAE J1849, FMVSS 121); hydraulic units
of cars reach 15 to 20 MPa (ECE R13-H systems).
Validated with: test/recordings/test_mapping.py.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.recordings.channels import Channel
from truck_blowout_sim.recordings.units import GRAVITY_MPS2, Unit, find_unit, units_of

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]

_MOST = {
    "steering_wheel_angle_rad": 25.0,
    "latitude_rad": 1.5708,
    "longitude_rad": 6.2832,
    "throttle": 1.05,
    "vx_mps": 60.0,
    "vy_mps": 25.0,
    "yaw_rate_radps": 4.0,
    "roll_rate_radps": 8.0,
    "pitch_rate_radps": 8.0,
    "roll_rad": 6.4,
    "pitch_rad": 3.2,
    "ax_mps2": 300.0,
    "ay_mps2": 300.0,
    "az_mps2": 300.0,
    "hub_speed": 300.0,
    "brake_pressure": 2.5e7,
    "brake_chamber": 2.5e7,
    "tire_pressure": 2.0e6,
    "articulation_rad": 3.5,
}
AIR_BRAKES_PA = 1.5e6
_FEW, _FEW_SHARE = 3, 0.01  # glitches of a logger
_FAST_MPS = 38.0  # 85 mph, the highest speed limit for trucks: larger numbers are hardly in m/s
# What most of an ordinary drive stays below: a unit that brings the numbers there is likely meant.
_USUAL: Mapping[str, tuple[float, float]] = {
    "speed": (0.5, 45.0), "angular rate": (0.002, 1.5), "angle": (0.001, 12.0),
    "acceleration": (0.02, 15.0), "pressure": (2e4, 1.2e6), "ratio": (0.01, 1.05),
    "length": (0.1, 1e5), "force": (10.0, 2e5), "time": (0.0, 1e9),
}  # fmt: skip


def beyond(channel: Channel, values: FloatArray) -> int | None:
    """Position of the first value that no truck has, None if all are possible."""
    most = most_of(channel.name)
    if most is None:
        return None
    wrong = np.flatnonzero(np.abs(values) > most)
    return int(wrong[0]) if wrong.size else None


def lone(channel: Channel, values: FloatArray) -> BoolArray:
    """The few values that no truck has among many others: not a matter of units."""
    most = most_of(channel.name)
    wrong = np.abs(values) > (np.inf if most is None else most)
    count = np.count_nonzero(wrong)
    few = count <= _FEW and count < _FEW_SHARE * values.size
    return wrong if few else np.zeros(values.size, dtype=bool)


def hydraulic(channel: Channel, values: FloatArray) -> str:
    """A note on a brake pressure that air brakes do not have; empty where it is lower."""
    most = float(np.max(values, initial=0.0))
    if not channel.name.startswith("brake_") or most <= AIR_BRAKES_PA:
        return ""
    return (f"{channel.name} reaches {most / 1e5:.0f} bar: hydraulic brakes have that; with air"
            " brakes the unit is another one")


def most_of(name: str) -> float | None:
    """Largest magnitude that a truck has in a channel, None where nothing is known."""
    stem = name.removeprefix("tractor_").removeprefix("trailer_")
    if stem in _MOST:
        return _MOST[stem]
    return next((most for start, most in _MOST.items() if name.startswith(start)), None)


def unit_by_size(numbers: FloatArray, channel: str, quantity: str) -> str:
    """The unit of a quantity under which the numbers are those of an ordinary drive."""
    told = np.abs(numbers[np.isfinite(numbers)])
    if not told.size:
        return ""
    high, middle = float(np.percentile(told, 99.0)), float(np.median(told))
    if quantity == "acceleration":
        if channel.endswith("az_mps2"):
            return "g" if abs(middle - 1.0) < abs(middle - GRAVITY_MPS2) else "m/s2"
        return "g" if high < 1.0 else "m/s2"
    if quantity == "pressure":
        # 1.2 to 2.5 MPa: above air brakes and truck tires, so bar, as of a car's tires
        limits = ((1.2, "MPa"), (16.0, "bar"), (250.0, "psi"), (2500.0, "kPa"))
        return next((name for most, name in limits if high < most), "Pa")
    if quantity == "ratio":
        return "%" if high > (most_of(channel) or 1.05) else "1"
    if channel.endswith(("latitude_rad", "longitude_rad")):
        return "deg" if high <= 180.0 else "arcmin"
    limits_by = {"speed": _FAST_MPS, "angular rate": 1.2, "angle": _angle_limit(channel)}
    si, other = units_of(quantity)[:2]
    return other if high > limits_by.get(quantity, np.inf) else si


def _angle_limit(channel: str) -> float:
    """Beyond this an angle is in degrees: a lean below half a radian, a hand wheel of 2 turns."""
    if "roll" in channel or "pitch" in channel:
        return 0.5
    return 12.0 if channel.startswith("steering") else 2.0 * math.pi


def reads_like(numbers: FloatArray, quantity: str, channel: str, stated: Unit) -> str:
    """Unit under which these numbers, as they stand in the log, would be an ordinary drive's.

    Args:
        numbers: of the log, finite.
        quantity: that the channel measures.
        channel: its name.
        stated: the unit that they were taken to be in.

    Returns:
        The unit's name, empty if no unit of this quantity helps.
    """
    low, high = _USUAL[quantity]
    high = min(high, most_of(channel) or high)
    if quantity == "angle" and ("roll" in channel or "pitch" in channel):
        high = 1.0
    largest = float(np.percentile(np.abs(numbers), 99.0)) if numbers.size else 0.0
    all_of, most = float(np.max(np.abs(numbers), initial=0.0)), most_of(channel) or math.inf
    # of pressures most units fit somehow: the usual one of numbers of this size first
    first = [unit_by_size(numbers, channel, quantity)] if quantity == "pressure" else []
    for name in (*first, *units_of(quantity)):
        unit = find_unit(name)
        if unit is None or unit.name == stated.name or "absolute" in name:
            continue
        size = largest * unit.factor
        fits = low <= size <= high and all_of * unit.factor <= most
        if fits and size < abs(largest * stated.factor):
            return name
    return ""
