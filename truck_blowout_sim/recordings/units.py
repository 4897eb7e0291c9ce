"""Units as loggers spell them, and their factor to SI.

A table of our own, because loggers' spellings are not those of unit libraries (``g`` is a gram to
them, ``G``, ``kph``, ``°/s`` and ``hhmmss`` are nothing), and the table of about ten quantities is
all that a truck's log needs.

References: NIST SP 811 (2008), appendix B.8: knot, mile, foot, psi, standard gravity.
Validated with: test/recordings/test_units.py.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from truck_blowout_sim.errors import InputError, nearest, quoted
from truck_blowout_sim.recordings.channel import ATMOSPHERE_PA

# Standard gravity, the unit g. That of a simulated road is its own `gravity_mps2`.
GRAVITY_MPS2 = 9.80665
_DEG = math.pi / 180.0
FOOT_M, MILE_M, _NAUTICAL_MILE_M = 0.3048, 1609.344, 1852.0
MILE_PER_HOUR_MPS, KMH_MPS = MILE_M / 3600.0, 1.0 / 3.6
_POUND_N, PSI_PA = 4.4482216152605, 6894.757293168361


@dataclass(frozen=True)
class Unit:
    """SI value = factor * number + offset.

    Attributes:
        name: the spelling shown to people.
        quantity: what it measures: ``speed``, ``angle`` …
    """

    name: str
    quantity: str
    factor: float
    offset: float = 0.0


SI_QUANTITIES = {
    "rad": "angle", "1": "ratio", "m/s": "speed", "rad/s": "angular rate", "m/s2": "acceleration",
    "m": "length", "Pa": "pressure", "N": "force", "s": "time",
}  # fmt: skip
"""Quantity of each unit of the table of channels."""

# quantity: name: (factor, offset, other spellings)
_TABLE: dict[str, dict[str, tuple[float, float, str]]] = {
    "angle": {
        "rad": (1.0, 0.0, "radian radians"),
        "deg": (_DEG, 0.0, "° degree degrees grad degs"),
        "arcmin": (_DEG / 60.0, 0.0, "' minutes_of_arc"),
        "arcsec": (_DEG / 3600.0, 0.0, '"'),
        "mrad": (1e-3, 0.0, ""),
        "rev": (2 * math.pi, 0.0, "turn turns"),
    },
    "angular rate": {
        "rad/s": (1.0, 0.0, "rad/sec radps rads rad*s^-1 rad.s-1"),
        "deg/s": (_DEG, 0.0, "°/s deg/sec degps dps degrees/s °/sec deg*s^-1 degs/s deg.s-1"),
        "rpm": (2 * math.pi / 60.0, 0.0, "1/min rev/min min^-1 min-1 u/min"),
        "mrad/s": (1e-3, 0.0, ""),
    },
    "speed": {
        "m/s": (1.0, 0.0, "mps m/sec meter/s m*s^-1 m.s-1"),
        "km/h": (KMH_MPS, 0.0, "kmh kph kmph kilometer/h km/hr"),
        "mph": (MILE_PER_HOUR_MPS, 0.0, "mi/h miles/h mile/h"),
        "knots": (_NAUTICAL_MILE_M / 3600.0, 0.0, "knot kn kt kts"),
        "ft/s": (FOOT_M, 0.0, "fps ft/sec"),
    },
    "acceleration": {
        "m/s2": (1.0, 0.0, "m/s^2 m/s² mps2 m/s/s m/sec2 m/sec^2 m*s^-2 m.s-2"),
        "g": (GRAVITY_MPS2, 0.0, "gn g's gs"),
        "ft/s2": (FOOT_M, 0.0, "ft/s^2 ft/s²"),
        "mg": (GRAVITY_MPS2 / 1e3, 0.0, ""),
    },
    "length": {
        "m": (1.0, 0.0, "meter meters metre metres"),
        "km": (1e3, 0.0, ""),
        "cm": (1e-2, 0.0, ""),
        "mm": (1e-3, 0.0, ""),
        "ft": (FOOT_M, 0.0, "foot feet"),
        "in": (FOOT_M / 12.0, 0.0, "inch inches"),
    },
    "pressure": {
        "Pa": (1.0, 0.0, "pascal"),
        "hPa": (1e2, 0.0, "mbar"),
        "kPa": (1e3, 0.0, ""),
        "MPa": (1e6, 0.0, ""),
        "bar": (1e5, 0.0, "barg bar(g)"),
        "psi": (PSI_PA, 0.0, "psig lb/in2 lbf/in2"),
        "Pa absolute": (1.0, -ATMOSPHERE_PA, "pa(a) paa"),
        "hPa absolute": (1e2, -ATMOSPHERE_PA, "hpa(a) hpaa"),
        "kPa absolute": (1e3, -ATMOSPHERE_PA, "kpa(a) kpaa"),
        "MPa absolute": (1e6, -ATMOSPHERE_PA, "mpa(a) mpaa"),
        "bar absolute": (1e5, -ATMOSPHERE_PA, "bara bar(a)"),
        "psi absolute": (PSI_PA, -ATMOSPHERE_PA, "psia psi(a)"),
    },
    "ratio": {
        "1": (1.0, 0.0, "- none ratio fraction 0..1"),
        "%": (1e-2, 0.0, "percent pct perc"),
    },
    "force": {
        "N": (1.0, 0.0, "newton"),
        "kN": (1e3, 0.0, ""),
        "lbf": (_POUND_N, 0.0, "lb lbs"),
        "kgf": (GRAVITY_MPS2, 0.0, ""),
    },
    "time": {
        "s": (1.0, 0.0, "sec second seconds secs"),
        "ms": (1e-3, 0.0, "msec millisecond milliseconds"),
        "us": (1e-6, 0.0, "µs μs usec microsecond microseconds"),
        "ns": (1e-9, 0.0, "nsec nanosecond nanoseconds"),
        "min": (60.0, 0.0, "minute minutes"),
        "h": (3600.0, 0.0, "hour hours hr"),
        "day": (86_400.0, 0.0, "days"),
        "hhmmss": (1.0, 0.0, "hhmmss.ss hhmmss.sss utc"),
    },
}


def _bare(text: str) -> str:
    return "".join(text.strip().strip("[](){}").split()).replace("**", "^")


def _key(text: str) -> str:
    return _bare(text).lower()


_AS_SPELLED = {
    _bare(spelling): Unit(name, quantity, factor, offset)
    for quantity, names in _TABLE.items()
    for name, (factor, offset, others) in names.items()
    for spelling in (name, *others.split())
}
_UNITS = {_key(spelling): unit for spelling, unit in _AS_SPELLED.items()}
# What the splitting at blanks above would take apart.
_UNITS |= {
    _key(f"{name} abs"): _UNITS[_key(f"{name} absolute")]
    for name in ("Pa", "hPa", "kPa", "MPa", "bar", "psi")
}
_MILLI_PASCAL = "mPa"


def find_unit(text: str) -> Unit | None:
    """The unit that a text stands for, None if it is none: ``km/h``, ``[deg/s]``, ``(psi)``."""
    if text.strip("[]() ") == _MILLI_PASCAL:
        return None  # millipascal: nobody logs it, and MPa would be wrong by 1e9
    if not text.strip():
        return None
    # case tells kn, knots, from kN
    return _AS_SPELLED.get(_bare(text)) or _UNITS.get(_key(text))


def unknown_unit(text: str) -> str:
    """The unit that a log states, if it is not known here; else empty."""
    return text.strip() if text.strip("[](){} ") and find_unit(text) is None else ""


def not_known(unit: str, of: str = "") -> str:
    """What is wrong with a unit that a log states, ``of`` a column of it."""
    return f"the log's unit {quoted(unit)}{of and f' of {of}'} is not known here"


def units_of(quantity: str) -> tuple[str, ...]:
    """Names of the units of a quantity, the SI one first."""
    return tuple(_TABLE[quantity])


def unit_for(text: str, quantity: str, *, file: object, where: str) -> Unit:
    """The unit of a rule, checked against what the channel measures.

    Raises:
        InputError: unknown, or of another quantity.
    """
    unit = find_unit(text)
    names = ", ".join(units_of(quantity))
    if unit is None:
        hint = nearest(text, units_of(quantity), names)
        raise InputError(f"unknown unit {quoted(text)}", file=str(file), where=where,
                         expected=f"a unit of {quantity}: {hint}")  # fmt: skip
    if unit.quantity != quantity:
        raise InputError(
            f"unit {quoted(text)} is one of {unit.quantity}", file=str(file), where=where,
            expected=f"a unit of {quantity}: {names}",
        )  # fmt: skip
    return unit
