"""Player to simulator to bag, over DDS, equals the run without ROS."""

# ruff: noqa: ANN401 (fixtures and messages come from rclpy, which has no types for them)
from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from truck_blowout_sim import (
    Blowout,
    Inputs,
    Recording,
    Series,
    load_vehicle,
    read_recording,
    simulate_inputs,
    write_recording,
)
from truck_blowout_sim.simulation.start import initial_state

DURATION_S = 8.0
# Commands arrive within one publishing period of 10 ms and are held over it, offline they are
# linear between samples: half a period of a 0.5 rad, 0.5 Hz sine at the hand wheel.
BOUNDS = {
    "tractor_yaw_rate_radps": 2.0e-3,
    "trailer_yaw_rate_radps": 2.0e-3,
    "tractor_vx_mps": 0.03,
    "tractor_y_m": 0.10,
    "tire_pressure_steer_left_pa": 100e3,  # falls by 4.6 MPa/s: 20 ms
}

# The bag holds the very commands that were applied, and its first sample is the initial state.
SAME = {
    "tractor_yaw_rate_radps": 1e-8,
    "trailer_yaw_rate_radps": 1e-8,
    "tractor_vx_mps": 1e-8,
    "tractor_y_m": 1e-4,
    "tire_pressure_steer_left_pa": 1.0,
}


@pytest.fixture(scope="module")
def experiment(tmp_path_factory: pytest.TempPathFactory) -> Path:
    time_s = np.arange(0.0, DURATION_S + 0.005, 0.01)
    channels = {
        "steering_wheel_angle_rad": Series(time_s, 0.5 * np.sin(2 * np.pi * 0.5 * time_s)),
        "throttle": Series(time_s, np.where(time_s < 3.0, 0.3, 0.0)),
        "brake_pressure_steer_pa": Series(time_s, 0.0 * time_s),
        "brake_pressure_drive_pa": Series(time_s, 0.0 * time_s),
        "brake_pressure_trailer_pa": Series(time_s, np.where(time_s > 5.0, 200e3, 0.0)),
        "tractor_vx_mps": Series(time_s, np.full(time_s.size, 22.0)),
    }
    blowout = Blowout(3.0, ("steer_left",))
    return write_recording(
        Recording("experiment", channels, (blowout,)),
        tmp_path_factory.mktemp("experiment") / "bag",
    )


@pytest.fixture(scope="module")
def replayed(start: Any, experiment: Path, tmp_path_factory: pytest.TempPathFactory) -> Recording:
    bag = tmp_path_factory.mktemp("replayed") / "bag"
    # Slowly: a player that the machine holds up for a moment is late by less of simulated time.
    simulator = start("simulator", "--start-paused", "--real-time-factor", 0.4,
                      "--record-folder", bag.parent)  # fmt: skip
    simulator.wait_for("ready")
    follow = ("--ros-args", "-p", "use_sim_time:=true")
    player = start("player", experiment, "--record-path", bag, *follow)
    assert player.wait() == 0, player.output
    assert simulator.stop() == 0, simulator.output
    assert "steer_left blown" in simulator.output
    whole = read_recording(bag)
    return whole.shifted(-whole.start_s)


def worst_differences(one: Recording, other: Recording, end_s: float) -> dict[str, float]:
    """Largest difference of each bounded channel."""
    times_s = np.arange(0.0, end_s, 0.01)
    return {
        name: float(np.max(np.abs(one.at(name, times_s) - other.at(name, times_s))))
        for name in BOUNDS
    }


def test_replay_equals_the_run_without_ros(experiment: Path, replayed: Recording) -> None:
    recording = read_recording(experiment)
    initial = replace(initial_state(recording), inputs=Inputs())
    vehicle = load_vehicle("international_9400i_trailmobile")
    offline = simulate_inputs(vehicle, recording, initial=initial)
    worst = worst_differences(replayed, offline, DURATION_S - 0.1)
    assert {name: value for name, value in worst.items() if not value <= BOUNDS[name]} == {}


def test_the_tire_blows_within_two_periods_of_the_recorded_instant(replayed: Recording) -> None:
    (blowout,) = replayed.blowouts
    assert blowout.tires == ("steer_left",)
    assert 0.0 <= blowout.time_s - 3.0 <= 0.02


def test_the_bag_begins_and_ends_with_the_recording(replayed: Recording) -> None:
    assert replayed["tractor_vx_mps"].time_s[0] == 0.0
    assert replayed["tractor_vx_mps"].value.min() > 10.0  # no truck that still stands
    assert DURATION_S - 0.05 < replayed.duration_s < DURATION_S + 1.0


def test_the_bag_run_again_without_ros_is_the_same_run(replayed: Recording) -> None:
    vehicle = load_vehicle("international_9400i_trailmobile")
    initial = replace(initial_state(replayed), inputs=Inputs())
    again = simulate_inputs(vehicle, replayed, initial=initial)
    worst = worst_differences(replayed, again, replayed.duration_s - 0.1)
    assert {name: value for name, value in worst.items() if not value <= SAME[name]} == {}
