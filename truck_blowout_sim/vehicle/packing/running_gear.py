"""Blocks of axles, hubs and tires."""

from __future__ import annotations

from math import sqrt

from truck_blowout_sim.physics import layout
from truck_blowout_sim.vehicle.masses import unit_mass
from truck_blowout_sim.vehicle.packing.blocks import fill
from truck_blowout_sim.vehicle.packing.formula import loaded_radius_m
from truck_blowout_sim.vehicle.packing.tables import Tables
from truck_blowout_sim.vehicle.places import behind_m
from truck_blowout_sim.vehicle.schema.axle import AxleSpec
from truck_blowout_sim.vehicle.schema.tire import LAWS, MODELS, BlowoutSpec
from truck_blowout_sim.vehicle.statics import StaticLoads
from truck_blowout_sim.vehicle.vehicle import Vehicle, hubs_of_axle, tires_of_hub


def axle_block(vehicle: Vehicle, name: str, loads: StaticLoads) -> list[float]:
    """An axle seen from its unit's center of gravity, preloaded for the design attitude."""
    axle = vehicle.spec.axles[name]
    mass = unit_mass(vehicle.unit_specs[axle.unit])
    suspension = axle.suspension
    computed = {
        "x_m": mass.x_m - axle.x_m,
        "roll_centre_z_m": suspension.roll_centre_height_m - mass.z_m,
        "center_height_m": center_height_m(vehicle, name, loads),
        "half_track_m": 0.5 * axle.track_m,
        "half_spacing_m": 0.5 * axle.spring_spacing_m,
        "preload_n": 0.5 * loads.spring_n[name],
        "behind_m": behind_m(vehicle, name),
    }
    return fill(layout.AxleParams, computed, [axle, suspension])


def center_height_m(vehicle: Vehicle, name: str, loads: StaticLoads) -> float:
    """Height of the wheel centers above the road at rest, mean of both sides."""
    tires = [t for hub in hubs_of_axle(name) for t in vehicle.tires_of_hub(hub)]
    load = loads.road_n[name] / len(tires)
    specs = [vehicle.tire_specs[tire] for tire in tires]
    return sum(loaded_radius_m(spec, load) for spec in specs) / len(specs)


def hub_block(axle: AxleSpec, hub: str) -> list[float]:
    """One end of an axle. Toe-in turns a left wheel right; camber leans the top outward."""
    left = hub.endswith("_left")
    out = 1.0 if left else -1.0
    brake = axle.brake
    computed = {
        "y_m": out * 0.5 * axle.track_m,
        "toe_rad": -out * axle.toe_in_rad,
        "camber_rad": out * (axle.camber_left_rad if left else axle.camber_right_rad),
        "brake_linear_nmppa": brake.linear_nmppa if brake else 0.0,
        "brake_quadratic_nmppa2": brake.quadratic_nmppa2 if brake else 0.0,
        "brake_pushout_pa": brake.pushout_pa if brake else 0.0,
        "brake_enabled": float(brake is not None),
    }
    return fill(layout.HubParams, computed, [axle])


def tire_block(vehicle: Vehicle, tire: str, hub: str, tables: Tables) -> list[float]:
    """One tire on its hub."""
    axle = vehicle.spec.axles[vehicle.axle_of_hub(hub)]
    spec, law = vehicle.tire_specs[tire], vehicle.blowout
    computed = {
        "y_m": offset_m(axle, tire, hub),
        "model": float(MODELS.index(spec.model)),
        "law": float(LAWS.index(law.law)),
        "table": float(tables.steps(spec)),
        "map_table": float(tables.map(spec)),
        "rim_damping_nspm": rim_damping_nspm(law, vehicle.rim(tire).rim_stiffness_npm, axle),
    }
    return fill(layout.TireParams, computed, [spec, law, vehicle.rim(tire)])


def offset_m(axle: AxleSpec, tire: str, hub: str) -> float:
    """Position of a tire from its hub's center, left positive: the outer dual is farther out."""
    names = tires_of_hub(hub, axle)
    if len(names) == 1:
        return 0.0
    out = 1.0 if hub.endswith("_left") else -1.0
    return 0.5 * out * axle.dual_spacing_m * (1.0 if tire == names[0] else -1.0)


def rim_damping_nspm(law: BlowoutSpec, stiffness_npm: float, axle: AxleSpec) -> float:
    """Damping of half an axle on the rim: 2 zeta sqrt(k m)."""
    return 2.0 * law.rim_damping_ratio * sqrt(stiffness_npm * 0.5 * axle.mass_kg)
