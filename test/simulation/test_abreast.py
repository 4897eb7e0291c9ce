"""Eight trucks abreast: each as it is alone, whatever its neighbors do. The step is compiled once
more for them, so all that needs it stands in this file."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from truck_blowout_sim.simulation import (
    InitialState,
    load_scenario,
    prepare,
    run_batch,
    simulate_batch,
)
from truck_blowout_sim.simulation import batch as batches
from truck_blowout_sim.simulation.abreast import execute_abreast, parts_of, settle_all
from truck_blowout_sim.simulation.drive import Drive, Ran, execute
from truck_blowout_sim.simulation.equilibrium import initial_vector
from truck_blowout_sim.simulation.studies import batch as studies
from truck_blowout_sim.vehicle import Packed, load_vehicle, pack

Floats = NDArray[np.float64]
TRUCK = "international_9400i_trailmobile"
STEP_S, STEPS = 0.001, 900


def turning(packed: Packed, lane: int, tires: tuple[str, ...], *, steps: int = STEPS,
            brake_pa: float = 0.0) -> Drive:
    """A turn of this lane's own, brakes after half of it, tires that burst one after the other."""
    inputs = np.zeros((steps, 5))
    inputs[50:, 0] = 0.3 + 0.2 * lane
    inputs[steps // 2:, 2:] = brake_pa
    blown = np.array([packed.names.tires.index(tire) for tire in tires], dtype=np.int64)
    at = np.array([100 + 40 * lane + 60 * k for k in range(len(tires))], dtype=np.int64)
    return Drive(InitialState(speed_mps=15.0 + 0.5 * lane), STEP_S, 10, inputs, np.zeros(0), at,
                 blown)


def alone(trucks: list[Packed], drives: list[Drive]) -> list[Ran]:
    return [execute(truck, drive) for truck, drive in zip(trucks, drives, strict=True)]


def assert_same(together: list[Ran], apart: list[Ran], within: float = 1e-8) -> None:
    """Outputs, inputs, bursts and endings are the same, numbers to rounding."""
    assert len(together) == len(apart)
    for one, other in zip(together, apart, strict=True):
        finite = np.isfinite(other.out)
        assert np.array_equal(np.isfinite(one.out), finite)
        scale = np.maximum(np.nanmax(np.abs(np.where(finite, other.out, 0.0)), axis=0), 1.0)
        assert np.nanmax(np.abs(one.out - other.out) / scale, initial=0.0) < within
        np.testing.assert_allclose(one.inputs, other.inputs, rtol=1e-7, atol=1e-7)
        assert one.blow_steps.tolist() == other.blow_steps.tolist()
        assert (one.ending is None) == (other.ending is None)
        if one.ending and other.ending:
            assert (one.ending.kind, one.ending.unit) == (other.ending.kind, other.ending.unit)
            assert one.ending.time_s == pytest.approx(other.ending.time_s, abs=1e-9)


@pytest.mark.parametrize(("vehicle", "tires", "values"), [
    (TRUCK, ("steer_left", "trailer_1_left_outer", "trailer_1_left_inner"),
     {"world.road_roughness_m": 0.002, "unit.trailer.gust_mps": 8.0,
      "unit.trailer.gust_start_s": 0.2, "abs.mode": 2.0}),
    (f"{TRUCK}_thesis", ("steer_left", "drive_1_right_outer"), {"abs.mode": 1.0}),
    ("ferrari_250lm", ("rear_left",), {"tire.front_left.saturation": 0.8}),
])
def test_every_kind_of_tire_and_brake(vehicle: str, tires: tuple[str, ...],
                                      values: dict[str, float]) -> None:
    """Parameters, turns and bursts differ from truck to truck; seven fill eight places."""
    packed = pack(load_vehicle(vehicle)).unchecked(values)
    trucks = [packed.with_values({"steering.ratio": packed["steering.ratio"] * (1.0 + 0.02 * k),
                                  "world.friction_scale": 1.0 - 0.06 * k}) for k in range(7)]
    drives = [turning(packed, k, tires, brake_pa=6e5) for k in range(7)]
    eights, single = parts_of(trucks, drives, [None] * 7)
    assert (eights, single) == ([list(range(7))], [])
    together = execute_abreast(trucks, drives)
    assert_same(together, alone(trucks, drives))
    last = together[-1].out[-1]
    assert not np.allclose(last, together[0].out[-1])


def test_wheels_that_spin_stand_or_roll_back() -> None:
    """On ice: some start at full throttle, one stands, one brakes in reverse, one is retarded."""
    packed = pack(load_vehicle(TRUCK))
    trucks = [packed.with_values({"world.friction_scale": 0.1 + 0.1 * k,
                                  "driveline.retarder_n": 6000.0 * k}) for k in range(7)]
    drives = []
    for k, speed in enumerate((0.0, 0.0, 0.3, -8.0, 1.0, 15.0, 15.0)):
        drive = turning(packed, k, (), brake_pa=4e5 if speed < 0.0 else 0.0)
        drive.inputs[:, 1] = 1.0 if 0.0 <= speed < 0.5 and k else 0.0
        drives.append(replace(drive, initial=InitialState(speed_mps=speed)))
    assert_same(execute_abreast(trucks, drives), alone(trucks, drives), 1e-6)


def test_events_on_step_edges_come_at_the_same_step() -> None:
    """0.3 s is rounded up as a number of a file and down as a sum of steps, or the reverse."""
    packed = pack(load_vehicle(TRUCK))
    trucks = [packed.with_values({
        "tire.trailer_1_left_outer.blow_time_s": 0.1 * k, "driveline.clutch_open_time_s": 0.1 * k,
        "world.friction_change_time_s": 0.1 * k, "world.friction_change_scale": 0.5})
        for k in range(1, 8)]
    drives = [replace(turning(packed, k, ()), initial=InitialState(speed_mps=15.0, time_s=-0.07))
              for k in range(7)]
    assert_same(execute_abreast(trucks, drives), alone(trucks, drives))


def test_a_truck_that_ends_leaves_the_others_alone(truck: Packed) -> None:
    """Not finite, rolled over, out of time: each at its instant."""
    drives = [turning(truck, k, ("steer_left",)) for k in range(6)]
    drives[1].inputs[300, 0] = np.nan
    drives[2] = turning(truck, 2, (), steps=400)
    fast = turning(truck, 4, (), steps=8000)
    fast.inputs[:, 0] = np.interp(np.arange(8000), [1000, 1500], [0.0, np.radians(270.0)])
    drives[4] = replace(fast, initial=InitialState(speed_mps=27.0))
    trucks = [truck] * 6
    apart = alone(trucks, drives)
    assert [each.ending is not None for each in apart] == [False, True, False, False, True, False]
    assert apart[4].ending is not None
    assert apart[4].ending.rolled_over
    assert_same(execute_abreast(trucks, drives), apart, 1e-6)


def test_drivers_and_conditions(truck: Packed, write: Callable[[str], Path]) -> None:
    """Every driver keeps his own counsel; bursts wait for what their own truck does."""
    text = """
title: Drivers
start: {{speed_mph: 50}}
end_s: 3.0
steering: {{follow: {{x_m: [0, 500], y_m: [0, {side}]}}}}
hold: {{until_s: 10.0}}
blowouts:
  failure: {{tires: steer_left, when: {{distance_m: {way}}}}}
reaction: {{time_s: {time}, steering: as_before, throttle: lifted, brake_kpa: 300}}
"""
    prepared = [prepare(truck, load_scenario(write(text.format(side=2 * k, way=5 + 3 * k,
                                                                time=0.2 + 0.1 * k))))
                for k in range(5)]
    trucks, drives = [each[0] for each in prepared], [each[1] for each in prepared]
    apart = alone(trucks, drives)
    assert len({int(each.blow_steps[0]) for each in apart}) == 5
    assert_same(execute_abreast(trucks, drives), apart)


def test_trucks_settle_abreast(truck: Packed) -> None:
    trucks = [truck.with_values({"unit.trailer.mass_kg": 8000.0 + 1000.0 * k}) for k in range(5)]
    drives = [turning(truck, k, ()) for k in range(5)]
    for packed, drive, start in zip(trucks, drives, settle_all(trucks, drives), strict=True):
        np.testing.assert_allclose(start, initial_vector(packed, drive.initial, STEP_S), rtol=1e-9,
                                   atol=1e-9)


def test_what_is_not_alike_goes_alone(truck: Packed) -> None:
    other = truck.unchecked({"abs.mode": 1.0 - truck["abs.mode"]})
    drives = [turning(truck, k, ()) for k in range(14)]
    trucks = [other if k in (3, 5) else truck for k in range(14)]
    drives[13] = replace(drives[13], every=5)
    eights, single = parts_of(trucks, drives, [None] * 14)
    assert eights == [[0, 1, 2, 4, 6, 7, 8, 9]]
    assert sorted(single) == [3, 5, 10, 11, 12, 13]


def test_a_large_batch_goes_abreast_in_order(truck: Packed, monkeypatch: pytest.MonkeyPatch
                                             ) -> None:
    monkeypatch.setattr(batches, "MANY", 10)
    drives = [turning(truck, k % 6, ("steer_left",), steps=300) for k in range(13)]
    together = run_batch([truck] * 13, drives, workers=2)
    for out, each in zip(together, alone([truck] * 13, drives), strict=True):
        np.testing.assert_allclose(out, each.out, rtol=1e-7, atol=1e-5)


def test_a_large_study_goes_abreast(write: Callable[[str], Path], monkeypatch: pytest.MonkeyPatch
                                    ) -> None:
    path = write("title: Short\nstart: {speed_mph: 40}\nend_s: 1.0\nhold: {}\n"
                 "blowouts: {failure: {time_s: 0.3, tires: steer_left}}\n")
    variants = [{"start.speed_mph": 40.0 + k, "steering.ratio": 20.0} for k in range(9)]
    variants.append({"start.speed_mph": -1.0, "steering.ratio": 20.0})
    apart = simulate_batch(TRUCK, path, variants, channels=["tractor_y_m"])
    monkeypatch.setattr(studies, "MANY", 10)
    together = simulate_batch(TRUCK, path, variants, channels=["tractor_y_m"])
    assert together.column("status") == ["ok"] * 9 + ["failed"]
    np.testing.assert_allclose(together.series("tractor_y_m"), apart.series("tractor_y_m"),
                               atol=1e-8)
    assert together.column("sideways_m")[:9] == pytest.approx(apart.column("sideways_m")[:9])
