"""A new scenario is a YAML file; a wrong one is one clear line."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.simulation import load_scenario, scenario_names, simulate
from truck_blowout_sim.vehicle import Packed, load_vehicle

Refusal = Callable[[str], str]
COAST = """title: coasting
end_s: 2
start:
  speed_mph: 50
throttle:
  time_s: [0]
  opening: [0]
"""


@pytest.mark.parametrize("name", scenario_names())
def test_every_shipped_scenario_says_where_its_values_come_from(name: str) -> None:
    scenario = load_scenario(name)
    assert scenario.title
    numbers = [key for key, place in scenario.places.items()
               if key.rpartition("_")[2] in {"s", "mps", "rad", "pa", "m", "hz"} and "." in key]
    unsourced = [key for key in numbers if key not in scenario.sources]
    # a section that another shares by reference keeps its sources
    assert not unsourced


def test_what_the_project_promises_is_there() -> None:
    names = set(scenario_names())
    assert {"steer_axle_blowout", "double_lane_change", "fishhook", "coast_down", "brake_stop",
            "sine_sweep"} <= names
    for case in ("trailer_step_steer", "drive_step_steer"):
        assert {case, f"{case}_right", f"{case}_left_outer_dual", f"{case}_right_outer_dual",
                f"{case}_no_blowout"} <= names


def test_a_new_scenario_needs_no_code(truck: Packed, write: Callable[[str], Path]) -> None:
    path = write(COAST + "blowouts:\n  first: {time_s: 1, tires: steer_left+drive_1_right}\n")
    run = simulate(truck, path)
    assert run.name == "mine"
    assert run.blowouts[0].tires == ("steer_left", "drive_1_right_outer", "drive_1_right_inner")
    assert run.end_s == pytest.approx(2.0)
    assert run["tractor_vx_mps"].value[-1] < 50 * 0.44704


def test_a_scenario_extends_another(truck: Packed, write: Callable[[str], Path]) -> None:
    scenario = load_scenario(write("extends: fishhook\nstart:\n  speed_mph: 20\nblowouts:\n"))
    assert scenario.spec.start is not None
    assert scenario.spec.start.speed_mps == pytest.approx(20 * 0.44704)
    assert scenario.blowouts_of(truck.vehicle) == ()
    assert scenario.spec.steering is not None


def test_a_scenario_may_bring_road_and_parameters(truck: Packed, write: Callable[[str], Path]
                                                  ) -> None:
    level = simulate(truck, write(COAST))
    uphill = simulate(truck, write(COAST + "road: uphill_3_percent\n"))
    heavy = simulate(truck, write(COAST + "values:\n  unit.tractor.drag_area_m2: 40\n"))
    ends = [run["tractor_vx_mps"].value[-1] for run in (level, uphill, heavy)]
    assert ends[1] < ends[0] - 0.4
    assert ends[2] < ends[0] - 0.2


@pytest.fixture
def along_a_log(truck: Packed, write: Callable[[str], Path], tmp_path: Path
                ) -> Callable[[str], Recording]:
    """Runs a scenario of these lines on a log of 2 s, a turn that begins at 1 s, without throttle.
    """
    rows = "".join(f"{k / 10},{0.5 if k >= 10 else 0.0},20\n" for k in range(21))
    (tmp_path / "log.csv").write_text("time_s,steering_wheel_angle_rad,tractor_vx_mps\n" + rows)
    return lambda text: simulate(truck, write(f"title: a log\nrecording: log.csv\n{text}"))


def test_why_a_speed_is_imposed_is_told(along_a_log: Callable[[str], Recording]) -> None:
    run = along_a_log("end_s: 1\n")
    assert run.notes == ("speed imposed: throttle or brakes were not recorded",)
    assert along_a_log("end_s: 1\nhold: {speed_mps: 20}\n").notes == ()


@pytest.mark.parametrize(("span", "words"), [
    ("start_s: 100\nend_s: 103\n", "line 3: start_s: 100 s is outside log"),
    ("start_s: -3\nend_s: -1\n", "line 4: end_s: -1 s is outside log"),
])
def test_a_scenario_outside_its_log_is_refused(along_a_log: Callable[[str], Recording], span: str,
                                               words: str) -> None:
    with pytest.raises(InputError, match=rf"mine\.yaml, {words}; expected .* 0 s to 2 s$"):
        along_a_log(span)


def test_commands_held_before_and_after_a_log_are_told(along_a_log: Callable[[str], Recording]
                                                       ) -> None:
    run = along_a_log("start_s: -1\nend_s: 3\nhold: {speed_mps: 20}\n")
    assert run.notes == ("the log begins at 0 s; its first commands are held from -1 s on",
                         "the log ends at 2 s; its last commands are held until 3 s")
    wheel = run["steering_wheel_angle_rad"]
    assert wheel.time_s[int(np.argmax(wheel.value > 0.4))] == pytest.approx(1.0, abs=0.03)
    assert wheel.value[-1] == 0.5
    assert along_a_log("end_s: 2.05\nhold: {speed_mps: 20}\n").notes == ()


def test_blowouts_can_be_replaced(truck: Packed) -> None:
    from truck_blowout_sim.recordings import Blowout

    changed = load_scenario("fishhook").with_blowouts([Blowout(4.5, ("trailer_2_right",))])
    assert changed.blowouts_of(truck.vehicle)[0].tires == ("trailer_2_right_outer",
                                                           "trailer_2_right_inner")
    with pytest.raises(InputError, match="outside the run"):
        changed.with_blowouts([Blowout(99.0, ("steer_left",))])


@pytest.mark.parametrize("second", ["steer_left", "steer_right+steer_left"])
def test_a_tire_that_bursts_twice_is_refused(refusal: Refusal, second: str) -> None:
    line = refusal(COAST + "blowouts:\n  a: {time_s: 1, tires: steer_left}\n"
                   f"  b: {{time_s: 1.5, tires: {second}}}\n")
    assert line.endswith("line 10: blowouts.b.tires: steer_left bursts at 1 s and again at 1.5 s; "
                         "expected each tire at most once")


@pytest.mark.parametrize(("tires", "burst"), [
    ("steer_left+steer_left", ("steer_left",)),
    ("drive_1_left+drive_1_left_outer", ("drive_1_left_outer", "drive_1_left_inner")),
])
def test_a_tire_named_twice_in_one_event_counts_once(
    truck: Packed, write: Callable[[str], Path], tires: str, burst: tuple[str, ...]
) -> None:
    scenario = load_scenario(write(COAST + f"blowouts: {{a: {{time_s: 1, tires: {tires}}}}}\n"))
    assert scenario.blowouts_of(truck.vehicle)[0].tires == burst


@pytest.mark.parametrize(("change", "words"), [
    (("end_s: 2", "end_s: -1"), "end_s: -1 s is not after the start; expected more than 0 s"),
    (("end_s: 2", "end: 2"), "has no unit; expected end_s"),
    (("end_s: 2", "ends_s: 2"), "unknown key 'ends_s', did you mean 'end_s'?"),
    (("end_s: 2", "extend: coast_down"), "unknown key 'extend', did you mean 'extends'?"),
    (("speed_mph", "sped_mph"), "unknown key 'sped_mph', did you mean 'speed_mph'?"),
    (("speed_mph: 50", "speed_mph: fast"), "'fast' is not a number"),
    (("speed_mph: 50", "speed_kg: 50"), "not a unit of this quantity"),
    (("speed_mph: 50", "speed_mph: -3"), "out of bounds"),
    (("opening: [0]", "opening: [0, 1]"), "1 times and 2 openings; expected one value for each"),
    (("opening: [0]", "opening: [1.5]"), "throttle.opening: 1.5 is out of bounds"),
    (("time_s: [0]\n  opening: [0]", "time_s: [1, 1]\n  opening: [0, 0]"), "do not increase"),
    (("throttle:\n  time_s: [0]\n  opening: [0]\n", ""), "nothing works the throttle"),
    (("start:\n  speed_mph: 50\n", ""), "neither how the truck starts nor a recording"),
])
def test_wrong_files_say_what_where_and_what_was_expected(refusal: Refusal,
                                                          change: tuple[str, str], words: str
                                                          ) -> None:
    assert words in refusal(COAST.replace(*change))


@pytest.mark.parametrize(("addition", "words"), [
    ("blowouts:\n  a: {time_s: 1, tires: steer_lef}\n", "line 9: blowouts.a.tires: 'steer_lef' is "
     "no hub or tire of international_9400i_trailmobile, did you mean 'steer_left'?"),
    ("blowouts:\n  a: {time_s: 7, tires: steer_left}\n", "blowouts.a.time_s: blowout at 7 s"),
    ("road: moon\n", "road: no road of the name 'moon'"),
    ("values:\n  steering.ratioo: 3\n", "steering.ratioo"),
    ("steering: {}\n", "steering"),
    ("steering:\n  table: {time_s: [0], angle_deg: [1]}\n  sweep: {amplitude_deg: 1, start_hz: 1, "
     "end_hz: 2, end_s: 1}\n", "has table and sweep; expected one of"),
    ("steering:\n  follow: {x_m: [0], y_m: [0]}\n", "two points or more"),
    ("steering:\n  follow: {x_m: [0, 0], y_m: [0, 0]}\n", "the same point twice"),
    ("brakes:\n  steer: {time_s: [0], pressure_psi: [-5]}\n", "out of bounds"),
    ("brakes:\n  steer: {time_s: [0], pressure: [5]}\n", "has no unit"),
    ("recording: nowhere.csv\n", "recording: no recording of the name 'nowhere.csv'"),
])
def test_wrong_additions_are_refused(refusal: Refusal, addition: str, words: str) -> None:
    assert words in refusal(COAST + addition)


def test_an_unknown_name_lists_the_shipped_ones() -> None:
    with pytest.raises(InputError, match=r"fishok.*brake_stop, coast_down"):
        load_scenario("fishok")


def test_the_few_tires_of_a_car_are_listed() -> None:
    """`rear_left` resembles `steer_left` most, and is the wrong end."""
    with pytest.raises(InputError, match="expected one of front_left, front_right, rear_left, rea"):
        simulate(load_vehicle("bmw_320i"), "steer_axle_blowout")


def test_a_vehicle_without_these_tires_is_named(truck: Packed) -> None:
    with pytest.raises(InputError, match="no hub or tire of ferrari_250lm"):
        simulate(load_vehicle("ferrari_250lm"), "fishhook")


@pytest.mark.parametrize(("step_s", "rate_hz", "words"), [
    (0.0, 100.0, "step_s is 0.0"), (float("nan"), 100.0, "step_s is nan"),
    (0.1, 100.0, "step_s is 0.1"), (0.001, 0.0, "rate_hz is 0.0"),
    (0.001, 2000.0, "rate_hz is 2000.0; expected a rate over 0 and up to 1000 Hz"),
])
def test_impossible_rates_are_refused(
    truck: Packed, step_s: float, rate_hz: float, words: str
) -> None:
    with pytest.raises(InputError, match=words):
        simulate(truck, "coast_down", step_s=step_s, rate_hz=rate_hz)


def test_a_run_beyond_all_memory_is_refused(truck: Packed, tmp_path: Path) -> None:
    path = tmp_path / "long.yaml"
    path.write_text(COAST.replace("end_s: 2", "end_s: 1.0e+9"), encoding="utf-8")
    with pytest.raises(InputError, match=r"lasts 1e\+09 s; expected 86400 s at most with steps of"):
        simulate(truck, path)
