"""The rebuilt log of the 2013 test says what the thesis says, no more and no less."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest

from truck_blowout_sim.recordings import Blowout, Recording, read_recording
from truck_blowout_sim.recordings.rebuild_2013 import NAME, rebuild, write

FOLDER = Path(__file__).resolve().parents[2] / "config" / "recordings"
MPH, FOOT, PSI = 0.44704, 0.3048, 6894.757293168361


@pytest.fixture(scope="module")
def log() -> Recording:
    return read_recording(FOLDER / f"{NAME}.csv")


def at(log: Recording, name: str, time_s: float) -> float:
    return float(log.at(name, time_s))


def test_it_is_made_from_its_yaml_and_nothing_else(tmp_path: Path) -> None:
    write(rebuild(FOLDER / f"{NAME}.yaml"), tmp_path)
    for name in (f"{NAME}.csv", f"{NAME}.provenance.csv"):
        assert (tmp_path / name).read_bytes() == (FOLDER / name).read_bytes()


def test_clock_and_event(log: Recording) -> None:
    assert len(log["tractor_vx_mps"]) == 1499
    assert (log.start_s, log.end_s) == (-4.92, 10.06)
    np.testing.assert_allclose(np.diff(log["throttle"].time_s), 0.01, atol=1e-9)
    assert log.blowouts == (Blowout(0.0, ("steer_left",)),)


def test_only_what_the_text_speaks_of_is_there(log: Recording) -> None:
    assert set(log.channels) == {
        "steering_wheel_angle_rad", "throttle", "brake_pressure_steer_pa",
        "brake_pressure_drive_pa", "brake_pressure_trailer_pa", "tractor_x_m", "tractor_y_m",
        "tractor_vx_mps", "tractor_yaw_rate_radps",
    }  # fmt: skip
    assert "raw record is not public" in log.metadata["origin"]


def test_speed_and_distance(log: Recording) -> None:
    speed = log["tractor_vx_mps"]
    assert at(log, "tractor_vx_mps", 0) / MPH == pytest.approx(52.4, abs=0.6)
    assert at(log, "tractor_vx_mps", 5) / MPH == pytest.approx(50.0, abs=0.05)
    assert (speed.at(0.0) - speed.at(5.0)) / 5 / 9.80665 < 0.03
    assert at(log, "tractor_vx_mps", 10) / MPH == pytest.approx(30.5, abs=3)
    assert at(log, "tractor_x_m", 0) / FOOT == pytest.approx(378.29, abs=0.01)
    assert at(log, "tractor_x_m", 10.06) / FOOT == pytest.approx(1053, abs=1)
    assert (np.diff(speed.value[speed.time_s > 0]) <= 0).all(), "it never gains speed"


def test_yaw_rate(log: Recording) -> None:
    yaw_rate = log["tractor_yaw_rate_radps"]
    degrees = np.degrees(yaw_rate.value)
    assert degrees.max() == pytest.approx(2.5, abs=0.01)
    assert yaw_rate.time_s[degrees.argmax()] == pytest.approx(1.0, abs=0.011)
    clockwise = yaw_rate.time_s[degrees < -0.01]
    assert 0.2 <= -degrees.min() <= 1.5
    assert 1.5 <= clockwise.min() < clockwise.max() <= 3.5
    assert not degrees[yaw_rate.time_s >= 3.5].any()


def test_steering(log: Recording) -> None:
    angle = log["steering_wheel_angle_rad"]
    degrees_right = -np.degrees(angle.value)
    assert degrees_right.max() == pytest.approx(40, abs=0.01)
    assert not degrees_right[angle.time_s < 0.6].any()
    near_peak = angle.time_s[degrees_right > 39.5]
    assert near_peak.max() - near_peak.min() == pytest.approx(1.0, abs=0.25)
    np.testing.assert_allclose(degrees_right[angle.time_s >= 3.0], 25, atol=0.01)


def test_pedals(log: Recording) -> None:
    throttle = log["throttle"]
    assert np.ptp(throttle.value[throttle.time_s <= 3.0]) == 0
    assert not throttle.value[throttle.time_s > 3.31].any()
    assert not log["brake_pressure_steer_pa"].value.any()
    assert not log["brake_pressure_drive_pa"].value.any()
    trailer = log["brake_pressure_trailer_pa"]
    assert not trailer.value[trailer.time_s <= 5.0].any()
    assert 30 < trailer.at(7.0) / PSI < 36


def test_throttle_holds_the_speed_before_the_event(log: Recording) -> None:
    """Force budget written out here once more: air, rolling resistance, the driveline map."""
    speed = at(log, "tractor_vx_mps", -1.0)
    throttle = at(log, "throttle", -1.0)
    drive_n = throttle * 300e3 / speed - 1500 * (1 - throttle)
    air_n = 0.5 * 1.18 * 5.6 * speed**2
    rolling_n = (0.0041 + 2.56e-5 * 3.6 * speed) * 23587 * 9.80665
    assert drive_n == pytest.approx(air_n + rolling_n, rel=1e-3)


def test_position_integrates_speed_and_heading(log: Recording) -> None:
    time_s = log["tractor_vx_mps"].time_s

    def integral(values: np.ndarray) -> np.ndarray:
        return np.concatenate(([0], np.cumsum(0.5 * (values[1:] + values[:-1]) * np.diff(time_s))))

    heading = integral(log["tractor_yaw_rate_radps"].value)
    speed = log["tractor_vx_mps"].value
    np.testing.assert_allclose(
        log["tractor_x_m"].value, integral(speed * np.cos(heading)), atol=2e-3
    )
    np.testing.assert_allclose(
        log["tractor_y_m"].value, integral(speed * np.sin(heading)), atol=2e-3
    )
    assert at(log, "tractor_y_m", 10.06) / FOOT == pytest.approx(16, abs=0.05)


def test_every_sample_has_its_mark(log: Recording) -> None:
    with (FOLDER / f"{NAME}.provenance.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 1499
    assert set(rows[0]) == {"time_s", *log.channels}
    for row in rows:
        for name in log.channels:
            mark, _, lines = row[name].partition(" ")
            assert mark in ("stated", "derived", "interpolated")
            assert lines.startswith("T L") or mark != "stated", (row["time_s"], name)
    peak = next(row for row in rows if row["time_s"] == "1.0")
    assert peak["tractor_yaw_rate_radps"] == "stated T L461 and L853"
