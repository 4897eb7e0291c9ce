"""What a column's name hints at."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from truck_blowout_sim.recordings.logs.log import Column, Table
from truck_blowout_sim.recordings.mapping.plausible import unit_by_size
from truck_blowout_sim.recordings.mapping.proposing import (
    Wheels,
    gravity_is_removed,
    propose,
)
from truck_blowout_sim.recordings.mapping.vocabulary import channel_hinted


@pytest.mark.parametrize(("name", "channel"), [
    ("SteerAngle", "steering_wheel_angle_rad"), ("Steer_SW", "steering_wheel_angle_rad"),
    ("steering_wheel_angle", "steering_wheel_angle_rad"), ("StrWhlAng", "steering_wheel_angle_rad"),
    ("Lenkradwinkel", "steering_wheel_angle_rad"), ("SteeringWheelSpeed", ""),
    ("Speed", "tractor_vx_mps"), ("Vx_SM", "tractor_vx_mps"),
    ("Pbk_Con", "brake_pressure_pa"), ("VehSpd", "tractor_vx_mps"), ("Vx", "tractor_vx_mps"),
    ("/vehicle/speed_report:speed", "tractor_vx_mps"), ("velocity", "tractor_vx_mps"),
    ("AVz", "tractor_yaw_rate_radps"), ("AVz_2", "trailer_yaw_rate_radps"),
    ("YawRate", "tractor_yaw_rate_radps"), ("Yaw rate", "tractor_yaw_rate_radps"),
    ("/ins/imu:angular_velocity.z", "tractor_yaw_rate_radps"),
    ("/trailer/imu:angular_velocity.z", "trailer_yaw_rate_radps"),
    ("Lat acc", "tractor_ay_mps2"), ("Ay", "tractor_ay_mps2"), ("LongAcc", "tractor_ax_mps2"),
    ("Gierrate", "tractor_yaw_rate_radps"), ("Heading", "tractor_yaw_rad"),
    ("Art_H", "articulation_rad"), ("AVy_L1", "hub_speed_steer_left_radps"),
    ("AVy_R5", "hub_speed_trailer_2_right_radps"), ("throttle_percent", "throttle"),
    ("trailer_brake_kpa_abs", "brake_pressure_trailer_pa"), ("Satellites", ""),
    ("Latitude", "tractor_latitude_rad"), ("GPS_Lon", "tractor_longitude_rad"),
    ("/gnss/fix:latitude", "tractor_latitude_rad"), ("/gnss/fix:altitude", "tractor_altitude_m"),
    ("WhlSpd_RearRight", "hub_speed_drive_1_right_radps"),
    ("wheel_speed_fl", "hub_speed_steer_left_radps"), ("Wheel speed", ""),
    ("BrkPrs", "brake_pressure_pa"), ("Brake pressure front", "brake_pressure_steer_pa"),
    ("data.Vx", "tractor_vx_mps"), ("log.AVz_2", "trailer_yaw_rate_radps"),
    ("log.trailer.AVz", "trailer_yaw_rate_radps"), ("log.speed.data", "tractor_vx_mps"),
    ("EngineSpeed", ""), ("steer_axle_rpm", ""), ("Note", ""),
])  # fmt: skip
def test_names(name: str, channel: str) -> None:
    assert channel_hinted(name) == channel


@pytest.mark.parametrize(("numbers", "channel", "quantity", "unit"), [
    ([80.0, 90.0], "tractor_vx_mps", "speed", "km/h"), ([20.0], "tractor_vx_mps", "speed", "m/s"),
    ([3.0], "tractor_yaw_rate_radps", "angular rate", "deg/s"),
    ([0.05], "tractor_yaw_rate_radps", "angular rate", "rad/s"),
    ([1.0, 0.98], "tractor_az_mps2", "acceleration", "g"),
    ([9.8], "tractor_az_mps2", "acceleration", "m/s2"),
    ([8.0], "tire_pressure_steer_left_pa", "pressure", "bar"),
    ([2.42], "brake_pressure_pa", "pressure", "bar"),
    ([0.8], "brake_pressure_pa", "pressure", "MPa"), ([6.5], "tractor_yaw_rad", "angle", "deg"),
    ([110.0], "tire_pressure_steer_left_pa", "pressure", "psi"),
    ([758.0], "tire_pressure_steer_left_pa", "pressure", "kPa"),
    ([758e3], "tire_pressure_steer_left_pa", "pressure", "Pa"),
    ([40.0], "steering_wheel_angle_rad", "angle", "deg"), ([33.0], "throttle", "ratio", "%"),
])  # fmt: skip
def test_units_by_size(numbers: list[float], channel: str, quantity: str, unit: str) -> None:
    assert unit_by_size(np.array(numbers), channel, quantity) == unit


@pytest.mark.parametrize(("name", "unit"), [
    ("/can/swa_deg:data", "deg"), ("SteerAngle_rad", "rad"), ("/can/swa:data", "deg"),
])  # fmt: skip
def test_a_unit_in_the_name_goes_before_the_size(name: str, unit: str) -> None:
    column = Column(np.array([-30.0, 30.0]))
    (found,) = propose(Table(Path("log"), "bag (MCAP)", {name: column}))
    assert found.unit == unit


@pytest.mark.parametrize(("amount", "factors", "units"), [
    (0.3, {}, ["rad", "m/s", "rad/s", "m/s2"]),
    (0.05, {"yaw": 57.3, "AVz": 57.3}, ["deg", "m/s", "deg/s", "m/s2"]),
    (0.01, {"yaw": 57.3, "AVz": 57.3}, ["deg", "m/s", "deg/s", "m/s2"]),
    (0.01, {"Vx": 3.6}, ["rad", "km/h", "rad/s", "m/s2"]),
    (0.04, {"Vx": 3.6, "Ay": 1 / 9.81, "AVz": 57.3, "yaw": 57.3}, ["deg", "km/h", "deg/s", "g"]),
])  # fmt: skip
def test_small_numbers_get_the_units_in_which_they_agree(
    amount: float, factors: dict[str, float], units: list[str]
) -> None:
    """Lateral acceleration, speed and yaw rate tell each other's units; so do heading and rate."""
    times = 0.01 * np.arange(1000)
    rate, speed = amount * np.sin(times), np.full(times.size, 20.0)
    drive = {"yaw": amount * (1.0 - np.cos(times)), "Vx": speed, "AVz": rate, "Ay": speed * rate}
    columns = {name: Column(factors.get(name, 1.0) * values) for name, values in drive.items()}
    found = propose(Table(Path("log"), "text", columns), time_s=times)
    assert [proposal.unit for proposal in found] == units


