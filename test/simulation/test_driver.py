"""Tables, sweeps, speed held with the throttle, a path followed."""

from __future__ import annotations

import numpy as np
import pytest

from truck_blowout_sim.simulation import load_scenario, simulate
from truck_blowout_sim.simulation.driver import steady_throttle, sweep
from truck_blowout_sim.simulation.scenario_schema import SweepSpec
from truck_blowout_sim.vehicle import Packed

MPH = 0.44704


def test_a_table_is_linear_between_its_points_and_held_outside(truck: Packed) -> None:
    wheel = np.degrees(simulate(truck, "trailer_step_steer")["steering_wheel_angle_rad"].value)
    assert wheel[150] == 0.0
    assert wheel[225] == pytest.approx(90.0)
    assert wheel[-1] == pytest.approx(180.0)


def test_a_sweep_rises_exponentially_from_one_frequency_to_the_other() -> None:
    spec = SweepSpec(amplitude_rad=0.5, start_hz=0.2, end_hz=1.6, start_s=1.0, end_s=31.0)
    times = np.linspace(0.0, 32.0, 320_001)
    wave = sweep(spec, times)
    assert np.abs(wave).max() == pytest.approx(0.5, rel=1e-6)
    assert not wave[times < 1.0].any()
    assert not wave[times > 31.0].any()
    rising = times[1:][(wave[:-1] < 0.0) & (wave[1:] >= 0.0)]
    halfway = np.searchsorted(rising, 16.0)
    period = rising[halfway] - rising[halfway - 1]
    assert 1.0 / period == pytest.approx(np.sqrt(0.2 * 1.6), rel=0.1)


def test_speed_is_held_in_a_turn_and_through_a_blowout(truck: Packed) -> None:
    speed = simulate(truck, "trailer_step_steer_right")["tractor_vx_mps"].value / MPH
    assert np.abs(speed - 31.0).max() < 1.2  # two flats drag more than the throttle was set for
    throttle = simulate(truck, "trailer_step_steer_right")["throttle"].value
    assert 0.0 <= throttle.min() < throttle.max() <= 1.0


def test_the_driver_starts_near_balance(truck: Packed) -> None:
    run = simulate(truck, "sine_sweep")
    assert np.abs(run["tractor_vx_mps"].between(0.0, 1.0).value / MPH - 50.0).max() < 0.1
    assert steady_throttle(truck, 22.35) == pytest.approx(run["throttle"].value[50], abs=0.03)


def test_the_throttle_takes_over_where_the_speed_is_no_longer_held(truck: Packed) -> None:
    from dataclasses import replace

    scenario = load_scenario("trailer_step_steer_no_blowout")
    assert scenario.spec.hold is not None
    shorter = replace(scenario, spec=replace(scenario.spec,
                                             hold=replace(scenario.spec.hold, until_s=4.0)))
    run = simulate(truck, shorter)
    assert run["throttle"].value[390] > 0.1
    assert not run["throttle"].between(4.1, 11.9).value.any()


def test_a_lane_change_follows_its_path(truck: Packed) -> None:
    from dataclasses import replace

    scenario = load_scenario("double_lane_change")
    run = simulate(truck, replace(scenario, spec=replace(scenario.spec, blowouts={})))
    x, y = run["tractor_x_m"].value, run["tractor_y_m"].value
    assert scenario.spec.steering is not None
    follow = scenario.spec.steering.follow
    assert follow is not None
    off = y - np.interp(x, follow.x_m, follow.y_m)
    assert np.abs(off).max() < 0.9
    assert y.max() == pytest.approx(3.5, abs=0.8)


def test_a_driver_keeps_the_lane_through_a_blowout(truck: Packed) -> None:
    run = simulate(truck, "hold_straight")
    assert np.abs(run["tractor_y_m"].value).max() < 1.0
    # he steers against the flat tire on the left
    held = run["steering_wheel_angle_rad"].between(20.0, 30.0).value.mean()
    assert -40.0 < np.degrees(held) < -8.0


def test_the_driver_drives_the_same_way_in_any_direction(truck: Packed) -> None:
    """The whole scene turned by 2 rad: the same hand wheel."""
    from dataclasses import replace

    scenario = load_scenario("double_lane_change")
    steering, start = scenario.spec.steering, scenario.spec.start
    assert steering is not None
    assert steering.follow is not None
    assert start is not None
    x, y = np.array(steering.follow.x_m), np.array(steering.follow.y_m)
    c, s = np.cos(2.0), np.sin(2.0)
    path = replace(steering.follow, x_m=tuple(c * x - s * y), y_m=tuple(s * x + c * y))
    turned = replace(scenario, spec=replace(
        scenario.spec, steering=replace(steering, follow=path), start=replace(start, yaw_rad=2.0)))
    wheels = [simulate(truck, s)["steering_wheel_angle_rad"].value for s in (scenario, turned)]
    assert np.abs(wheels[0] - wheels[1]).max() < 1e-5
