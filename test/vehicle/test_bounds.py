"""What a named parameter may be: no sign turns around, nothing is divided by zero."""

from __future__ import annotations

from collections.abc import Callable
from math import inf
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.simulation import InitialState, Inputs, Truck
from truck_blowout_sim.vehicle import Packed, load_vehicle
from truck_blowout_sim.vehicle.packing.bounds import SECTIONS, WORDS, rule_of

REFUSED = {
    "hub.steer_left.brake_gain": -1.0,
    "hub.steer_left.brake_linear_nmppa": -1.0,
    "hub.steer_left.brake_enabled": 2.0,
    "world.friction_scale": 1e-300,
    "world.friction_change_scale": 0.0,
    "world.patch_scale": -1.0,
    "world.bank_change_rad": 1.5,
    "axle.steer.half_spacing_m": 0.0,
    "axle.steer.half_track_m": -1.0,
    "axle.steer.peak_scale": -1.0,
    "axle.steer.center_height_m": 0.0,
    "steering.wheelbase_m": 0.0,
    "steering.stiffness_gain": -1.0,
    "steering.compliance_on": 2.0,
    "tire.steer_left.hole_scale": -1.0,
    "tire.steer_left.relaxation_scale": -1.0,
    "tire.steer_left.friction_scale": 1e-300,
    "tire.steer_left.flat_drag_scale": -1.0,
    "unit.tractor.payload_kg": -1e5,
    "unit.tractor.shift_duration_s": 0.0,
    "unit.trailer.hitch_x_m": 1e6,
    "driveline.retarder_throttle": 0.0,
    "circuit.steer.lag_extra_s": -1.0,
    "hub.steer_left.drive_share": 0.9,
}


@pytest.mark.parametrize("block", SECTIONS, ids=lambda block: block.__name__)
def test_every_parameter_has_a_rule(block: type[Any]) -> None:
    fields: tuple[str, ...] = block._fields
    assert [f for f in fields if rule_of(block, f) is None and (block, f) not in WORDS] == []


@pytest.mark.parametrize(("name", "value"), REFUSED.items())
def test_what_no_vehicle_has_is_refused(packed: Packed, extending: Callable[[str], Path],
                                        name: str, value: float) -> None:
    """As a value given in Python, and as an effect of a file, which names the line."""
    with pytest.raises(InputError, match=name):
        packed.with_values({name: value})
    with pytest.raises(InputError, match=f"line 3: .*{name}"):
        load_vehicle(extending(f"effects:\n  {name}: {{value: {value!r}, source: none}}\n"))


def test_shares_may_be_handed_around(packed: Packed) -> None:
    moved = packed.with_values({"hub.drive_1_left.drive_share": 0.0,
                                "hub.drive_1_right.drive_share": 0.5})
    assert moved["hub.drive_1_right.drive_share"] == 0.5


def test_what_ships_is_within_its_bounds(packed: Packed) -> None:
    same = packed.with_values({name: packed[name] for name in packed.index})
    assert np.array_equal(same.params, packed.params)


@pytest.mark.parametrize("name", ["world.friction_scale", "world.friction_change_scale",
                                  "axle.steer.peak_scale", "tire.steer_left.relaxation_scale"])
def test_the_least_there_may_be_can_be_driven(packed: Packed, name: str) -> None:
    """At its lower bound a factor that something is divided by leaves a motion that is finite."""
    prefix, _, field = name.rpartition(".")
    rule = rule_of(packed.blocks[prefix], field)
    assert rule is not None
    assert -inf < rule.low
    truck = packed.with_values({"world.friction_change_time_s": 0.0, name: rule.low})
    run = Truck(truck, initial=InitialState(speed_mps=20.0))
    run.advance(Inputs(steering_wheel_angle_rad=1.0, brake_pressure_steer_pa=3e5), 500)
    assert run.finite
