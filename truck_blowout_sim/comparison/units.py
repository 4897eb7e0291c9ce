"""Units that people read, beside the SI units that machines read.

A channel's display unit follows from the SI suffix of its name: mph, deg/s, ft, psi, g. Spin
speeds of hubs are shown in revolutions per minute. The second system keeps SI, with degrees.

Validated with: test/comparison/test_units.py.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

from truck_blowout_sim.recordings.units import GRAVITY_MPS2
from truck_blowout_sim.vehicle.units import FOOT_M, MILE_PER_HOUR_MPS, POUND_FORCE_N, PSI_PA


@dataclass(frozen=True)
class DisplayUnit:
    """A unit as text and the number of them in one SI unit."""

    symbol: str
    per_si: float


_BY_SUFFIX = {
    "mps2": DisplayUnit("g", 1.0 / GRAVITY_MPS2),
    "radps": DisplayUnit("deg/s", math.degrees(1.0)),
    "mps": DisplayUnit("mph", 1.0 / MILE_PER_HOUR_MPS),
    "rad": DisplayUnit("deg", math.degrees(1.0)),
    "pa": DisplayUnit("psi", 1.0 / PSI_PA),
    "m": DisplayUnit("ft", 1.0 / FOOT_M),
    "n": DisplayUnit("lbf", 1.0 / POUND_FORCE_N),
    "s": DisplayUnit("s", 1.0),
}
_METRIC = {
    "mps2": DisplayUnit("m/s²", 1.0),
    "radps": DisplayUnit("deg/s", math.degrees(1.0)),
    "mps": DisplayUnit("m/s", 1.0),
    "rad": DisplayUnit("deg", math.degrees(1.0)),
    "pa": DisplayUnit("kPa", 1e-3),
    "m": DisplayUnit("m", 1.0),
    "n": DisplayUnit("kN", 1e-3),
    "s": DisplayUnit("s", 1.0),
}
SYSTEMS = ("us", "si")
AXES = ("iso", "sae")
# What turns over between ISO 8855 (y left, z up) and SAE J670 (y right, z down); roll and whatever
# points forward stay.
_TURNED = re.compile(
    r"(tractor|trailer)_(y_m|z_m|yaw_rad|pitch_rad|vy_mps|yaw_rate_radps|pitch_rate_radps|ay_mps2"
    r"|az_mps2|across_m)"
    r"|steering_wheel_angle_rad|articulation_rad|\w+_steer_rad|tire_f[yz]_\w+_n"
)
_PLAIN = DisplayUnit("", 1.0)
_SPIN = DisplayUnit("rpm", 30.0 / math.pi)
_THROTTLE = DisplayUnit("%", 100.0)


def display_unit(channel: str, system: str = "us") -> DisplayUnit:
    """Unit a person is shown for a channel, by the channel's name.

    Args:
        channel: name with the SI suffix.
        system: ``us`` (mph, ft, psi, lbf, g) or ``si`` (m/s, m, kPa, kN, m/s²); degrees in both.

    >>> display_unit("tractor_vx_mps").symbol
    'mph'
    """
    if channel == "throttle":
        return _THROTTLE
    if channel.startswith("hub_speed_"):
        return _SPIN
    units = _METRIC if system == "si" else _BY_SUFFIX
    return units.get(channel.rpartition("_")[2], _PLAIN)


def axes_sign(channel: str, axes: str = "iso") -> float:
    """-1 where a channel (stored in ISO axes) is printed with the other sign in the given axes.

    References: ISO 8855, SAE J670.
    """
    return -1.0 if axes == "sae" and _TURNED.fullmatch(channel) else 1.0
