"""What a column's name hints at."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from truck_blowout_sim.recordings.logs.log import Column, Table
from truck_blowout_sim.recordings.mapping.plausible import unit_by_size
from truck_blowout_sim.recordings.mapping.proposing import Wheels, propose
from truck_blowout_sim.recordings.mapping.signs import gravity_is_removed
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
    ("sog", "tractor_vx_mps"), ("course over ground", "tractor_yaw_rad"),
    ("G Force Lat", "tractor_ay_mps2"), ("G Force Long", "tractor_ax_mps2"),
    ("a_lat", "tractor_ay_mps2"), ("a_long", "tractor_ax_mps2"),
    ("TirePressLF_kPa", "tire_pressure_steer_left_pa"), ("Tyre pressure", ""),
    ("RF Tyre Pressure", "tire_pressure_steer_right_pa"),
    ("Reifendruck VL", "tire_pressure_steer_left_pa"),
    ("EngineSpeed", ""), ("steer_axle_rpm", ""), ("Note", ""),
])  # fmt: skip
def test_names(name: str, channel: str) -> None:
    assert channel_hinted(name) == channel


@pytest.mark.parametrize(("numbers", "channel", "quantity", "unit"), [
    ([80.0, 90.0], "tractor_vx_mps", "speed", "km/h"), ([20.0], "tractor_vx_mps", "speed", "m/s"),
    ([40.0], "tractor_vx_mps", "speed", "km/h"),
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


G, MPH, KNOT = 9.81, 0.44704, 0.51444


@pytest.mark.parametrize(("speed_mps", "factor", "unit"), [
    (16.0, MPH, "mph"), (23.0, MPH, "mph"), (23.0, 1 / 3.6, "km/h"), (9.0, 1 / 3.6, "km/h"),
    (17.0, 1.0, "m/s"), (41.0, 1.0, "m/s"),
])  # fmt: skip
@pytest.mark.parametrize("acceleration", [G, 1.0])
def test_a_stop_tells_the_unit_of_the_speed(
    speed_mps: float, factor: float, unit: str, acceleration: float
) -> None:
    """The nose dives, so that the accelerometer reads a tenth more; a slope adds a constant."""
    times = 0.02 * np.arange(500)
    along = np.where(times > 5.0, -0.3 * speed_mps * 0.5 * (1.0 - np.cos(times)), 0.0)
    speed = speed_mps + 0.02 * np.cumsum(along)
    speed -= min(0.0, speed.min())
    log = Table(Path("log"), "text", {
        "speed": Column(speed / factor),
        "ax": Column((1.1 * along + 0.2) / acceleration, "g" if acceleration == G else "m/s2"),
    })  # fmt: skip
    found = {p.channel: p.unit for p in propose(log, time_s=times)}
    assert found["tractor_vx_mps"] == unit


@pytest.mark.parametrize(("factor", "unit"), [
    (MPH, "mph"), (KNOT, "knots"), (1 / 3.6, "km/h"), (1.0, "m/s"),
])  # fmt: skip
@pytest.mark.parametrize("speed_mps", [8.0, 24.0])
def test_the_way_tells_knots_from_mph(speed_mps: float, factor: float, unit: str) -> None:
    times = 0.1 * np.arange(200)
    east = speed_mps * times
    log = Table(Path("log"), "text", {
        "speed": Column(np.full(times.size, speed_mps / factor)),
        "easting": Column(500_000.0 + 0.6 * east), "northing": Column(0.8 * east),
    })  # fmt: skip
    found = {p.channel: p.unit for p in propose(log, time_s=times)}
    assert (found["tractor_vx_mps"], found["tractor_x_m"]) == (unit, "m")


def small(**factors: float) -> dict[str, Column]:
    """Columns of straight driving, which tell no units."""
    dice = np.random.default_rng(1)
    return {name: Column(dice.normal(0.0, 0.01, 300) / by) for name, by in factors.items()}


@pytest.mark.parametrize(("speed", "units"), [
    (Column(np.full(300, 80.0)), {"vy_mps": "km/h", "yaw_rate_radps": "deg/s", "roll_rad": "deg"}),
    (Column(np.full(300, 23.0), "m/s"),
     {"vy_mps": "m/s", "yaw_rate_radps": "rad/s", "roll_rad": "rad"}),
    (Column(np.full(300, 50.0), "mph"),
     {"vy_mps": "mph", "yaw_rate_radps": "deg/s", "roll_rad": "deg"}),
])  # fmt: skip
def test_small_numbers_have_the_units_of_their_log(speed: Column, units: dict[str, str]) -> None:
    log = Table(Path("log"), "text", {"Vx": speed, **small(Vy=1.0, AVz=1.0, Roll=1.0)})
    found = {p.channel.removeprefix("tractor_"): p for p in propose(log)}
    assert {stem: found[stem].unit for stem in units} == units
    if units["vy_mps"] != "m/s":
        assert "unit as of Vx" in found["vy_mps"].why


def test_topics_have_units_of_their_own() -> None:
    log = Table(Path("log"), "bag (MCAP)", {
        "/speed_kmh:data": Column(np.full(300, 80.0)), "/gyro:yaw_rate": small(r=1.0)["r"],
    })  # fmt: skip
    assert [p.unit for p in propose(log)] == ["km/h", "rad/s"]


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
