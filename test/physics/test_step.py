"""The whole step: symmetry, repeatability, convergence, rest, and a run kept as it was."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

from truck_blowout_sim.physics.layout import N_WORK
from truck_blowout_sim.physics.step import advance, step
from truck_blowout_sim.simulation import InitialState, Inputs, Truck, simulate
from truck_blowout_sim.simulation.validation.soundness import symmetry_error
from truck_blowout_sim.vehicle import Packed, load_vehicle

sys.path.insert(0, str(Path(__file__).parent))

from golden_run import RUNS, repeated, stored_run


@pytest.mark.parametrize("name", RUNS)
def test_golden_run(name: str) -> None:
    """Driven from stored states and parameters: guards the arithmetic, not the vehicle files."""
    stored = stored_run(name)
    found, kept = repeated(name, stored), stored["result"]
    finite = np.isfinite(kept)
    assert np.array_equal(np.isfinite(found), finite)
    scale = np.maximum(np.abs(kept[finite]), 1.0)
    assert (np.abs(found[finite] - kept[finite]) / scale).max() < 1e-9


def test_left_and_right_are_mirror_images(truck: Packed, thesis: Packed) -> None:
    assert symmetry_error(truck) < 1e-9
    assert symmetry_error(thesis) < 1e-9


def test_repetition_gives_the_same_bits(truck: Packed) -> None:
    runs = [simulate(truck, "drive_step_steer_right") for _ in range(2)]
    assert all(runs[0][name] == runs[1][name] for name in runs[0].channels)


def test_reset_gives_the_same_bits(truck: Packed) -> None:
    run = Truck(truck, initial=InitialState(speed_mps=15.0))
    ends = []
    for _ in range(2):
        run.advance(Inputs(1.0, 0.3), 300)
        run.blow("steer_left")
        run.advance(Inputs(1.0, 0.3), 700)
        ends.append(run.state.copy())
        run.reset()
    assert np.array_equal(ends[0], ends[1], equal_nan=True)


def test_one_call_or_many_give_the_same_bits(truck: Packed) -> None:
    whole, parts = (Truck(truck, initial=InitialState(speed_mps=15.0)) for _ in range(2))
    inputs = np.array([1.0, 0.3, 0.0, 0.0, 0.0])
    advance(whole.state, truck.params, truck.topology, inputs, 0.001, 400, whole._work)
    for _ in range(400):
        advance(parts.state, truck.params, truck.topology, inputs, 0.001, 1, parts._work)
    assert np.array_equal(whole.state, parts.state, equal_nan=True)


@pytest.mark.parametrize("values", [
    {"tire.trailer_1_left_outer.blow_time_s": 1.3}, {"driveline.clutch_open_time_s": 1.3},
    {"world.friction_change_time_s": 1.3, "world.friction_change_scale": 0.2},
    {"unit.trailer.gust_start_s": 1.3, "unit.trailer.gust_mps": 20.0,
     "unit.trailer.gust_ramp_s": 0.0},
])  # fmt: skip
def test_events_come_at_their_step_however_time_is_summed(truck: Packed, values: dict[str, float]
                                                          ) -> None:
    """2000 steps at once, in parts, and with a start that rounds another way."""
    ends = []
    for at_s, steps in ((0.0, 1500), (0.0, 1), (-4.92, 100)):
        timed = {n: v + at_s if n.endswith(("time_s", "start_s")) else v
                 for n, v in values.items()}
        run = Truck(truck.with_values(timed), initial=InitialState(speed_mps=20.0, time_s=at_s))
        for _ in range(1500 // steps):
            run.advance(Inputs(1.0, 0.3), steps)
        ends.append(run.output_vector())
    assert ends[1] == pytest.approx(ends[0], rel=1e-6, abs=1e-6)
    assert ends[2] == pytest.approx(ends[0], rel=1e-6, abs=1e-6)


def test_the_step_alone_gives_the_same_bits(truck: Packed) -> None:
    whole, parts = (Truck(truck, initial=InitialState(speed_mps=15.0)) for _ in range(2))
    inputs = np.array([1.0, 0.3, 0.0, 0.0, 0.0])
    advance(whole.state, truck.params, truck.topology, inputs, 0.001, 400, whole._work)
    for _ in range(400):
        step(parts.state, truck.params, truck.topology, inputs, 0.001, parts._work)
    assert np.array_equal(whole.state, parts.state, equal_nan=True)


def test_half_the_step_changes_the_yaw_rate_by_less_than_a_fiftieth_of_a_degree(truck: Packed
                                                                                ) -> None:
    runs = [simulate(truck, "steer_axle_blowout", step_s=dt) for dt in (0.001, 0.0005)]
    rates = [np.degrees(run["tractor_yaw_rate_radps"].value) for run in runs]
    assert np.abs(rates[0] - rates[1]).max() < 0.02


def test_a_standing_truck_stands_for_a_minute(truck: Packed) -> None:
    run = Truck(truck)
    start = run.outputs()
    run.advance(Inputs(), 60_000)
    end = run.outputs()
    for unit in ("tractor", "trailer"):
        for axis in "xyz":
            assert end[f"{unit}_{axis}_m"] == pytest.approx(start[f"{unit}_{axis}_m"], abs=1e-3)
    for tire in run.vehicle.tires:
        assert end[f"tire_fz_{tire}_n"] == pytest.approx(start[f"tire_fz_{tire}_n"], abs=20.0)


def test_nothing_settles_at_the_start(truck: Packed) -> None:
    for speed in (0.0, 23.4):
        run = Truck(truck, initial=InitialState(speed_mps=speed))
        start = run.outputs()
        run.advance(Inputs(throttle=0.3 if speed else 0.0), 500)
        end = run.outputs()
        for unit in ("tractor", "trailer"):
            assert end[f"{unit}_z_m"] == pytest.approx(start[f"{unit}_z_m"], abs=5e-4)
            assert end[f"{unit}_pitch_rad"] == pytest.approx(start[f"{unit}_pitch_rad"], abs=1e-3)


def test_a_motion_that_is_not_finite_is_caught(truck: Packed) -> None:
    run = Truck(truck, initial=InitialState(speed_mps=15.0))
    poisoned = np.array(Inputs(throttle=float("nan")))
    advance(run.state, truck.params, truck.topology, poisoned, 0.001, 5, np.zeros(N_WORK))
    assert not run.finite


@pytest.mark.parametrize("step_s", [0.001, 0.002, 0.0025, 0.005])
@pytest.mark.parametrize("vehicle", ["international_9400i_trailmobile", "ferrari_250lm",
                                     "bmw_320i"])  # fmt: skip
def test_wheels_of_a_standing_vehicle_are_still(vehicle: str, step_s: float) -> None:
    """Without brakes, nudged, and at any step that is taken: no force swings, nothing turns."""
    run = Truck(load_vehicle(vehicle), step_s=step_s, initial=InitialState(speed_mps=0.02))
    run.advance(Inputs(), round(2.0 / step_s))
    forces, spins = [], []
    for _ in range(100):
        run.advance(Inputs())
        out = run.outputs()
        forces.append([out[f"tire_fx_{tire}_n"] for tire in run.vehicle.tires])
        spins.append([out[f"hub_speed_{hub}_radps"] for hub in run.vehicle.hubs])
    assert np.ptp(forces, axis=0).max() < 50.0
    assert np.ptp(spins, axis=0).max() < 0.02
