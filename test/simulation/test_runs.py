"""Scenarios run, batches, progress, replay of what was run."""

from __future__ import annotations

import math

import numpy as np
import pytest

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import (
    INPUT_NAMES,
    Recording,
    Series,
    channels_for,
    read_recording,
)
from truck_blowout_sim.resources import config_file
from truck_blowout_sim.simulation import (
    InitialState,
    Inputs,
    Truck,
    drive_from,
    load_scenario,
    prepare,
    run_batch,
    run_drive,
    scenario_names,
    simulate,
    simulate_inputs,
)
from truck_blowout_sim.simulation.summary import summarize
from truck_blowout_sim.vehicle import Packed, load_vehicle


@pytest.mark.parametrize("name", scenario_names())
def test_every_scenario_runs_to_its_end(truck: Packed, name: str) -> None:
    run = simulate(truck, name)
    scenario = load_scenario(name)
    assert run.notes == ()
    assert run.end_s == pytest.approx(scenario.spec.end_s)
    assert run.start_s == scenario.spec.start_s
    assert set(INPUT_NAMES) <= set(run.channels)
    standard = {c.name for c in channels_for() if c.standard}
    assert standard <= set(run.channels)
    assert np.abs(run["trailer_roll_rad"].value).max() < 0.2


def test_the_test_of_2013_is_driven_by_its_log(truck: Packed) -> None:
    run = simulate(truck, "steer_axle_blowout")
    log = read_recording(config_file("recordings", "test_2013_steer_blowout.csv"))
    assert (run.start_s, run.end_s) == (-4.92, pytest.approx(10.0))
    assert [(b.time_s, b.tires) for b in run.blowouts] == [(0.0, ("steer_left",))]
    times = run["throttle"].time_s[:-1]
    for name in INPUT_NAMES:
        assert run.at(name, times) == pytest.approx(log.at(name, times), abs=1e-6)
    assert run["tire_pressure_steer_left_pa"].value[-1] == 0.0


def test_progress_changes_no_bit_and_ends_at_one(truck: Packed) -> None:
    shares: list[float] = []
    told, silent = simulate(truck, "fishhook", progress=shares.append), simulate(truck, "fishhook")
    assert all(told[name] == silent[name] for name in silent.channels)
    assert shares == sorted(shares)
    assert shares[-1] == 1.0
    assert len(shares) == 10


def test_a_batch_of_drives(truck: Packed) -> None:
    packed, drive, _ = prepare(truck, load_scenario("double_lane_change"))
    alone = run_drive(packed, drive)
    many = run_batch([packed] * 3, drive, workers=3)
    assert all(np.array_equal(alone, out) for out in many)


def test_replaying_a_run_gives_the_run(truck: Packed) -> None:
    """A simulated recording drives the model to itself, but for its sampling of the inputs."""
    run = simulate(truck, "trailer_step_steer")
    again = simulate_inputs(truck, run, rate_hz=100.0)
    times = again["tractor_yaw_rate_radps"].time_s
    difference = again["tractor_yaw_rate_radps"].value - run.at("tractor_yaw_rate_radps", times)
    assert np.degrees(np.abs(difference).max()) < 0.05


def test_speed_is_imposed_where_the_throttle_was_not_recorded(truck: Packed) -> None:
    run = simulate(truck, "coast_down").between(0.0, 20.0)
    bare = run.without_channels(["throttle", "brake_pressure_trailer_pa"])
    drive = drive_from(bare, truck.vehicle)
    assert drive.speed_imposed
    again = simulate_inputs(truck, bare)
    assert "speed imposed: throttle or brakes were not recorded" in again.notes
    asked = simulate_inputs(truck, run.between(0.0, 0.5), impose_speed=True)
    assert asked.notes == ("speed imposed, as asked",)
    times = again["tractor_vx_mps"].time_s[100:]
    assert again.at("tractor_vx_mps", times) == pytest.approx(run.at("tractor_vx_mps", times),
                                                              abs=0.03)


