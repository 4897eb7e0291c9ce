"""What the driver does about a burst, and events that wait for a condition."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.simulation import load_scenario, simulate
from truck_blowout_sim.vehicle import Packed

MPH = 0.44704
Run = Callable[[str], Recording]
LANE = """\
title: left steer tire bursts, the driver keeps the lane
end_s: 9
start: {speed_mph: 50}
steering:
  follow: {x_m: [0, 1000], y_m: [0, 0]}
hold: {speed_mph: 50}
"""
BURST = "blowouts: {failure: {time_s: 2.0, tires: steer_left}}\n"
WAITING = "blowouts: {failure: {when: {%s}, tires: drive_1_left_outer}}\n"


@pytest.fixture
def run(truck: Packed, write: Callable[[str], Path]) -> Run:
    return lambda text: simulate(truck, load_scenario(write(LANE + text)))


def off_lane(recording: Recording) -> float:
    return float(np.abs(recording["tractor_y_m"].value).max())


def test_hands_and_feet_stay_until_the_driver_reacts(run: Run) -> None:
    driven = run(BURST + "reaction: {time_s: 1.0, throttle: lifted, brake_kpa: 400}\n")
    still = driven.between(2.0, 2.99)
    for name in ("steering_wheel_angle_rad", "throttle", "brake_pressure_drive_pa"):
        assert np.ptp(still[name].value[1:]) == 0.0
    assert still["throttle"].value[1] > 0.1
    assert np.ptp(driven.between(3.0, 4.0)["steering_wheel_angle_rad"].value) > 0.05


def test_the_later_the_reaction_the_farther_off_the_lane(run: Run) -> None:
    off = [off_lane(run(BURST + f"reaction: {{time_s: {t}}}\n")) for t in (0.3, 1.0, 1.5)]
    assert off == sorted(off)
    assert off[2] > 1.5 * off[0]
    assert off_lane(run(BURST)) < off[0]


def test_a_driver_who_never_reacts_holds_everything(run: Run) -> None:
    driven = run(BURST + "reaction: {time_s: .inf}\n").between(2.01, 9.0)
    assert np.ptp(driven["steering_wheel_angle_rad"].value) == 0.0
    assert np.ptp(driven["throttle"].value) == 0.0
    assert abs(driven["tractor_y_m"].value[-1]) > 3.66


def test_the_throttle_is_lifted_over_its_time(run: Run) -> None:
    driven = run(BURST + "reaction: {time_s: 0.5, throttle: lifted, throttle_over_s: 0.4}\n")
    before = driven["throttle"].value[210]
    assert driven["throttle"].value[270] == pytest.approx(0.5 * before, rel=0.06)
    assert not driven.between(2.95, 9.0)["throttle"].value.any()
    assert driven["tractor_vx_mps"].value[-1] < 48.0 * MPH


def test_panic_braking_rises_after_the_foot_has_moved(run: Run) -> None:
    driven = run(BURST + "reaction: {time_s: 0.5, throttle: lifted, brake_kpa: 500,"
                 " brake_delay_s: 0.2, brake_over_s: 0.4}\n")
    for circuit in ("steer", "drive", "trailer"):
        pressure = driven[f"brake_pressure_{circuit}_pa"].value
        assert not pressure[:270].any()
        assert pressure[290] == pytest.approx(2.5e5, rel=0.03)
        assert pressure[320] == pytest.approx(5e5)
    assert driven["tractor_vx_mps"].value[-1] < 0.6 * 50.0 * MPH


def test_the_hand_wheel_is_held_where_it_was(run: Run) -> None:
    driven = run(BURST + "reaction: {time_s: 0.5, steering: held}\n").between(2.01, 9.0)
    assert np.ptp(driven["steering_wheel_angle_rad"].value) == 0.0
    assert np.ptp(driven["throttle"].value) > 0.0


def test_speed_is_held_after_the_burst_without_a_hold_section(
    truck: Packed, write: Callable[[str], Path]
) -> None:
    text = LANE.replace("hold: {speed_mph: 50}\n",
                        "throttle: {time_s: [0.0], opening: [0.2]}\n").replace("end_s: 9",
                                                                              "end_s: 20")
    held = simulate(truck, load_scenario(write(
        text + BURST + "reaction: {time_s: 0.5, throttle: speed_held}\n")))
    free = simulate(truck, load_scenario(write(text + BURST)))
    at_burst = held["tractor_vx_mps"].value[200]
    assert abs(held["tractor_vx_mps"].value[-1] - at_burst) < 0.25
    assert abs(free["tractor_vx_mps"].value[-1] - at_burst) > 0.5


@pytest.mark.parametrize(("condition", "at_s"), [
    ("x_past_m: 67.056", 3.0),
    ("distance_m: 67.056", 3.0),
    ("speed_above_mph: 49, after_s: 4", 4.0),
])
def test_a_tire_bursts_when_its_condition_is_met(run: Run, condition: str, at_s: float) -> None:
    (burst,) = run(WAITING % condition).blowouts
    assert burst.tires == ("drive_1_left_outer",)
    assert burst.time_s == pytest.approx(at_s, abs=0.05)


def test_a_delay_follows_the_condition(run: Run) -> None:
    (burst,) = run("blowouts: {late: {when: {after_s: 4}, delay_s: 0.5, tires: steer_left}}\n"
                   ).blowouts
    assert burst.time_s == pytest.approx(4.5, abs=0.002)


def test_a_tire_that_burst_before_its_condition_was_met_is_told_once(run: Run) -> None:
    burst = run("blowouts:\n  early: {time_s: 1, tires: drive_1_left_outer}\n"
                "  hub: {when: {after_s: 4}, tires: drive_1_left}\n"
                "  again: {when: {after_s: 5}, tires: drive_1_left}\n").blowouts
    assert [event.tires for event in burst] == [("drive_1_left_outer",), ("drive_1_left_inner",)]


def test_yaw_rate_sets_an_event_off_and_the_driver_may_react_to_it(
    truck: Packed, write: Callable[[str], Path]
) -> None:
    driven = simulate(truck, load_scenario(write("""\
