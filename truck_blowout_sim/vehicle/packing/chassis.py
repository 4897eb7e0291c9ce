"""Blocks of road, steering, coupling, driveline, brakes control and sprung bodies."""

from __future__ import annotations

from collections.abc import Sequence

from truck_blowout_sim.physics import layout
from truck_blowout_sim.vehicle.masses import payload_mass, unit_mass
from truck_blowout_sim.vehicle.packing.blocks import fill
from truck_blowout_sim.vehicle.schema.axle import CIRCUITS
from truck_blowout_sim.vehicle.schema.body import UnitSpec
from truck_blowout_sim.vehicle.schema.controls import ABS_MODES
from truck_blowout_sim.vehicle.schema.road import RoadSpec
from truck_blowout_sim.vehicle.vehicle import Vehicle

_LOAD = ("payload_kg", "payload_x_m", "payload_y_m", "payload_z_m", "payload_rear_share")


def world_block(road: RoadSpec) -> list[float]:
    """Air, gravity and road; without a patch its rectangle is empty."""
    patch = road.patch
    rectangle = {
        "patch_x0_m": patch.x0_m if patch else 0.0,
        "patch_x1_m": patch.x1_m if patch else 0.0,
        "patch_y0_m": patch.y0_m if patch else 0.0,
        "patch_y1_m": patch.y1_m if patch else 0.0,
        "patch_scale": patch.scale if patch else 1.0,
    }
    return fill(layout.WorldParams, rectangle, [road])


def steering_block(vehicle: Vehicle) -> list[float]:
    """Steering; of a vehicle without, all zero but what is divided by."""
    steering = vehicle.spec.steering
    if steering is None:
        return fill(layout.SteeringParams, _without(layout.SteeringParams))
    computed = {
        "compliance_on": float(steering.compliant),
        "wheelbase_m": wheelbase_m(vehicle),
    }
    return fill(layout.SteeringParams, computed, [steering])


def wheelbase_m(vehicle: Vehicle) -> float:
    """From the steered axle to the middle of the tractor's other axles."""
    axles = [axle for axle in vehicle.spec.axles.values() if axle.unit == "tractor"]
    fixed = [axle.x_m for axle in axles if not axle.steered]
    steered = [axle.x_m for axle in axles if axle.steered]
    if not fixed or not steered:
        return 1.0
    return sum(fixed) / len(fixed) - sum(steered) / len(steered)


def coupling_block(vehicle: Vehicle, kingpin_n: float) -> list[float]:
    """Fifth wheel under its load at rest; of a single unit all zero but what is divided by."""
    fifth_wheel = vehicle.spec.fifth_wheel
    if fifth_wheel is None:
        return fill(layout.CouplingParams, _without(layout.CouplingParams))
    return fill(layout.CouplingParams, {"preload_z_n": kingpin_n}, [fifth_wheel])


def _without(block: type) -> dict[str, float]:
    ones = ("ratio", "transition", "stiffness_nmprad", "inertia", "wheelbase", "half_width")
    names: tuple[str, ...] = block._fields  # type: ignore[attr-defined]
    return {name: float(any(one in name for one in ones)) for name in names}


def driveline_block(vehicle: Vehicle) -> list[float]:
    """Engine and driveline."""
    return fill(layout.DrivelineParams, {}, [vehicle.spec.driveline])


def abs_block(vehicle: Vehicle) -> list[float]:
    """Anti-lock control."""
    spec = vehicle.spec.abs
    return fill(layout.AbsParams, {"mode": float(ABS_MODES.index(spec.mode))}, [spec])


def circuit_blocks(vehicle: Vehicle) -> list[float]:
    """The brake circuits, in the order of the layout."""
    circuits = vehicle.spec.circuits
    return [
        value
        for name in CIRCUITS
        for value in fill(layout.CircuitParams, {}, [getattr(circuits, name)])
    ]


def torsion_ends(unit: UnitSpec) -> dict[str, float]:
    """Frame torsion ahead of and behind the body's mass, two springs in series; 0 is rigid."""
    stiffness, share = unit.frame.torsion_nmprad, unit.frame.torsion_front_share
    return {
        "torsion_front_nmprad": stiffness / share if share > 0.0 else 0.0,
        "torsion_rear_nmprad": stiffness / (1.0 - share) if share < 1.0 else 0.0,
        "torsion_z_m": unit.frame.torsion_height_m - unit_mass(unit).z_m,
    }


def movable_load(unit: UnitSpec, blocks: Sequence[str] | None = None) -> dict[str, float]:
    """The part of the payload that may move, from the unit's center of gravity, x forward.

    Args:
        blocks: names of the blocks; None for all.
    """
    middle, moved = unit_mass(unit), tuple(unit.payload) if blocks is None else tuple(blocks)
    cargo = payload_mass(unit, moved)
    if cargo.mass_kg <= 0.0:
        return dict.fromkeys(_LOAD, 0.0)
    behind = sum(unit.payload[b].mass_kg for b in moved if unit.payload[b].x_m > middle.x_m)
    return dict(zip(_LOAD, (cargo.mass_kg, middle.x_m - cargo.x_m, 0.0, cargo.z_m - middle.z_m,
                            behind / cargo.mass_kg), strict=True))


def unit_block(vehicle: Vehicle, name: str) -> list[float]:
    """A sprung body with its cargo, seen from the common center of gravity, x forward."""
    unit = vehicle.unit_specs[name]
    mass, base, hitch, air = unit_mass(unit), unit.base_link, unit.hitch, unit.air
    computed = {
        "mass_kg": mass.mass_kg,
        "ixx_kgm2": mass.ixx_kgm2,
        "iyy_kgm2": mass.iyy_kgm2,
        "izz_kgm2": mass.izz_kgm2,
        "ixy_kgm2": 0.0,
        "ixz_kgm2": mass.ixz_kgm2,
        "iyz_kgm2": 0.0,
        "cg_height_m": mass.z_m,
        "base_x_m": mass.x_m - base.x_m,
        "base_y_m": 0.0,
        "base_z_m": base.z_m - mass.z_m,
        "hitch_x_m": mass.x_m - hitch.x_m if hitch else 0.0,
        "hitch_y_m": 0.0,
        "hitch_z_m": hitch.z_m - mass.z_m if hitch else 0.0,
        "origin_x_m": mass.x_m,
        "drag_z_m": air.drag_z_m - mass.z_m,
        "side_x_m": mass.x_m - air.side_x_m,
        "side_z_m": air.side_z_m - mass.z_m,
        **torsion_ends(unit),
        **movable_load(unit),
    }
    return fill(layout.UnitParams, computed, [unit.frame, air])
