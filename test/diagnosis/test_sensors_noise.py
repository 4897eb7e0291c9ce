from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from scipy.signal import butter, filtfilt

from truck_blowout_sim import read_recording
from truck_blowout_sim.diagnosis.sensors import (
    channel_noise,
    seen_quanta,
    series_noise,
    slow_noise,
    told_noise,
)
from truck_blowout_sim.recordings import Recording, Series

TIME = np.arange(0.0, 20.0, 0.01)
MOTION = 3.0 * np.sin(2 * np.pi * 0.4 * TIME) + np.where(TIME > 10.0, 2.0 * (TIME - 10.0), 0.0)


def white(seed: int) -> np.ndarray:
    return np.random.default_rng(seed).standard_normal(TIME.size)


@pytest.mark.parametrize("sigma", [0.001, 0.03, 0.2])
def test_white_noise_is_found_under_motion(sigma: float) -> None:
    found = series_noise(Series(TIME, MOTION + sigma * white(1)))
    assert found.sigma == pytest.approx(sigma, rel=0.08)
    assert found.white
    assert found.effective_rate_hz == pytest.approx(100.0)
    assert found.quantum == 0.0


def test_rounding_is_found_and_counts_as_noise() -> None:
    found = series_noise(Series(TIME, np.round((MOTION + 0.02 * white(2)) / 0.05) * 0.05))
    assert found.quantum == pytest.approx(0.05)
    assert found.sigma == pytest.approx(np.hypot(0.02, 0.05 / np.sqrt(12)), rel=0.15)


def test_a_channel_at_rest_has_the_noise_of_its_rounding() -> None:
    value = np.zeros(TIME.size)
    value[::50] = 0.05
    assert series_noise(Series(TIME, value)).sigma >= 0.05 / np.sqrt(12) * 0.99


def test_a_channel_that_hardly_leaves_its_step_knows_it_from_other_runs() -> None:
    """Ten seconds at one step show no noise at all; the rounding is there all the same."""
    moving = Series(TIME, np.round((MOTION + 0.02 * white(2)) / 0.14) * 0.14)
    still = Series(TIME, np.full(TIME.size, 20.42))
    flips = Series(TIME, 20.42 + 0.14 * (np.arange(TIME.size) % 400 == 7))
    assert series_noise(flips).quantum == pytest.approx(0.14)
    runs = [Recording(f"run {k}", {"tractor_vx_mps": s}) for k, s in enumerate((still, moving))]
    quanta = seen_quanta(runs)
    assert quanta["tractor_vx_mps"] == pytest.approx(0.14)
    assert channel_noise(runs[0])["tractor_vx_mps"].sigma < 1e-6
    known = channel_noise(runs[0], quanta)["tractor_vx_mps"]
    assert known.sigma == known.floor == pytest.approx(0.14 / np.sqrt(12.0))


def test_a_jump_there_and_back_is_no_step_of_the_instrument() -> None:
    assert series_noise(Series(TIME, 4e5 * ((TIME > 8.0) & (TIME < 12.0)))).quantum == 0.0


def test_filtered_noise_is_seen_as_coloured_with_its_full_sigma() -> None:
    b, a = butter(2, 0.4)
    coloured = filtfilt(b, a, white(3))
    coloured *= 0.1 / coloured.std()
    found = series_noise(Series(TIME, MOTION + coloured))
    assert not found.white
    assert found.sigma == pytest.approx(0.1, rel=0.2)
    lagged = [np.mean(coloured[k:] * coloured[: coloured.size - k]) for k in range(1, 12)]
    integral_s = 0.01 * (1.0 + 2.0 * sum(lagged) / np.mean(coloured**2))
    assert 0.5 * integral_s < found.correlation_s < 2.0 * integral_s


def test_noise_that_grows_with_the_level_is_split() -> None:
    level = 4e5 * (TIME > 10.0)
    found = series_noise(Series(TIME, level + np.hypot(500.0, 0.005 * level) * white(4)))
    assert found.relative == pytest.approx(0.005, rel=0.2)
    assert found.at(np.array([0.0, 4e5])) == pytest.approx([500.0, 2060.0], rel=0.2)


