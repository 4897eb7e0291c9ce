"""One truck of its kind: the sheet with a few per cent of personal deviation.

Masses and inertias vary within 2 %, cornering stiffness 4 %, centres of gravity 3 cm, steering
zero 0.05 deg at the road wheel, drag area 5 %, brake gain 4 % per wheel end, pressure 1.5 %.
"""

from __future__ import annotations

import copy
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from proving_ground.laws import Laws, usual
from proving_ground.sheet import HUBS, TIRES, load_sheet

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Individual:
    """A truck with its own deviations; `sheet` holds its masses and centres of gravity."""

    sheet: dict[str, Any]
    cornering_scale: FloatArray = field(default_factory=lambda: np.ones(5))
    brake_scale: FloatArray = field(default_factory=lambda: np.ones(len(HUBS)))
    pressure_scale: FloatArray = field(default_factory=lambda: np.ones(len(TIRES)))
    steering_zero_rad: float = 0.0
    drag_scale: float = 1.0
    road_seed: int = 0
    laws: Laws = field(default_factory=usual)


def nominal() -> Individual:
    """The truck of the sheet, without deviations."""
    return Individual(sheet=copy.deepcopy(load_sheet()))


def draw(seed: int) -> Individual:
    """A truck drawn from the tolerances, repeatable from `seed`."""
    rng = np.random.default_rng([seed, 11])
    sheet = copy.deepcopy(load_sheet())
    for unit in ("tractor", "trailer"):
        _deviate_body(sheet[unit], rng)
    for block in sheet["payload"]:
        block["mass_kg"] *= 1.0 + rng.uniform(-0.02, 0.02)
    return Individual(
        sheet=sheet,
        cornering_scale=1.0 + rng.uniform(-0.04, 0.04, 5),
        brake_scale=1.0 + rng.uniform(-0.04, 0.04, len(HUBS)),
        pressure_scale=1.0 + rng.uniform(-0.015, 0.015, len(TIRES)),
        steering_zero_rad=float(np.radians(rng.uniform(-0.05, 0.05))),
        drag_scale=float(1.0 + rng.uniform(-0.05, 0.05)),
        road_seed=seed,
    )


def _deviate_body(body: dict[str, Any], rng: np.random.Generator) -> None:
    """Vary mass and inertia within 2 % and the centre of gravity within 3 cm."""
    scale = 1.0 + rng.uniform(-0.02, 0.02)
    body["mass_kg"] *= scale
    if "front_mass_kg" in body:
        body["front_mass_kg"] *= scale
    body["inertia_kgm2"] = [i * (1.0 + rng.uniform(-0.02, 0.02)) for i in body["inertia_kgm2"]]
    body["cg_x_m"] += rng.uniform(-0.03, 0.03)
    body["cg_z_m"] += rng.uniform(-0.03, 0.03)
