"""The spec sheet of the proving-ground truck and what follows from it by statics.

References: mass set B of the 52,000 lb test combination.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import yaml

GRAVITY_MPS2 = 9.81
PSI_PA = 6894.757
POUND_N = 4.448222
AXLE_NAMES = ("steer", "drive_1", "drive_2", "trailer_1", "trailer_2")
HUBS = tuple(f"{axle}_{side}" for axle in AXLE_NAMES for side in ("left", "right"))
TIRES = HUBS[:2] + tuple(f"{hub}_{place}" for hub in HUBS[2:] for place in ("outer", "inner"))


def tires_of(hub_or_tire: str) -> tuple[str, ...]:
    """Tires that a name means: a tire itself, or both duals of a hub."""
    if hub_or_tire in TIRES:
        return (hub_or_tire,)
    return tuple(name for name in TIRES if name.startswith(hub_or_tire + "_"))


@cache
def load_sheet() -> dict[str, Any]:
    """The spec sheet as nested mappings, SI units."""
    text = (Path(__file__).parent / "truck.yaml").read_text(encoding="utf-8")
    sheet: dict[str, Any] = yaml.safe_load(text)
    return sheet


@dataclass(frozen=True)
class StaticLoads:
    """Vertical loads at rest, newtons: the three axle groups and the kingpin."""

    steer_n: float
    drive_n: float
    trailer_n: float
    kingpin_n: float

    def axle_n(self) -> tuple[float, float, float, float, float]:
        """Load of each axle; both tandems share equally."""
        drive, trailer = 0.5 * self.drive_n, 0.5 * self.trailer_n
        return (self.steer_n, drive, drive, trailer, trailer)


def static_loads(sheet: dict[str, Any]) -> StaticLoads:
    """Axle loads by moments about the kingpin and the drive tandem's middle."""
    axles, trailer, tractor = sheet["axles"], sheet["trailer"], sheet["tractor"]
    parts = [(trailer["mass_kg"], trailer["cg_x_m"])]
    parts += [(block["mass_kg"], block["x_m"]) for block in sheet["payload"]]
    parts += [(axle["mass_kg"], axle["x_m"]) for axle in axles[3:]]
    tandem = 0.5 * (axles[3]["x_m"] + axles[4]["x_m"])
    trailer_kg = sum(mass * x for mass, x in parts) / tandem
    kingpin_kg = sum(mass for mass, _ in parts) - trailer_kg
    parts = [(tractor["mass_kg"], tractor["cg_x_m"]), (kingpin_kg, tractor["hitch_x_m"])]
    parts += [(axle["mass_kg"], axle["x_m"]) for axle in axles[:3]]
    tandem = 0.5 * (axles[1]["x_m"] + axles[2]["x_m"])
    drive_kg = sum(mass * x for mass, x in parts) / tandem
    steer_kg = sum(mass for mass, _ in parts) - drive_kg
    g = GRAVITY_MPS2
    return StaticLoads(steer_kg * g, drive_kg * g, trailer_kg * g, kingpin_kg * g)
