"""Which tires have the tables that a force model or a blowout law reads.

Known limits: tables are made when a vehicle is packed, from its files; none is added later.
Validated with: test/vehicle/test_tables.py.
"""

from __future__ import annotations

from typing import Any

from truck_blowout_sim.physics import layout
from truck_blowout_sim.vehicle.document import Place
from truck_blowout_sim.vehicle.schema.tire import LAWS, MODELS
from truck_blowout_sim.vehicle.vehicle import Vehicle

_POSITIONS = ("table", "map_table")


def check_table_use(vehicle: Vehicle, block: type[Any], name: str, value: float,
                    place: Place) -> None:
    """Refuse a parameter that would make a tire read a table it does not have.

    Args:
        vehicle: what is packed; ``block``: of the parameter with this packed ``name``.
        value: it would get; ``place``: where it was given.

    Raises:
        InputError: says what the tire's file would have to state.
    """
    if block is not layout.TireParams:
        return
    prefix, _, field = name.rpartition(".")
    tire = prefix.removeprefix("tire.")
    if field in _POSITIONS:
        raise place.error(f"{field} is a place inside the packed vehicle",
                          "`model:` in the tire file or `law:` in the blowout file")
    mapped = vehicle.tire_specs[tire].model == "map"
    if field == "model" and value == MODELS.index("map") and not mapped:
        raise place.error(f"tire {tire} has no force map", "`model: map` in its tire file")
    if field == "law" and value == LAWS.index("steps") and vehicle.blowout.law != "steps":
        raise place.error("the blowout file has no table of steps", "`law: steps` in that file")
