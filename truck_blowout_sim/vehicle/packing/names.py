"""Names of the packed parameters, such as `hub.trailer_2_left.brake_gain`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from truck_blowout_sim.errors import InputError, closest
from truck_blowout_sim.physics import layout
from truck_blowout_sim.physics.tires.lanes import tire_offset
from truck_blowout_sim.vehicle.document import Place
from truck_blowout_sim.vehicle.schema.axle import CIRCUITS
from truck_blowout_sim.vehicle.vehicle import Vehicle

LONGEST_NAME = 120  # nobody meant a longer one, and comparing it with all others takes time
_SIMILAR = 0.6  # least share of equal letters of a name that was meant


@dataclass(frozen=True)
class Names:
    """Names in the order of the vectors."""

    units: tuple[str, ...]
    axles: tuple[str, ...]
    hubs: tuple[str, ...]
    tires: tuple[str, ...]


def names_of(vehicle: Vehicle) -> Names:
    """Names of a vehicle's units, axles, hubs and tires."""
    return Names(vehicle.units, vehicle.axles, vehicle.hubs, vehicle.tires)


def parameter_blocks(vehicle: Vehicle) -> list[tuple[str, type[Any]]]:
    """Prefix and layout of every block of the parameter vector, in its order."""
    return [
        ("world", layout.WorldParams),
        ("steering", layout.SteeringParams),
        ("fifth_wheel", layout.CouplingParams),
        ("driveline", layout.DrivelineParams),
        ("abs", layout.AbsParams),
        *((f"circuit.{name}", layout.CircuitParams) for name in CIRCUITS),
        *((f"unit.{name}", layout.UnitParams) for name in vehicle.units),
        *((f"axle.{name}", layout.AxleParams) for name in vehicle.axles),
        *((f"hub.{name}", layout.HubParams) for name in vehicle.hubs),
        *((f"tire.{name}", layout.TireParams) for name in vehicle.tires),
    ]


def parameter_index(vehicle: Vehicle) -> dict[str, int]:
    """Position of every named parameter of a vehicle."""
    index: dict[str, int] = {}
    at = 0  # tires, the last blocks, stand side by side behind the others
    for prefix, block in parameter_blocks(vehicle):
        if block is layout.TireParams:
            first = at + tire_offset(vehicle.tires.index(prefix.removeprefix("tire.")))
            places = [first + place for place in layout.TIRE]
        else:
            places = list(range(at, at + len(block._fields)))
            at += len(places)
        index |= {f"{prefix}.{field}": place
                  for field, place in zip(block._fields, places, strict=True)}
    return index


def state_index(vehicle: Vehicle) -> dict[str, int]:
    """Position of every named state, such as `tire.steer_left.slip`; brake lines have no names."""
    blocks: list[tuple[str, type[Any]]] = [
        ("truck", layout.GlobalState),
        *((f"unit.{name}", layout.UnitState) for name in vehicle.units),
        *((f"axle.{name}", layout.AxleState) for name in vehicle.axles),
        *((f"hub.{name}", layout.HubState) for name in vehicle.hubs),
        *((f"tire.{name}", layout.TireState) for name in vehicle.tires),
    ]
    return {f"{prefix}.{field}": position for position, (prefix, field) in enumerate(
        (prefix, field) for prefix, block in blocks for field in block._fields)}


def unknown_parameter(place: Place, name: str, index: Mapping[str, int]) -> InputError:
    """An error about a parameter name, with the nearest that exists, written out in full."""
    name = name[:LONGEST_NAME]
    problem = f"no parameter {name!r}"
    prefix, _, field = name.rpartition(".")
    parts = [key.rpartition(".") for key in index]
    # the same field elsewhere, else the nearest block, and in it the nearest field
    blocks = dict.fromkeys(block for block, _, one in parts if one == field)
    blocks = blocks or dict.fromkeys(block for block, _, _ in parts)
    near = prefix if prefix in blocks else closest(prefix or name, blocks, _SIMILAR)
    if not near:
        same = [key for key, (_, _, one) in zip(index, parts, strict=True) if one == field]
        how = "one of: " if same else "a name that begins with one of: "
        return place.error(problem, how + ", ".join(same or blocks))
    fields = [one for block, _, one in parts if block == near]
    if close := closest(field, fields, _SIMILAR):
        return place.error(f"{problem}, did you mean {f'{near}.{close}'!r}?")
    return place.error(problem, "one of: " + ", ".join(f"{near}.{one}" for one in fields))
