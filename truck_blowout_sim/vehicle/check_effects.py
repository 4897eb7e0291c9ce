"""Checks of the parameters a file sets by their packed names."""

from __future__ import annotations

import math
from typing import Any

from truck_blowout_sim.physics import layout
from truck_blowout_sim.vehicle.fields import Rule, rules
from truck_blowout_sim.vehicle.packing.blocks import NEUTRAL
from truck_blowout_sim.vehicle.packing.names import (
    parameter_blocks,
    parameter_index,
    unknown_parameter,
)
from truck_blowout_sim.vehicle.reading import LARGEST
from truck_blowout_sim.vehicle.schema import axle, body, controls, road, tire
from truck_blowout_sim.vehicle.vehicle import Effect, Vehicle

# Sections whose bounds hold for the parameters of the same name. Positions are left out: packed
# ones are seen from the center of gravity, so a sign means something else there.
SECTIONS: dict[type[Any], tuple[type[Any], ...]] = {
    layout.WorldParams: (road.RoadSpec,),
    layout.SteeringParams: (controls.SteeringSpec,),
    layout.CouplingParams: (body.FifthWheelSpec,),
    layout.DrivelineParams: (controls.DrivelineSpec,),
    layout.AbsParams: (controls.AbsSpec,),
    layout.CircuitParams: (controls.CircuitSpec,),
    layout.UnitParams: (body.BodySpec, body.FrameSpec, body.AirSpec),
    layout.AxleParams: (axle.AxleSpec, axle.SuspensionSpec),
    layout.HubParams: (axle.AxleSpec,),
    layout.TireParams: (tire.TireSpec, tire.BlowoutSpec),
}
POSITIONS = ("_x_m", "_y_m", "_z_m")


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
        _check_value(blocks[prefix], field, effect)


def _check_value(block: type[Any], field: str, effect: Effect) -> None:
    neutral = NEUTRAL[block].get(field, 0.0)
    rule = None if field.endswith(POSITIONS) or field == "x_m" else _rule(block, field)
    never = math.isinf(neutral) or (rule is not None and rule.infinite)
    if abs(effect.value) > LARGEST and not (never and math.isinf(effect.value)):
        raise effect.place.error(f"{effect.value:g} is out of bounds", "a finite number")
    if rule is None or rule.kind not in ("number", "switch"):
        return
    low, high = (0.0, 1.0) if rule.kind == "switch" else (rule.low, rule.high)
    if effect.value < low or effect.value > high or (rule.open_low and effect.value == low):
        bounds = f"above {low:g}" if rule.open_low else f"from {low:g}"
        raise effect.place.error(
            f"{effect.value:g} is out of bounds", f"{bounds} to {high:g}: {rule.doc}"
        )


def _rule(block: type[Any], field: str) -> Rule | None:
    for section in SECTIONS[block]:
        if field in rules(section):
            return rules(section)[field]
    return None
