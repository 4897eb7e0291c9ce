"""From a vehicle to the flat vectors the compiled core works on."""

from truck_blowout_sim.vehicle.packing.chassis import movable_load
from truck_blowout_sim.vehicle.packing.packed import Packed, pack

__all__ = ["Packed", "movable_load", "pack"]
