"""From a vehicle to the flat vectors the compiled core works on."""

from truck_blowout_sim.vehicle.packing.chassis import movable_load
from truck_blowout_sim.vehicle.packing.packed import Packed, pack
from truck_blowout_sim.vehicle.packing.spreads import packed_spreads

__all__ = ["Packed", "movable_load", "pack", "packed_spreads"]
