from __future__ import annotations

import numpy as np
import pytest
from trial_drive import make_run

from truck_blowout_sim.diagnosis.sensors.catalogue import candidates
from truck_blowout_sim.diagnosis.sensors.words import equation, next_test, sentence

CANDIDATES = candidates(set(make_run(1, 3.0).channels))
NAMES = {
    "yaw_rate_bias", "yaw_rate_scale", "lateral_accel_scale", "lateral_accel_roll", "speed_scale",
    "channel_delay", "lever_arm",
}  # fmt: skip


def test_every_canonical_sensor_fault_is_a_candidate_on_both_units() -> None:
    for unit in ("tractor", "trailer"):
        assert {c.name for c in CANDIDATES if c.unit == unit} == NAMES


@pytest.mark.parametrize("name", sorted({*NAMES, "steering_angle_offset"}))
def test_every_fault_has_an_equation_and_a_test(name: str) -> None:
    assert "=" in equation(name)
    assert len(next_test(name, [name])) > 20


def test_the_next_test_splits_the_pair_that_is_open() -> None:
    alone = next_test("lateral_accel_scale", ["lateral_accel_scale"])
    pair = next_test("lateral_accel_scale", ["lateral_accel_scale", "lateral_accel_roll"])
    assert pair != alone
    assert "slope" in pair


def test_sentences_show_units_a_person_reads() -> None:
    by_name = {c.name: c for c in CANDIDATES if c.unit == "tractor"}
    said = sentence(by_name["yaw_rate_bias"], (np.radians(0.2),), (np.radians(0.01),))
    assert "0.2 deg/s" in said
    assert "tractor yaw rate" in said
    late = sentence(by_name["channel_delay"], (0.05,), (0.001,))
    assert "50 ms" in late
    arm = sentence(by_name["lever_arm"], (0.5, 0.01), (0.05, 0.05), [0])
    assert "forward 0.5 m" in arm
    assert "left" not in arm


def test_no_two_candidates_are_the_same() -> None:
    assert len({(type(c), c.channels) for c in CANDIDATES}) == len(CANDIDATES)
