"""Latitude, longitude, one brake pressure, wheel speeds in km/h: what a log has in their place."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
import yaml

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import Recording, read_recording
from truck_blowout_sim.recordings.logs.log import Column, Table
from truck_blowout_sim.recordings.mapping.inventory import inspect_log
from truck_blowout_sim.recordings.mapping.proposing import propose
from truck_blowout_sim.simulation.start import initial_state

TIME_S = 0.05 * np.arange(400)
SPEED_MPS, HEADING_RAD = 20.0, 2.0
LAT_DEG, LON_DEG = 48.1, 11.5
METERS_PER_DEG = 111_200.0


def columns() -> dict[str, np.ndarray]:
    """A drive to the north-west."""
    along = SPEED_MPS * TIME_S
    north, west = along * math.sin(HEADING_RAD), -along * math.cos(HEADING_RAD)
    return {
        "Time": TIME_S,
        "Latitude": LAT_DEG + north / METERS_PER_DEG,
        "Longitude": LON_DEG - west / METERS_PER_DEG / math.cos(math.radians(LAT_DEG)),
        "Speed": 3.6 * SPEED_MPS + 0.0 * TIME_S,
        "Wheel Speed FL": 3.6 * SPEED_MPS + 0.0 * TIME_S,
        "Brake Pressure": 60.0 * (TIME_S > 15.0),
    }


UNITS = {"Time": "s", "Latitude": "deg", "Longitude": "deg", "Speed": "km/h",
         "Wheel Speed FL": "km/h", "Brake Pressure": "bar", "Yaw": "rad/s"}  # fmt: skip
CHANNELS: dict[str, object] = {
    "tractor_latitude_rad": {"from": "Latitude"}, "tractor_longitude_rad": {"from": "Longitude"},
    "tractor_vx_mps": {"from": "Speed"},
}  # fmt: skip


def read(folder: Path, channels: dict[str, object], **changed: np.ndarray) -> Recording:
    table = columns() | changed
    head = ",".join(f"{name} [{UNITS[name]}]" for name in table)
    body = np.column_stack(list(table.values()))
    np.savetxt(folder / "log.csv", body, "%.9f", ",", header=head, comments="")
    (folder / "map.yaml").write_text(yaml.safe_dump({"channels": channels}))
    return read_recording(folder / "log.csv", mapping=folder / "map.yaml")


def test_positions_are_east_and_north_of_the_first_fix(tmp_path: Path) -> None:
    drive = read(tmp_path, CHANNELS)
    x, y = (drive[f"tractor_{axis}"].value for axis in ("x_m", "y_m"))
    assert (x[0], y[0]) == (0.0, 0.0)
    assert math.hypot(x[-1], y[-1]) == pytest.approx(SPEED_MPS * TIME_S[-1], rel=5e-3)
    assert math.atan2(y[-1], x[-1]) == pytest.approx(HEADING_RAD, abs=5e-3)
    assert drive.metadata["map_origin_deg"] == f"{LAT_DEG:.9f} {LON_DEG:.9f}"
    assert any("east and north of the first fix" in note for note in drive.notes)
    assert not {name for name in drive.channels if "tude" in name}


def test_a_drive_without_a_heading_begins_along_its_path(tmp_path: Path) -> None:
    assert initial_state(read(tmp_path, CHANNELS)).yaw_rad == pytest.approx(HEADING_RAD, abs=5e-3)


def test_samples_without_a_fix_are_left_out(tmp_path: Path) -> None:
    lost = {name: np.where(TIME_S < 1.0, 0.0, values) for name, values in columns().items()
            if name in ("Latitude", "Longitude")}  # fmt: skip
    drive = read(tmp_path, CHANNELS, **lost)
    assert drive["tractor_x_m"].time_s[0] == pytest.approx(1.0)
    assert drive["tractor_x_m"].value[0] == 0.0
    assert any("20 samples at latitude and longitude 0" in note for note in drive.notes)


def test_a_wrong_sign_of_longitude_shows_against_the_yaw_rate(tmp_path: Path) -> None:
    rate = 0.1 * np.sin(TIME_S)
    heading = HEADING_RAD + 0.1 * (1.0 - np.cos(TIME_S))
    east = np.cumsum(SPEED_MPS * np.cos(heading)) * 0.05
    north = np.cumsum(SPEED_MPS * np.sin(heading)) * 0.05
    turning = {
        "Latitude": LAT_DEG + north / METERS_PER_DEG, "Yaw": rate,
        "Longitude": LON_DEG + east / METERS_PER_DEG / math.cos(math.radians(LAT_DEG)),
    }  # fmt: skip
    with_rate = CHANNELS | {"tractor_yaw_rate_radps": {"from": "Yaw"}}
    right = read(tmp_path, with_rate, **turning)
    assert not [note for note in right.notes if "opposite sign" in note]
    mirrored = with_rate | {"tractor_longitude_rad": {"from": "Longitude", "sign": -1}}
    wrong = read(tmp_path, mirrored, **turning)
    assert [note for note in wrong.notes if "turning of its path" in note and "sign" in note]


@pytest.mark.parametrize(("channels", "said"), [
    ({"tractor_latitude_rad": {"from": "Latitude"}},
     "tractor_latitude_rad without tractor_longitude_rad"),
    (CHANNELS | {"tractor_x_m": {"from": "Speed", "unit": "m"}}, "tractor_x_m is mapped, too"),
    (CHANNELS | {"tractor_latitude_rad": {"from": "Latitude", "unit": "rad"}}, "reads like deg"),
    ({"hub_speed_steer_left_radps": {"from": "Wheel Speed FL"}},
     "expected radius_m: beside it, the wheel radius that the logger multiplies by"),
    ({"hub_speed_steer_left_radps": {"from": "Wheel Speed FL", "radius_m": 50}}, "0.1 to 2"),
    ({"tractor_vx_mps": {"from": "Speed", "radius_m": 0.5}}, "a radius only for wheel speeds"),
    ({"brake_pressure_pa": {"from": "Brake Pressure"}}
     | {f"brake_pressure_{circuit}_pa": {"from": "Brake Pressure"}
        for circuit in ("steer", "drive", "trailer")},
     "all three circuits have a pressure of their own"),
])  # fmt: skip
def test_what_does_not_make_a_channel_is_one_line(
    tmp_path: Path, channels: dict[str, object], said: str
) -> None:
    with pytest.raises(InputError, match=said):
        read(tmp_path, channels)


def test_a_wheel_speed_in_kmh_is_a_spin_by_the_loggers_radius(tmp_path: Path) -> None:
    wheel = {"from": "Wheel Speed FL", "radius_m": 0.5}
    drive = read(tmp_path, {"hub_speed_steer_left_radps": wheel})
    np.testing.assert_allclose(drive["hub_speed_steer_left_radps"].value, SPEED_MPS / 0.5)


def test_one_brake_pressure_acts_on_all_circuits(tmp_path: Path) -> None:
    drive = read(tmp_path, {"brake_pressure_pa": {"from": "Brake Pressure"}})
    for circuit in ("steer", "drive", "trailer"):
        assert drive[f"brake_pressure_{circuit}_pa"].value.max() == pytest.approx(6e6)
    assert any("steer, drive, trailer" in note for note in drive.notes)


def test_one_circuit_alone_is_said_to_leave_the_others_open(tmp_path: Path) -> None:
    drive = read(tmp_path, {"brake_pressure_drive_pa": {"from": "Brake Pressure"}})
    assert "brake_pressure_steer_pa" in drive.missing_inputs
    assert any("mapped as brake_pressure_pa" in note for note in drive.notes)


def test_hydraulic_pressures_are_read_and_told(tmp_path: Path) -> None:
    drive = read(tmp_path, {"brake_pressure_pa": {"from": "Brake Pressure"}})
    assert any("reaches 60 bar: hydraulic brakes have that" in note for note in drive.notes)
    with pytest.raises(InputError, match="beyond what a truck can do"):
        read(tmp_path, {"brake_pressure_pa": {"from": "Brake Pressure", "unit": "MPa"}})


def test_inspect_guesses_positions_wheels_and_the_brake(tmp_path: Path) -> None:
    read(tmp_path, CHANNELS)
    becomes = {line.name: line.channel for line in inspect_log(tmp_path / "log.csv").lines}
    assert becomes["Latitude"] == "tractor_latitude_rad"
    assert becomes["Wheel Speed FL"] == "hub_speed_steer_left_radps"
    assert becomes["Brake Pressure"] == "brake_pressure_pa"


def test_half_a_position_and_a_second_one_are_not_proposed() -> None:
    degrees = Column(np.array([48.0, 48.1]), "deg")
    half = Table(Path("log"), "text log", {"lat": degrees})
    assert not propose(half)
    meters = Column(np.array([1.0, 2.0]), "m")
    both = Table(Path("log"), "text log", {"lat": degrees, "lon": degrees, "x": meters})
    assert [one.channel for one in propose(both)] == ["tractor_x_m"]


def test_a_vbox_counts_longitude_to_the_west_in_minutes(tmp_path: Path) -> None:
    rows = "\n".join(f"12{i:04d}.00 {2886.0 + 1e-3 * i:.5f} {-690.0 - 1e-3 * i:.5f} 72.0"
                     for i in range(50))  # fmt: skip
    text = f"[column names]\ntime lat long velocity\n\n[data]\n{rows}\n"
    (tmp_path / "drive.vbo").write_text(text)
    found = {one.channel: one for one in inspect_log(tmp_path / "drive.vbo").proposals}
    assert found["tractor_longitude_rad"].sign == -1.0
    assert found["tractor_latitude_rad"].column == "lat"
    assert found["tractor_latitude_rad"].unit == ""  # the format says minutes of arc