title: a turn whose yaw rate bursts a tire and makes the driver brake
end_s: 7
start: {speed_mph: 30}
steering:
  table: {time_s: [1.0, 3.0], angle_deg: [0, 90]}
hold: {speed_mph: 30}
reaction: {when: {yaw_rate_above_degps: 4}, time_s: 0.2, throttle: lifted, brake_psi: 30}
blowouts: {inner: {when: {yaw_rate_above_degps: 3}, tires: drive_1_left}}
""")))
    rate = np.degrees(driven["tractor_yaw_rate_radps"].value)
    times = driven["tractor_yaw_rate_radps"].time_s
    (burst,) = driven.blowouts
    assert burst.time_s == pytest.approx(times[np.argmax(rate > 3.0)], abs=0.011)
    braking = times[np.argmax(driven["brake_pressure_steer_pa"].value > 0.0)]
    assert braking == pytest.approx(times[np.argmax(rate > 4.0)] + 0.4, abs=0.05)


def test_what_never_happens_is_no_blowout(run: Run) -> None:
    assert run(WAITING % "speed_below_mph: 5").blowouts == ()


def test_a_speed_profile_is_held(truck: Packed, write: Callable[[str], Path]) -> None:
    text = LANE.replace("hold: {speed_mph: 50}",
                        "hold: {profile: {time_s: [1, 8], speed_mph: [50, 55]}}")
    driven = simulate(truck, load_scenario(write(text)))
    assert driven["tractor_vx_mps"].value[-1] == pytest.approx(54.5 * MPH, abs=1.0)


@pytest.mark.parametrize(("text", "line"), [
    ("blowouts: {a: {tires: steer_left}}\n", "says neither when nor at what time_s"),
    ("blowouts: {a: {time_s: 1, when: {after_s: 1}, tires: steer_left}}\n", "one of: time_s, when"),
    ("blowouts: {a: {when: {}, tires: steer_left}}\n", "asks for nothing"),
    ("reaction: {steering: helt}\n", "one of: as_before, held"),
    ("reaction: {time_s: -1}\n", "out of bounds"),
    ("reaction: {when: {speed_below_mph: x}}\n", "'x' is not a number"),
])
def test_a_wrong_event_or_reaction_is_one_line(
    refusal: Callable[[str], str], text: str, line: str
) -> None:
    assert line in refusal(LANE + text)


@pytest.mark.parametrize(("speed_mph", "said"), [(200, True), (10, False)])
def test_a_blowout_whose_condition_was_never_met_is_told(
    tmp_path: Path, truck: Packed, speed_mph: int, said: bool
) -> None:
    path = tmp_path / "waits.yaml"
    path.write_text("title: a burst that waits\nend_s: 1\nstart: {speed_mph: 40}\nhold: {}\n"
                    f"blowouts: {{failure: {{when: {{speed_above_mph: {speed_mph}}}, "
                    "tires: steer_left}}\n", encoding="utf-8")
    notes = simulate(truck, load_scenario(path)).notes
    assert ("blowout failure did not occur: its condition was not met in time" in notes) is said
