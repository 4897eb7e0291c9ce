"""Loads of a vehicle standing level on a level road.

Axles of one unit that hang on the same brake circuit share their load equally, as a tandem does.
Unsprung masses weigh on the tires alone.

References: moment balance; the axle loads of the test (docs/validation.md).
Known limits: a tractor on at most two groups of axles, a trailer on one behind its kingpin: with
more the loads would depend on deflections.
Validated with: test/vehicle/test_statics.py.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from truck_blowout_sim.vehicle.masses import MassProperties, unit_mass
from truck_blowout_sim.vehicle.schema.axle import AxleSpec
from truck_blowout_sim.vehicle.vehicle import Vehicle


class StaticLoads(NamedTuple):
    """Forces at rest: carried by the springs of each axle, by its tires, and by the kingpin."""

    spring_n: Mapping[str, float]
    road_n: Mapping[str, float]
    hitch_n: float


class Group(NamedTuple):
    """Axles of a unit that share their load."""

    axles: tuple[str, ...]
    x_m: float


def axle_groups(axles: Mapping[str, AxleSpec], unit: str) -> tuple[Group, ...]:
    """Groups of axles of a unit, front to rear."""
    by_circuit: dict[str, list[str]] = {}
    for name, axle in axles.items():
        if axle.unit == unit:
            by_circuit.setdefault(axle.circuit, []).append(name)
    groups = (
        Group(tuple(names), sum(axles[name].x_m for name in names) / len(names))
        for names in by_circuit.values()
    )
    return tuple(sorted(groups, key=lambda group: group.x_m))


def static_loads(vehicle: Vehicle, gravity_mps2: float) -> StaticLoads:
    """Solve the moment balance of every unit, rearmost first.

    Raises:
        ValueError: a unit on a number of axle groups that leaves its loads undetermined.
    """
    axles = vehicle.spec.axles
    hitch = 0.0
    spring: dict[str, float] = {}
    for unit in reversed(vehicle.units):
        mass = unit_mass(vehicle.unit_specs[unit])
        groups = axle_groups(axles, unit)
        if unit == "trailer":
            loads, hitch = _trailer(mass, groups, gravity_mps2)
        else:
            point = vehicle.unit_specs[unit].hitch
            loads = _tractor(mass, groups, gravity_mps2, hitch, point.x_m if point else 0.0)
        for group, load in zip(groups, loads, strict=True):
            spring.update({name: load / len(group.axles) for name in group.axles})
    road = {name: load + axles[name].mass_kg * gravity_mps2 for name, load in spring.items()}
    ordered = {name: spring[name] for name in axles}
    return StaticLoads(ordered, {name: road[name] for name in axles}, hitch)


def _trailer(
    mass: MassProperties, groups: tuple[Group, ...], gravity_mps2: float
) -> tuple[tuple[float, ...], float]:
    if len(groups) != 1:
        raise ValueError(f"trailer on {len(groups)} groups of axles instead of 1")
    weight = mass.mass_kg * gravity_mps2
    load = weight * mass.x_m / groups[0].x_m
    return (load,), weight - load


def _tractor(
    mass: MassProperties,
    groups: tuple[Group, ...],
    gravity_mps2: float,
    hitch_n: float,
    hitch_x_m: float,
) -> tuple[float, ...]:
    if len(groups) != 2:
        raise ValueError(f"tractor on {len(groups)} groups of axles instead of 2")
    front, rear = groups
    weight = mass.mass_kg * gravity_mps2
    moment = weight * (mass.x_m - front.x_m) + hitch_n * (hitch_x_m - front.x_m)
    rear_load = moment / (rear.x_m - front.x_m)
    return weight + hitch_n - rear_load, rear_load
