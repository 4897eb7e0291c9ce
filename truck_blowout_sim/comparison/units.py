"""Units that people read, beside the SI units that machines read.

A channel's display unit follows from the SI suffix of its name: mph, deg/s, ft, psi, g. Spin
speeds of hubs are shown in revolutions per minute.

Validated with: test/comparison/test_units.py.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

FOOT_M = 0.3048
MPH_MPS = 0.44704
PSI_PA = 6894.757293168361
G_MPS2 = 9.80665
POUND_FORCE_N = 4.4482216152605


@dataclass(frozen=True)
class DisplayUnit:
    """A unit as text and the number of them in one SI unit."""

    symbol: str
    per_si: float


_BY_SUFFIX = {
    "mps2": DisplayUnit("g", 1.0 / G_MPS2),
    "radps": DisplayUnit("deg/s", math.degrees(1.0)),
    "mps": DisplayUnit("mph", 1.0 / MPH_MPS),
    "rad": DisplayUnit("deg", math.degrees(1.0)),
    "pa": DisplayUnit("psi", 1.0 / PSI_PA),
    "m": DisplayUnit("ft", 1.0 / FOOT_M),
    "n": DisplayUnit("lbf", 1.0 / POUND_FORCE_N),
    "s": DisplayUnit("s", 1.0),
}
_PLAIN = DisplayUnit("", 1.0)
_SPIN = DisplayUnit("rpm", 30.0 / math.pi)
_THROTTLE = DisplayUnit("%", 100.0)


def display_unit(channel: str) -> DisplayUnit:
    """Unit a person is shown for a channel, by the channel's name.

    >>> display_unit("tractor_vx_mps").symbol
    'mph'
    """
    if channel == "throttle":
        return _THROTTLE
    if channel.startswith("hub_speed_"):
        return _SPIN
    return _BY_SUFFIX.get(channel.rpartition("_")[2], _PLAIN)
