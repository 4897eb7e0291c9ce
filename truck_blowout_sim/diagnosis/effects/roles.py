"""Which parts of a vehicle play which role: what the numbers of a settings file belong to.

An axle is steered, driven, towed (on any unit behind the first) or carried (none of these), so that
every axle of every vehicle has numbers of its own. Parts are named after what they are.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from truck_blowout_sim.vehicle import Vehicle

ROLES = ("truck", "towing_unit", "towed_units", "steered", "driven", "towed", "carried", "steering",
         "coupling", "towing_circuits", "towed_circuits", "hubs")


@dataclass(frozen=True)
class Part:
    """A part of a vehicle in a role: a name for its numbers, and its members by kind."""

    name: str
    members: Mapping[str, tuple[str, ...]]
    last: bool = False

    def named(self, number: str) -> str:
        """Name of a number of this part: the part comes first, a single hub last."""
        if not self.name:
            return number
        return f"{number}_{self.name}" if self.last else f"{self.name}_{number}"

    def expand(self, pattern: str) -> list[str]:
        """Packed names that a pattern such as ``axle.<axle>.x_m`` stands for."""
        for kind, members in self.members.items():
            if f"<{kind}>" in pattern:
                return [pattern.replace(f"<{kind}>", one) for one in members]
        return [pattern]


def parts_of(vehicle: Vehicle, role: str) -> Sequence[Part]:
    """Parts of a vehicle in a role, none if it has no such part."""
    axles, units = vehicle.axles, vehicle.units
    if role == "truck":
        return (_part(vehicle, "", axles, units),)
    if role in ("towing_unit", "towed_units"):
        chosen = units[:1] if role == "towing_unit" else units[1:]
        return tuple(_part(vehicle, unit, _axles_of(vehicle, unit), (unit,)) for unit in chosen)
    if role == "steering":
        steered = tuple(a for a in axles if role_of(vehicle, a) == "steered")
        return (_part(vehicle, "", steered, units[:1]),) if steered else ()
    if role == "coupling":
        return (_part(vehicle, "", (), units[:1]),) if len(units) > 1 else ()
    if role in ("towing_circuits", "towed_circuits"):
        return _circuits(vehicle, units[:1] if role == "towing_circuits" else units[1:])
    if role == "hubs":
        return tuple(Part(hub, {"hub": (hub,)}, last=True) for hub in vehicle.hubs)
    found = tuple(a for a in axles if role_of(vehicle, a) == role)
    return (_part(vehicle, role, found, ()),) if found else ()


def role_of(vehicle: Vehicle, axle: str) -> str:
    """What an axle does: steered, driven, towed or carried."""
    spec = vehicle.spec.axles[axle]
    if spec.steered:
        return "steered"
    if spec.drive_share > 0.0:
        return "driven"
    return "towed" if spec.unit != vehicle.units[0] else "carried"


def _circuits(vehicle: Vehicle, units: Sequence[str]) -> tuple[Part, ...]:
    """The brake circuits of each unit's axles; one that serves an earlier unit is not repeated."""
    found, taken = [], set[str]()
    for unit in units:
        groups = {vehicle.spec.axles[a].circuit for a in _axles_of(vehicle, unit)} - taken
        taken |= groups
        if groups:
            found.append(Part(unit, {"circuit": tuple(sorted(groups))}))
    return tuple(found)


def _axles_of(vehicle: Vehicle, unit: str) -> tuple[str, ...]:
    return tuple(a for a in vehicle.axles if vehicle.spec.axles[a].unit == unit)


def _part(vehicle: Vehicle, name: str, axles: Sequence[str], units: Sequence[str]) -> Part:
    """A part made of whole axles."""
    hubs = tuple(h for h in vehicle.hubs if vehicle.axle_of_hub(h) in axles)
    tires = tuple(t for h in hubs for t in vehicle.tires_of_hub(h))
    return Part(name, {"unit": tuple(units), "axle": tuple(axles), "hub": hubs, "tire": tires})
