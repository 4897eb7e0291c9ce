"""The table of channels against the interface's own words."""

from __future__ import annotations

import pytest

from truck_blowout_sim.recordings import (
    DEFAULT_HUBS,
    DEFAULT_TIRES,
    INPUT_NAMES,
    by_name,
    channels_for,
)
from truck_blowout_sim.recordings.cdr import template, walk
from truck_blowout_sim.recordings.names import parts_of

BODY = [
    *("x_m", "y_m", "yaw_rad", "roll_rad", "pitch_rad", "vx_mps", "vy_mps"),
    *("yaw_rate_radps", "roll_rate_radps", "pitch_rate_radps", "ax_mps2", "ay_mps2", "az_mps2"),
]


def test_standard_columns_are_those_of_the_interface_in_its_order() -> None:
    expected = [
        *INPUT_NAMES,
        *(f"tractor_{stem}" for stem in BODY),
        *(f"trailer_{stem}" for stem in BODY),
        *(f"hub_speed_{hub}_radps" for hub in DEFAULT_HUBS),
        *(f"tire_pressure_{tire}_pa" for tire in DEFAULT_TIRES),
        *(f"brake_chamber_{hub}_pa" for hub in DEFAULT_HUBS),
    ]
    assert [c.name for c in channels_for() if c.standard] == expected
    assert len(DEFAULT_HUBS) == 10
    assert len(DEFAULT_TIRES) == 18


def test_names_are_unique_and_end_in_their_unit() -> None:
    suffix = {"m": "_m", "rad": "_rad", "m/s": "_mps", "rad/s": "_radps", "m/s2": "_mps2",
              "Pa": "_pa", "N": "_n"}  # fmt: skip
    table = channels_for()
    assert len(by_name(table)) == len(table)
    for channel in table:
        assert channel.unit == "1" or channel.name.endswith(suffix[channel.unit]), channel.name


def test_no_two_channels_share_a_field() -> None:
    places = [(p.topic, p.field) for c in channels_for() for p in c.places]
    assert len(set(places)) == len(places)


def test_every_plain_field_exists_in_its_message() -> None:
    for channel in channels_for():
        for place in channel.places:
            if ":" not in place.field and "[" not in place.field:
                layout = walk(template(place.ros_type), place.ros_type)
                assert place.field in layout.numbers, (channel.name, place.field)


@pytest.mark.parametrize(
    ("name", "topic", "field", "offset"),
    [
        ("brake_pressure_trailer_pa", "brake_pressure/trailer", "data", 0.0),
        ("tractor_yaw_rate_radps", "tractor/yaw_rate", "data", 0.0),
        ("trailer_vx_mps", "trailer/odometry", "twist.twist.linear.x", 0.0),
        ("tractor_az_mps2", "tractor/imu", "linear_acceleration.z", 0.0),
        ("hub_speed_drive_1_left_radps", "joint_states", "velocity[drive_1_left_spin]", 0.0),
        ("steer_left_steer_rad", "joint_states", "position[steer_left_steer]", 0.0),
        ("articulation_rad", "joint_states", "position[articulation]", 0.0),
        (
            "tire_pressure_trailer_1_left_outer_pa",
            "tires/trailer_1_left_outer/pressure",
            "fluid_pressure",
            101325.0,
        ),
        (
            "brake_chamber_trailer_2_right_pa",
            "brake_chambers/trailer_2_right/pressure",
            "fluid_pressure",
            101325.0,
        ),
    ],
)
def test_places_are_those_of_the_interface(
    name: str, topic: str, field: str, offset: float
) -> None:
    channel = by_name(channels_for())[name]
    assert (channel.topic, channel.field, channel.offset) == (topic, field, offset)


def test_another_vehicle_gets_its_own_rows() -> None:
    wheels = [f"{end}_{side}" for end in ("front", "rear") for side in ("left", "right")]
    names = [c.name for c in channels_for(wheels, wheels, ["tractor"], ["front_left"])]
    assert "tire_pressure_front_left_pa" in names
    assert "front_left_steer_rad" in names
    assert not [n for n in names if "trailer_v" in n or "articulation" in n or "drive_1" in n]


def test_parts_are_found_in_names_in_the_vehicle_s_order() -> None:
    names = [c.name for c in channels_for()]
    parts = parts_of(reversed(names))
    assert (parts.hubs, parts.tires) == (DEFAULT_HUBS, DEFAULT_TIRES)
    assert parts.steered_hubs == ("steer_left", "steer_right")
    assert [c.name for c in parts.table()] == names
