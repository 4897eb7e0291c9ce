"""Names of the packed parameters, such as `hub.trailer_2_left.brake_gain`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.physics import layout
from truck_blowout_sim.vehicle.document import Place
from truck_blowout_sim.vehicle.reading import unknown
from truck_blowout_sim.vehicle.schema.axle import CIRCUITS
from truck_blowout_sim.vehicle.vehicle import Vehicle

LONGEST_NAME = 120  # nobody meant a longer one, and comparing it with all others takes time


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
    blocks = parameter_blocks(vehicle)
    keys = [f"{prefix}.{field}" for prefix, block in blocks for field in block._fields]
    return {key: position for position, key in enumerate(keys)}


def unknown_parameter(place: Place, name: str, index: Mapping[str, int]) -> InputError:
    """An error about a parameter name, with the nearest that exists."""
    problem = f"no parameter {name[:LONGEST_NAME]!r}"
    prefix, _, field = name[:LONGEST_NAME].rpartition(".")
    fields = tuple(key.rpartition(".")[2] for key in index if key.rpartition(".")[0] == prefix)
    if fields:
        return unknown(place, problem, field, fields)
    prefixes = tuple(dict.fromkeys(key.rpartition(".")[0] for key in index))
    return unknown(place, problem, prefix or name[:LONGEST_NAME], prefixes)