def test_a_truck_in_hand_is_the_truck_in_a_scenario(truck: Packed) -> None:
    run = simulate(truck, "coast_down").between(0.0, 3.0)
    hand = Truck(truck, initial=InitialState(speed_mps=59 * 0.44704))
    hand.advance(Inputs(), 3000)
    speed = run["tractor_vx_mps"].value[-1]
    assert hand.outputs()["tractor_vx_mps"] == pytest.approx(speed, rel=1e-9)
    assert hand.time_s == pytest.approx(3.0)


def test_another_vehicle_needs_no_code() -> None:
    run = simulate(load_vehicle("ferrari_250lm"), "coast_down")
    assert "trailer_x_m" not in run
    assert run["tractor_vx_mps"].value[-1] < 20.0


@pytest.mark.parametrize(("name", "words"), [
    ("brake_stop", "50.0 mph to standstill in"),
    ("steer_axle_blowout", "steer_left blown at 0 s; 52.4 to 3"),
    ("trailer_step_steer", "trailer_1_left_outer+trailer_1_left_inner blown at 5 s"),
])
def test_the_summary_says_what_happened(truck: Packed, name: str, words: str) -> None:
    line = summarize(simulate(truck, name))
    assert words in line
    assert "\n" not in line
    assert "rolled over" not in line


def test_a_truck_that_stood_and_rolls_back_is_told() -> None:
    time_s = np.arange(5.0)
    values = {"tractor_vx_mps": [10.0, 0.0, -1.0, -2.0, -3.0], "tractor_x_m": [0.0, 5, 4.5, 3, 0.5],
              **dict.fromkeys(("tractor_vy_mps", "tractor_yaw_rate_radps", "tractor_y_m",
                               "tractor_yaw_rad"), [0.0] * 5)}
    run = Recording("run", {n: Series(time_s, np.array(v)) for n, v in values.items()})
    assert ("to standstill in 16 ft at 1.0 s, then rolling back, 6.7 mph at the end;"
            in summarize(run))


def test_a_truck_that_slides_sideways_does_not_stand() -> None:
    time_s = np.array([0.0, 1.0, 2.0])
    values = {"tractor_vx_mps": [20.0, 10.0, 0.0], "tractor_vy_mps": [0.0, 8.0, 10.0],
              "tractor_yaw_rate_radps": [0.0, 0.5, 0.5], "tractor_x_m": [0.0, 15.0, 25.0],
              "tractor_y_m": [0.0, 0.0, 0.0], "tractor_yaw_rad": [0.0, 0.5, 1.5],
              "articulation_rad": [0.0, -1.0, -2.0]}
    run = Recording("fold", {n: Series(time_s, np.array(v)) for n, v in values.items()})
    line = summarize(run, "si")
    assert line.startswith("20.0 to 10.0 m/s over 25 m;")
    assert "articulation passed 90 deg at 2.0 s" in line


def test_a_rollover_is_called_one(truck: Packed) -> None:
    from dataclasses import replace

    scenario = load_scenario("fishhook")
    assert scenario.spec.start is not None
    fast = replace(scenario, spec=replace(scenario.spec, start=replace(
        scenario.spec.start, speed_mps=30.0)), values={"steering.ratio": 6.0})
    assert "rolled over at" in summarize(simulate(truck, fast))


@pytest.mark.parametrize("step_s", [-0.001, 0.0, 0.05, float("nan"), float("inf")])
def test_a_truck_takes_no_step_that_is_none(truck: Packed, step_s: float) -> None:
    with pytest.raises(InputError, match=r"step_s is .*; expected a step .* up to 0\.005 s"):
        Truck(truck, step_s=step_s)
    with pytest.raises(InputError, match="step_s is"):
        simulate_inputs(truck, simulate(truck, "brake_stop").between(0.0, 1.0), step_s=step_s)


