"""A unit's sprung mass with its payload: center of gravity and inertia by parallel axes.

References: any mechanics textbook; docs/validation.md for the loads of the default vehicle.
Known limits: bodies and payload stand on the center line, boxes are of even density.
Validated with: test/vehicle/test_masses.py.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from truck_blowout_sim.vehicle.schema.body import PayloadSpec, UnitSpec


class MassProperties(NamedTuple):
    """Mass, center of gravity (x rearward from the origin, z above road), inertia about it."""

    mass_kg: float
    x_m: float
    z_m: float
    ixx_kgm2: float
    iyy_kgm2: float
    izz_kgm2: float
    ixz_kgm2: float


def body_mass(unit: UnitSpec) -> MassProperties:
    """The sprung mass without payload."""
    body = unit.body
    return MassProperties(
        body.mass_kg, body.x_m, body.z_m, body.ixx_kgm2, body.iyy_kgm2, body.izz_kgm2, body.ixz_kgm2
    )


def box_mass(box: PayloadSpec) -> MassProperties:
    """A box of even density."""
    twelfth = box.mass_kg / 12.0
    return MassProperties(
        box.mass_kg,
        box.x_m,
        box.z_m,
        twelfth * (box.width_m**2 + box.height_m**2),
        twelfth * (box.length_m**2 + box.height_m**2),
        twelfth * (box.length_m**2 + box.width_m**2),
        0.0,
    )


def combine(parts: Iterable[MassProperties]) -> MassProperties:
    """Several bodies as one rigid body.

    The product of inertia is the one of axes x forward and z up, ixz = integral x z dm; the entry
    of the inertia tensor is its negative. Positions are given rearward.
    """
    parts = tuple(parts)
    mass = sum(part.mass_kg for part in parts)
    if mass <= 0.0:
        return MassProperties(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    x = sum(part.mass_kg * part.x_m for part in parts) / mass
    z = sum(part.mass_kg * part.z_m for part in parts) / mass
    ixx = iyy = izz = ixz = 0.0
    for part in parts:
        forward, up = x - part.x_m, part.z_m - z
        ixx += part.ixx_kgm2 + part.mass_kg * up**2
        iyy += part.iyy_kgm2 + part.mass_kg * (forward**2 + up**2)
        izz += part.izz_kgm2 + part.mass_kg * forward**2
        ixz += part.ixz_kgm2 + part.mass_kg * forward * up
    return MassProperties(mass, x, z, ixx, iyy, izz, ixz)


def payload_mass(unit: UnitSpec, blocks: Iterable[str] | None = None) -> MassProperties:
    """Payload blocks of a unit, all or those named; of zero mass where it carries none."""
    return combine(box_mass(unit.payload[b]) for b in (unit.payload if blocks is None else blocks))


def unit_mass(unit: UnitSpec) -> MassProperties:
    """Sprung mass and payload together."""
    return combine([body_mass(unit), *(box_mass(box) for box in unit.payload.values())])
