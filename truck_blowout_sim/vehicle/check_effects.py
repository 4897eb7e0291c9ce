"""Checks of the parameters a file sets by their packed names."""

from __future__ import annotations

from truck_blowout_sim.vehicle.packing.bounds import check_shares, check_value
from truck_blowout_sim.vehicle.packing.names import (
    parameter_blocks,
    parameter_index,
    unknown_parameter,
)
from truck_blowout_sim.vehicle.packing.table_use import check_table_use
from truck_blowout_sim.vehicle.vehicle import Vehicle


def check_effects(vehicle: Vehicle) -> None:
    """Check every effect of a vehicle.

    Raises:
        InputError: an unknown parameter, or a value the parameter cannot have.
    """
    if not vehicle.effects:
        return
    index, blocks = parameter_index(vehicle), dict(parameter_blocks(vehicle))
    for name, effect in vehicle.effects.items():
        if name not in index:
            raise unknown_parameter(effect.place, name, index)
        prefix, _, field = name.rpartition(".")
        check_value(blocks[prefix], field, effect.value, effect.place)
        check_table_use(vehicle, blocks[prefix], name, effect.value, effect.place)
    _check_shares(vehicle)


def _check_shares(vehicle: Vehicle) -> None:
    """Check the drive shares if an effect sets one."""
    shares = {f"hub.{hub}.drive_share": vehicle.spec.axles[vehicle.axle_of_hub(hub)].drive_share
              for hub in vehicle.hubs}
    given = {name: effect for name, effect in vehicle.effects.items() if name in shares}
    for effect in given.values():
        check_shares(shares | {name: other.value for name, other in given.items()}, effect.place)
