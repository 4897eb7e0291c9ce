"""A tire from the size on its sidewall: radii, radial stiffness, gas volume.

References: ETRTO Standards Manual for the meaning of a size; T. B. Rhyne, "Development of a
vertical stiffness relationship for belted radial tires", Tire Science and Technology 33(3), 2005.
Known limits: a size in inches (11R22.5) has no aspect ratio printed; 0.865 is that of truck tires.
Validated with: test/vehicle/test_tire_size.py (a car tire; the truck tire that was measured).
"""

from __future__ import annotations

import re
from math import pi, sqrt
from typing import NamedTuple

from truck_blowout_sim.vehicle.document import Place
from truck_blowout_sim.vehicle.units import INCH_M

_METRIC = re.compile(r"(?:P|LT)?(\d{3})/(\d{2,3})(?:Z?R|-)(\d{2}(?:\.5)?)", re.IGNORECASE)
_INCH = re.compile(r"(\d{1,2}(?:\.\d{1,2})?)(?:R|-)(\d{2}(?:\.5)?)", re.IGNORECASE)
INCH_ASPECT = 0.865  # section height over width of 10R22.5 to 12R22.5, ETRTO
KGF_PER_MM_NPM = 9806.65  # standard gravity, of 1 kgf/mm
STRUCTURE_KGF_PER_MM = 3.45  # Rhyne: what a belted radial carries without pressure
PRESSURE_FACTOR = 0.00028  # Rhyne, for kPa and mm
TREAD_SHARE = 0.145  # tread and belt over the section height: 32 mm of 220 mm
FILL_SHARE = 0.86  # gas over the ring of rim, crown and width; 275/80R22.5 gets its 0.106 m3


class TireSize(NamedTuple):
    """Section width, section height and rim diameter [m]."""

    width_m: float
    height_m: float
    rim_diameter_m: float

    @property
    def radius_m(self) -> float:
        """Free radius."""
        return 0.5 * self.rim_diameter_m + self.height_m

    @property
    def structure_npm(self) -> float:
        """Radial stiffness without pressure (Rhyne)."""
        return STRUCTURE_KGF_PER_MM * KGF_PER_MM_NPM

    @property
    def stiffness_npmppa(self) -> float:
        """Radial stiffness per gauge pressure (Rhyne)."""
        aspect, width = 100.0 * self.height_m / self.width_m, 1e3 * self.width_m
        # Rhyne: width of the tread times outer diameter, mm
        root = sqrt((1.03 - 0.004 * aspect) * width
                    * (width * aspect / 50.0 + 1e3 * self.rim_diameter_m))  # fmt: skip
        return PRESSURE_FACTOR * root * KGF_PER_MM_NPM * 1e-3

    @property
    def volume_m3(self) -> float:
        """Gas volume, inflated."""
        crown = self.radius_m - TREAD_SHARE * self.height_m
        ring = pi * (crown**2 - (0.5 * self.rim_diameter_m) ** 2)
        return FILL_SHARE * ring * self.width_m


def parse_size(text: str, place: Place) -> TireSize:
    """Read a size such as `205/55R16`, `315/80 R 22.5` or `11R22.5`.

    Raises:
        InputError: no size that is understood.
    """
    plain = "".join(text.split())
    if match := _METRIC.match(plain):
        width, aspect, rim = (float(part) for part in match.groups())
        return TireSize(1e-3 * width, 1e-5 * width * aspect, rim * INCH_M)
    if match := _INCH.match(plain):
        width_m, rim_m = (float(part) * INCH_M for part in match.groups())
        return TireSize(width_m, INCH_ASPECT * width_m, rim_m)
    raise place.error(f"{text!r} is no tire size", "a size such as 205/55R16 or 11R22.5")
