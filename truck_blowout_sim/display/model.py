"""The joints of a vehicle's robot model, from which description and frames are both made.

The root is `tractor/base_link`. The trailer hangs on `articulation`, `trailer_pitch` and
`trailer_roll`; its link is `trailer/chassis`, not `trailer/base_link`: /tf places that frame in
`map` already, and a frame has one parent.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from truck_blowout_sim.vehicle import Vehicle
from truck_blowout_sim.vehicle.places import HubPlace, hitch_of, hub_places

Point = tuple[float, float, float]
_HERE: Point = (0.0, 0.0, 0.0)
ROOT = "tractor/base_link"


@dataclass(frozen=True)
class Joint:
    """One joint: `child` at `at` in `parent`, turned about `axis` or moved along it.

    Attributes:
        name: also its name in joint_states.
        kind: fixed, continuous or prismatic.
        parent, child: links.
        at: place in the parent, m.
        axis: unit vector; zero for a fixed joint.
    """

    name: str
    kind: str
    parent: str
    child: str
    at: Point
    axis: Point = _HERE


def link_of(unit: str) -> str:
    """Link that carries the axles of a unit."""
    return f"{unit}/chassis"


def joints_of(vehicle: Vehicle) -> tuple[Joint, ...]:
    """All joints, parents first."""
    hubs = hub_places(vehicle)
    found = [Joint("tractor_body", "fixed", ROOT, link_of("tractor"), _HERE)]
    if len(vehicle.units) > 1:
        found += _trailer(vehicle)
    return (*found, *(joint for hub in hubs for joint in _wheel_end(hub)))


def _trailer(vehicle: Vehicle) -> Iterator[Joint]:
    fifth_wheel, kingpin = hitch_of(vehicle, "tractor"), hitch_of(vehicle, "trailer")
    yield Joint("articulation", "continuous", ROOT, "trailer/turntable", fifth_wheel, (0, 0, 1))
    yield Joint("trailer_pitch", "continuous", "trailer/turntable", "trailer/rocker", _HERE,
                (0, 1, 0))  # fmt: skip
    yield Joint("trailer_roll", "continuous", "trailer/rocker", "trailer/coupler", _HERE,
                (1, 0, 0))  # fmt: skip
    back = (-kingpin[0], -kingpin[1], -kingpin[2])
    yield Joint("kingpin", "fixed", "trailer/coupler", link_of("trailer"), back)


def _wheel_end(hub: HubPlace) -> Iterator[Joint]:
    carrier = f"{hub.hub}/carrier"
    yield Joint(f"{hub.hub}_travel", "prismatic", link_of(hub.unit), carrier,
                (hub.x_m, hub.y_m, hub.z_m), (0, 0, 1))  # fmt: skip
    parent = carrier
    if hub.steered:
        parent = f"{hub.hub}/knuckle"
        yield Joint(f"{hub.hub}_steer", "continuous", carrier, parent, _HERE, (0, 0, 1))
    yield Joint(f"{hub.hub}_spin", "continuous", parent, hub.hub, _HERE, (0, 1, 0))
    if len(hub.tires) > 1:
        for tire, y_m, _ in hub.tires:
            yield Joint(f"{tire}_seat", "fixed", hub.hub, tire, (0.0, y_m, 0.0))
