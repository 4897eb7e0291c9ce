from __future__ import annotations

import numpy as np
import pytest

from proving_ground.effects import LISTED, UNLISTED
from proving_ground.effects.base import EffectKind, combine
from proving_ground.manoeuvres import make
from proving_ground.run import Rig, Truth, drive, replay
from proving_ground.switches import NEVER_S, Switches, neutral

CANONICAL = {
    "blown_tire_drag", "blown_tire_cornering", "slow_deflation", "secondary_blowout",
    "steering_compliance", "steering_lash", "roll_steer", "tire_relaxation", "tire_saturation",
    "friction_change", "crosswind", "aerodynamic_drag", "road_grade", "road_bank",
    "driveline_drag", "brake_lag", "brake_imbalance", "brake_fade", "axle_misalignment",
    "payload_shift", "fifth_wheel_friction", "steering_lag", "steering_ratio"}
KINDS = {**LISTED, **UNLISTED}
SHOWING = {"blowout": "blowout_brake", "quick steer": "random_steer", "hard steer": "hard_double",
           "steer": "random_steer", "small steer": "random_steer", "kingpin": "blowout_brake",
           "limit": "hard_double", "brake": "braking_ramp", "coast": "coast_slow",
           "straight": "coast_slow", "any": "random_steer"}

TRAILER_CHAMBER = 66  # column of a sample
# column of a sample: typical size in a manoeuvre (speeds, rates, accelerations, pressures)
TYPICAL = {7: 1.0, 8: 0.1, 12: 0.02, 14: 0.3, 15: 0.3, 24: 0.1, 28: 0.02, 30: 0.3, 31: 0.3,
           43: 1.0e5, 60: 1.0e4, 62: 1.0e4}


def at_work(kind: EffectKind, severity: float, place: int = 0, sign: float = 1.0,
            when: float = 4.0) -> Switches:
    return combine([kind.set(severity, kind.places[place], sign, when)])


@pytest.fixture(scope="module")
def runs(rig: Rig) -> dict[str, Truth]:
    kinds = sorted(set(SHOWING.values()))
    return {kind: drive(rig, make(kind, 12), neutral(), 12) for kind in kinds}


def test_names_are_the_canonical_ones() -> None:
    assert set(LISTED) == CANONICAL
    assert not CANONICAL & set(UNLISTED)


@pytest.mark.parametrize("name", sorted(KINDS))
def test_effect_changes_the_truck_and_vanishes_with_its_severity(
        name: str, rig: Rig, runs: dict[str, Truth]) -> None:
    kind = KINDS[name]
    truth = runs[SHOWING[kind.needs]]
    when = 60.0 if name in ("friction_change", "road_grade", "road_bank") else 4.0
    off, plain = (replay(rig, truth, at_work(kind, severity, when=when)).samples
                  for severity in (1.0e-7, 0.5))
    shared = min(len(off), len(plain), len(truth.samples))

    def change(samples: np.ndarray) -> float:
        gap = samples[:shared, list(TYPICAL)] - truth.samples[:shared, list(TYPICAL)]
        return float(np.sqrt(np.mean((gap / np.array(list(TYPICAL.values()))) ** 2)))

    assert change(plain) > 1.0e-4
    assert change(off) < 0.2 * change(plain)


def test_every_place_of_every_effect_is_a_truck_part() -> None:
    for kind in KINDS.values():
        for place in kind.places:
            switches = combine([kind.set(0.5, place, 1.0, 4.0)])
            assert isinstance(switches, Switches)
            assert place.body in ("tractor", "trailer", None)


def test_two_effects_act_together() -> None:
    grade, wind = LISTED["road_grade"], LISTED["crosswind"]
    both = combine([grade.set(1.0, grade.places[0], 1.0, 100.0),
                    wind.set(1.0, wind.places[1], 1.0, 4.0)])
    assert both.grade == pytest.approx(0.03)
    assert both.gust_mps == pytest.approx(16.0)
    assert both.second_time_s == NEVER_S


def test_weak_left_brake_turns_the_truck_right(rig: Rig, runs: dict[str, Truth]) -> None:
    kind = LISTED["brake_imbalance"]
    place = [p.hub for p in kind.places].index("drive_1_left")
    truth = runs["braking_ramp"]
    weak = replay(rig, truth, at_work(kind, 0.8, place, -1.0)).samples
    assert weak[300:500, 12].mean() < truth.samples[300:500, 12].mean() - 1.0e-4


def test_uphill_slows_and_reads_on_the_accelerometer(rig: Rig, runs: dict[str, Truth]) -> None:
    truth = runs["coast_slow"]
    uphill = replay(rig, truth, at_work(LISTED["road_grade"], 1.0, when=20.0)).samples
    ends = [run[-1, 7] - run[-401, 7] for run in (uphill, truth.samples)]
    slowing = (ends[0] - ends[1]) / 4.0
    assert slowing == pytest.approx(-9.81 * 0.03, rel=0.1)
    assert uphill[-400:, 13].mean() == pytest.approx(truth.samples[-400:, 13].mean(), abs=0.03)


def test_gust_from_the_right_pushes_left(rig: Rig, runs: dict[str, Truth]) -> None:
    truth = runs["coast_slow"]
    blown = replay(rig, truth, at_work(LISTED["crosswind"], 1.0, 1)).samples
    assert blown[550, 1] > truth.samples[550, 1]


def test_roll_steer_of_a_rear_axle_is_into_the_turn(rig: Rig) -> None:
    kind = LISTED["roll_steer"]
    truth = drive(rig, make("hard_ramp", 2), neutral(), 2)
    place = [p.axle for p in kind.places].index("drive_1")
    more = replay(rig, truth, at_work(kind, 1.0, place)).samples
    assert abs(more[-100:, 12].mean()) < abs(truth.samples[-100:, 12].mean())


@pytest.mark.parametrize("severity", [0.2, 1.0])
def test_a_dead_time_of_the_brakes_is_as_long_as_the_answer_says(
        severity: float, rig: Rig, runs: dict[str, Truth]) -> None:
    """The line that holds the control pressures is long enough for the latest brakes."""
    kind, truth = LISTED["brake_lag"], runs["braking_ramp"]
    trailer = kind.others[0](severity, kind.places[2], 1.0, 4.0)
    late = replay(rig, truth, combine([trailer])).samples
    filled_s = [0.01 * int(np.argmax(samples[:, TRAILER_CHAMBER] > 1.0e5))
                for samples in (truth.samples, late)]
    assert filled_s[1] - filled_s[0] == pytest.approx(trailer.strength.value, abs=0.015)