def test_time_does_not_run_backward(truck: Packed) -> None:
    run = Truck(truck)
    with pytest.raises(InputError, match="n_steps is -5; expected 0 steps or more"):
        run.advance(Inputs(), -5)
    run.advance(Inputs(), 0)
    assert run.time_s == 0.0
    with pytest.raises(InputError, match=r"n_steps is 1\.5; expected a whole number"):
        run.advance(Inputs(), 1.5)  # type: ignore[arg-type]


@pytest.mark.parametrize(("field", "value"), [
    ("steering_wheel_angle_rad", math.nan), ("steering_wheel_angle_rad", math.inf),
    ("throttle", math.nan), ("brake_pressure_steer_pa", math.nan),
    ("brake_pressure_drive_pa", -1e6), ("brake_pressure_trailer_pa", 1e9),
])
def test_inputs_that_are_none_are_refused(truck: Packed, field: str, value: float) -> None:
    run, bad = Truck(truck), Inputs(**{field: value})
    with pytest.raises(InputError, match=f"^{field} is {value:g}".replace("+", r"\+")
                       + "; expected .* to .*"):
        run.advance(bad)
    assert run.time_s == 0.0
    with pytest.raises(InputError, match=field):
        Truck(truck, initial=InitialState(inputs=bad))


@pytest.mark.parametrize(("bad", "line"), [
    ([0.0] * 5, r"^inputs are \[0.0, 0.0, 0.0, 0.0, 0.0\]; expected Inputs\(steering_wheel_angle"),
    ((0.0, 0.1), r"^inputs are \(0.0, 0.1\); expected Inputs\("),
    (None, "^inputs are None; expected Inputs"),
    (Inputs("a", 0, 0, 0, 0), "^steering_wheel_angle_rad is 'a'; expected a number, -"),  # type: ignore[arg-type]
    (Inputs(0, "0.5", 0, 0, 0), "^throttle is '0.5'; expected a number, "),  # type: ignore[arg-type]
    (Inputs(0, 0, 0, 0, None), "^brake_pressure_trailer_pa is None; "),  # type: ignore[arg-type]
])
def test_what_is_no_inputs_at_all_is_refused(truck: Packed, bad: Inputs, line: str) -> None:
    run = Truck(truck)
    with pytest.raises(InputError, match=line):
        run.advance(bad)
    assert run.time_s == 0.0


@pytest.mark.parametrize(("field", "value"), [
    ("speed_mps", math.nan), ("speed_mps", 500.0), ("speed_mps", 70.0), ("yaw_rad", math.inf),
    ("lateral_speed_mps", math.nan), ("x_m", math.nan), ("articulation_rad", 90.0),
    ("time_s", math.nan),
])
def test_a_start_that_is_none_is_refused(truck: Packed, field: str, value: float) -> None:
    with pytest.raises(InputError, match=f"^{field} is {value:g}; expected "):
        Truck(truck, initial=InitialState(**{field: value}))


def test_a_vehicle_may_be_given_by_its_name(truck: Packed) -> None:
    name = truck.vehicle.name
    assert Truck(name).outputs() == Truck(truck).outputs()
    by_name, packed = simulate(name, "brake_stop"), simulate(truck, "brake_stop")
    assert np.array_equal(by_name["tractor_x_m"].value, packed["tractor_x_m"].value)
    with pytest.raises(InputError, match="no_such_truck"):
        Truck("no_such_truck")


def test_a_truck_that_stands_has_no_negative_speed() -> None:
    time_s = np.linspace(0.0, 1.0, 11)
    names = ("tractor_vx_mps", "tractor_vy_mps", "tractor_x_m", "tractor_y_m", "tractor_yaw_rad",
             "tractor_yaw_rate_radps")
    values = dict.fromkeys(names, 0.0) | {"tractor_vx_mps": -0.001}
    run = Recording("stands", {n: Series(time_s, v + 0.0 * time_s) for n, v in values.items()})
    assert summarize(run).startswith("0.0 to 0.0 mph")