def test_a_jolt_does_not_count_as_noise() -> None:
    jolt = 5.0 * np.exp(-(((TIME - 8.0) / 0.01) ** 2))
    assert series_noise(Series(TIME, MOTION + jolt + 0.03 * white(5))).sigma == pytest.approx(
        0.03, rel=0.1
    )


def stated_sigma(metadata: str, quantity: str) -> float:
    value, unit = re.search(rf"{quantity} ([0-9.]+) (\S+?)(,|$)", metadata).groups()[:2]
    return float(value) * (np.pi / 180.0 if unit.startswith("deg") else 1.0)


QUANTITIES = {
    "velocity": ("vx_mps", "vy_mps"),
    "rate": ("yaw_rate_radps", "roll_rate_radps", "pitch_rate_radps"),
    "acceleration": ("ax_mps2", "ay_mps2", "az_mps2"),
    "tilt": ("roll_rad", "pitch_rad"),
    "heading": ("yaw_rad",),
}


@pytest.mark.parametrize("name", ["blowout", "lane_change", "coast_down"])
def test_stated_noise_of_sample_recordings_is_found(shared_recordings: Path, name: str) -> None:
    recording = read_recording(shared_recordings / "proving_ground" / "nominal" / f"{name}.csv")
    noise = channel_noise(recording)
    for unit in ("tractor", "trailer"):
        stated = recording.metadata[f"noise_1sigma_{unit}"]
        for quantity, stems in QUANTITIES.items():
            for stem in stems:
                channel = f"{unit}_{stem}"
                sigma = stated_sigma(stated, quantity)
                assert noise[channel].sigma == pytest.approx(sigma, rel=0.15), channel
    for hub in (c for c in noise if c.startswith("hub_speed")):
        level = float(np.median(recording[hub].value))
        assert noise[hub].sigma == pytest.approx(0.002 * level, rel=0.15), hub


def test_errors_of_computed_channels_are_told_in_a_good_instruments_noise() -> None:
    """Pressures and forces too; noise that an instrument really has stays."""
    time_s = np.arange(500) / 100.0
    noisy = np.random.default_rng(3).normal(20.0, 0.002, time_s.size)
    recording = Recording("computed", {
        "brake_chamber_steer_left_pa": Series(time_s, 0.0 * time_s),
        "tire_fz_steer_left_n": Series(time_s, 1e4 + np.sin(time_s)),
        "hub_speed_steer_left_radps": Series(time_s, noisy)})  # fmt: skip
    noise = channel_noise(recording)
    told = told_noise(recording, noise)
    assert told["brake_chamber_steer_left_pa"].sigma == 500.0
    assert told["tire_fz_steer_left_n"].sigma == 24.0
    assert told["hub_speed_steer_left_radps"] == noise["hub_speed_steer_left_radps"]


def test_a_measured_record_keeps_the_noise_of_a_channel_at_rest() -> None:
    time_s = np.arange(500) / 100.0
    noisy = np.random.default_rng(3).normal(20.0, 0.01, time_s.size)
    recording = Recording("measured", {"tractor_vx_mps": Series(time_s, noisy),
                                       "brake_chamber_steer_left_pa": Series(time_s, 0.0 * time_s)})
    noise = channel_noise(recording)
    assert told_noise(recording, noise) == noise


def test_a_slow_gauge_has_the_noise_of_a_good_one() -> None:
    """A tire's pressure that comes once a second is evidence; two readings are none."""
    time_s = np.arange(0.0, 15.0)
    recording = Recording("slow", {
        "tire_pressure_steer_left_pa": Series(time_s, np.full(15, 760000.0)),
        "tire_pressure_steer_right_pa": Series(time_s[:2], np.full(2, 760000.0)),
        "tractor_vx_mps": Series(np.arange(100) / 100.0, np.full(100, 20.0))})
    found = slow_noise(recording)
    assert list(found) == ["tire_pressure_steer_left_pa"]
    (gauge,) = found.values()
    assert gauge.sigma == pytest.approx(0.005 * 760000.0)
    assert gauge.effective_rate_hz == pytest.approx(1.0)
