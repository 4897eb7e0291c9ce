"""What a truck is: files, their schema, masses and loads, and the packed parameter vector."""

from truck_blowout_sim.vehicle.loading import load_road, load_vehicle, road_values
from truck_blowout_sim.vehicle.packing import Packed, movable_load, pack
from truck_blowout_sim.vehicle.vehicle import Vehicle
from truck_blowout_sim.vehicle.writing import write_vehicle

__all__ = ["Packed", "Vehicle", "load_road", "load_vehicle", "movable_load", "pack", "road_values",
           "write_vehicle"]