@pytest.mark.parametrize(("upward_g", "sign", "removed"), [
    (1.0, 1.0, False), (-1.0, -1.0, False), (-0.01, 1.0, True),
])  # fmt: skip
def test_the_vertical_acceleration_tells_axes_and_gravity(
    upward_g: float, sign: float, removed: bool
) -> None:
    """At rest it reads 1 g, -1 g where z points down, and 0 where gravity is not in it (CarSim)."""
    columns = {"Az": Column(np.array([upward_g, upward_g, upward_g + 0.02]), "g"),
               "Ay": Column(np.array([0.0, 0.1, 0.2]), "g")}  # fmt: skip
    log = Table(Path("log"), "text", columns)
    found = propose(log)
    assert {p.channel: p.sign for p in found} == {"tractor_ay_mps2": sign, "tractor_az_mps2": sign}
    assert gravity_is_removed(log, found) is removed


def wheel_log(*names: str) -> Table:
    speeds = np.array([80.0, 81.0, 80.5])
    return Table(Path("log"), "text", {name: Column(speeds, "km/h") for name in names})


def test_a_cars_wheels_get_its_own_hub_names() -> None:
    """Rear wheels of two axles, their radius from its vehicle file; no third axle, no guess."""
    wheels = Wheels(("front_left", "front_right", "rear_left", "rear_right"),
                    (0.31, 0.31, 0.32, 0.32), "this car")  # fmt: skip
    log = wheel_log("wheel_speed_fl", "wheel_speed_rr", "AVy_L3")
    found = {p.column: (p.channel, p.radius_m) for p in propose(log, wheels=wheels)}
    assert found == {"wheel_speed_fl": ("hub_speed_front_left_radps", 0.31),
                     "wheel_speed_rr": ("hub_speed_rear_right_radps", 0.32)}  # fmt: skip
    trucks = {p.channel for p in propose(log)}
    assert "hub_speed_steer_left_radps" in trucks
