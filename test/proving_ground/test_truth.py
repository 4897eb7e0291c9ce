"""The truth itself against the spec sheet's statics and the test's known responses."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from proving_ground import validate
from proving_ground.manoeuvres import MANOEUVRES, make
from proving_ground.run import Rig, drive, replay
from proving_ground.switches import neutral

LIMITS = {
    "steer axle load": (0.99 * 11925.0, 1.01 * 11925.0),
    "drive axle load": (0.99 * 20004.0, 1.01 * 20004.0),
    "trailer axle load": (0.99 * 20070.0, 1.01 * 20070.0),
    "yaw gain at 52.4 mph, per hand wheel / ratio": (2.35, 2.85),
    "apparent understeer at 52.4 mph": (2.5, 3.7),
    "tractor roll per g": (5.5, 7.5),
    "deceleration, trailer at 33 psi": (0.14, 0.19),
    "deceleration, all axles at 40 psi": (0.43, 0.52),
    "coast-down at 25 m/s": (0.19, 0.225),
    "peak yaw rate within 1.2 s": (1.8, 2.9),
    "time of that peak": (0.4, 1.2),
    "time to empty": (0.25, 0.55),
    "drop of the frame over the steer axle": (0.055, 0.08),
    "load on the flat": (22.0e3, 26.5e3),
}


@pytest.fixture(scope="module")
def measured() -> dict[str, float]:
    return {figure.name: figure.value for figure in validate.figures(None)}


@pytest.mark.parametrize("name", LIMITS)
def test_figure_lies_where_the_sheet_and_the_test_put_it(
        name: str, measured: dict[str, float]) -> None:
    low, high = LIMITS[name]
    assert low <= measured[name] <= high


def test_wheels_carry_the_weight(rig: Rig) -> None:
    samples = drive(rig, make("straight", 5), neutral(), 5).samples
    weight = float(rig.body.model.body_mass.sum()) * 9.81
    assert float(samples[200:, 72:90].sum(axis=1).mean()) == pytest.approx(weight, rel=2e-3)


def test_runs_repeat_bit_for_bit(rig: Rig) -> None:
    one, two = (drive(rig, make("lane_change", 9), neutral(), 9).samples for _ in range(2))
    assert np.array_equal(one, two)


def test_replayed_commands_reproduce_the_run(rig: Rig) -> None:
    truth = drive(rig, make("sine_sweep", 4), neutral(), 4)
    assert np.array_equal(replay(rig, truth, neutral()).samples, truth.samples)


def test_left_and_right_turns_mirror(rig: Rig) -> None:
    seeds = {}
    for seed in range(30):
        run = make("hard_ramp", seed)
        seeds[np.sign(run.program(10.0))] = run
    peaks = [abs(drive(rig, run, neutral(), 1).samples[-50:, 12]).mean() * run.speed_mps
             for run in seeds.values()]
    assert len(peaks) == 2
    assert peaks[0] == pytest.approx(peaks[1], rel=0.25)


def test_recording_ends_below_three_metres_a_second(rig: Rig) -> None:
    truth = drive(rig, make("braking_all", 3), neutral(), 3)
    assert truth.samples[-2, 7] >= 3.0
    assert truth.time_s[-1] < 12.0


@pytest.mark.parametrize("kind", sorted(MANOEUVRES))
def test_every_manoeuvre_keeps_the_wheels_down(kind: str, rig: Rig) -> None:
    task = make(kind, 7)
    task = replace(task, duration_s=min(task.duration_s, 40.0))
    samples = drive(rig, task, neutral(), 7).samples
    assert np.isfinite(samples).all()
    assert samples[:, 72:90].min() > 500.0
    assert np.abs(samples[:, 14]).max() < 5.0
