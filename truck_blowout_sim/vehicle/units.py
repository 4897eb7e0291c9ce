"""Units a key may carry: `mass_lb` is read as `mass_kg`.

Inside the package everything is SI and radians. A file may keep the unit its source is printed in,
because a number that was never converted by hand can be held against the book it came from.
"""

from __future__ import annotations

from difflib import get_close_matches
from math import degrees, radians
from typing import NamedTuple

PSI_PA = 6894.757293168361
POUND_KG = 0.45359237
POUND_FORCE_N = 4.4482216152605
INCH_M = 0.0254
FOOT_M = 12.0 * INCH_M
MILE_PER_HOUR_MPS = 0.44704
KMH_MPS = 1.0 / 3.6


class Unit(NamedTuple):
    """The SI suffix a unit is converted to, and the factor."""

    si: str
    factor: float


UNITS: dict[str, Unit] = {
    "mm": Unit("m", 1e-3),
    "cm": Unit("m", 1e-2),
    "in": Unit("m", INCH_M),
    "ft": Unit("m", FOOT_M),
    "cm2": Unit("m2", 1e-4),
    "l": Unit("m3", 1e-3),
    "lb": Unit("kg", POUND_KG),
    "kn": Unit("n", 1e3),
    "lbf": Unit("n", POUND_FORCE_N),
    "deg": Unit("rad", radians(1.0)),
    "degps": Unit("radps", radians(1.0)),
    "kpa": Unit("pa", 1e3),
    "bar": Unit("pa", 1e5),
    "psi": Unit("pa", PSI_PA),
    "kw": Unit("w", 1e3),
    "mph": Unit("mps", MILE_PER_HOUR_MPS),
    "kmph": Unit("mps", KMH_MPS),
    "npmm": Unit("npm", 1e3),
    "knpm": Unit("npm", 1e3),
    "knspm": Unit("nspm", 1e3),
    "nmpdeg": Unit("nmprad", degrees(1.0)),
    "npdeg": Unit("nprad", degrees(1.0)),
    "npmppsi": Unit("npmppa", 1.0 / PSI_PA),
    "nmppsi": Unit("nmppa", 1.0 / PSI_PA),
    "nmppsi2": Unit("nmppa2", 1.0 / PSI_PA**2),
    "hpkm": Unit("spm", 1.0 / KMH_MPS),  # hours per kilometer, as rolling resistance is printed
}


def si_key(key: str) -> tuple[str, float]:
    """Return `key` with its unit suffix made SI, and the factor of its value.

    A key without a foreign unit comes back as it is, with factor 1.
    """
    stem, _, suffix = key.rpartition("_")
    unit = UNITS.get(suffix)
    if unit is None or not stem:
        return key, 1.0
    return f"{stem}_{unit.si}", unit.factor


def spellings(key: str) -> tuple[str, ...]:
    """All keys under which the quantity of an SI key may be written, the SI one first."""
    stem, _, suffix = key.rpartition("_")
    others = [name for name, unit in UNITS.items() if unit.si == suffix and stem]
    return (key, *(f"{stem}_{name}" for name in others))


def in_unit_of(written: str, key: str) -> str:
    """An SI key in the unit that a written key has or seems to have; else as it is."""
    suffix = written.rpartition("_")[2].lower()
    own = key.rpartition("_")[2]
    units = [own, *(name for name, unit in UNITS.items() if unit.si == own)]
    swapped = [one for one in units if sorted(one) == sorted(suffix)]
    near = swapped or get_close_matches(suffix, units, 1)
    return spellings(key)[units.index(near[0])] if near else key
