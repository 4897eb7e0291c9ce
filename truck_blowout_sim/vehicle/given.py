"""A vehicle however a caller gives it: loaded, packed, or by name."""

from __future__ import annotations

from os import PathLike

from truck_blowout_sim.vehicle.loading import load_vehicle
from truck_blowout_sim.vehicle.packing import Packed, pack
from truck_blowout_sim.vehicle.vehicle import Vehicle

AnyVehicle = Vehicle | Packed | str | PathLike[str]


def packed_of(vehicle: AnyVehicle) -> Packed:
    """The packed parameters of a vehicle, its packed parameters, a path or a shipped name.

    Raises:
        InputError: no such file, or something in it cannot be used.
    """
    if isinstance(vehicle, Packed):
        return vehicle
    return pack(vehicle if isinstance(vehicle, Vehicle) else load_vehicle(vehicle))
