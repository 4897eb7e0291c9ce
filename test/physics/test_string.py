"""The string of a tire: how far it stays stretched, and how a truck comes to a stop on it."""

from __future__ import annotations

import numpy as np
import pytest

from truck_blowout_sim.physics.layout import STATE_UNIT_AT, UNIT_S
from truck_blowout_sim.physics.tires.string import kept_share, lag
from truck_blowout_sim.simulation import InitialState, Inputs, Truck
from truck_blowout_sim.vehicle import Packed

FULL_BRAKES = Inputs(0.0, 0.0, 8e5, 8e5, 8e5)
GRIP = 15.0  # slope over peak of a usual tire: the limit is a slip of 1/15


def test_the_lag_is_stable_at_any_speed_and_length() -> None:
    value = 0.0
    for _ in range(100):
        up, down = lag(value, 60.0, 60.0 * 0.1, 2e3, 2e6, 0.001)
        value = up / down
    assert value == pytest.approx(0.1)


def test_what_adhesion_holds_is_kept() -> None:
    assert kept_share(0.9 / GRIP, 0.0, GRIP, 5.0, 0.0, 0.0, 0.0) == 1.0
    assert kept_share(0.6 / GRIP, 0.7 / 5.0, GRIP, 5.0, 1.0, -3.0, 2.0) == 1.0


def test_sliding_sustains_the_slip_it_leads_to() -> None:
    """A locked wheel keeps the slip of -1, at any speed, and with it its friction."""
    for speed in (0.01, 1.0, 25.0):
        assert kept_share(-1.0, 0.0, GRIP, 5.0, -speed, 0.0, speed) == pytest.approx(1.0)


def test_what_no_motion_sustains_shrinks_to_the_adhesion_limit() -> None:
    assert kept_share(-1.0, 0.0, GRIP, 5.0, 0.0, 0.0, 0.0) * GRIP == pytest.approx(1.0)
    # nor does motion the other way
    assert kept_share(-1.0, 0.0, GRIP, 5.0, 0.5, 0.0, -0.5) * GRIP == pytest.approx(1.0)
    # a wheel that spins up again: 20 % of slip left
    assert kept_share(-0.6, 0.0, GRIP, 5.0, -0.2 * 7.0, 0.0, 7.0) * 0.6 == pytest.approx(0.2)


def stopped(truck: Packed, brakes: Inputs, speed: float) -> tuple[float, float, float]:
    """Rebound [m] and backward speed [m/s] of a stop, and the mean deceleration while sliding."""
    run, xs, vs = Truck(truck, initial=InitialState(speed_mps=speed)), [], []
    for _ in range(400):
        run.advance(brakes, 10)
        out = run.outputs()
        xs.append(out["tractor_x_m"])
        vs.append(out["tractor_vx_mps"])
    x, v = np.array(xs), np.array(vs)
    fast = (v > 0.1 * speed) & (v < 0.5 * speed)
    return float(x.max() - x[-1]), float(-v.min()), float(-np.gradient(v, 0.01)[fast].mean())


@pytest.mark.parametrize("mode", [0.0, 2.0])
def test_a_full_stop_rocks_back_by_a_centimeter_only(truck: Packed, mode: float) -> None:
    rebound, speed, _ = stopped(truck.with_values({"abs.mode": mode}), FULL_BRAKES, 8.0)
    assert rebound < 0.02
    assert speed < 0.2


def test_friction_of_locked_wheels_is_that_of_sliding(truck: Packed) -> None:
    """0.61 of the weight, far below the peak of 0.8, and no more as the truck comes to rest."""
    *_, deceleration = stopped(truck.with_values({"abs.mode": 0.0}), FULL_BRAKES, 8.0)
    assert deceleration == pytest.approx(0.61 * 9.81, rel=0.05)


def test_a_truck_that_slid_sideways_is_not_flung_back(truck: Packed) -> None:
    run, ys = Truck(truck), []
    for u in range(2):
        run.state[STATE_UNIT_AT + u * len(UNIT_S) + UNIT_S.v_mps] = 3.0
    for _ in range(600):
        run.advance(FULL_BRAKES, 10)
        ys.append(run.outputs()["tractor_y_m"])
    y = np.array(ys)
    # it leans and rocks on its springs, and stands where it stopped
    assert y.max() - y.min() == pytest.approx(y.max(), abs=0.05)
    assert y[-1] > 0.7 * y.max()
    assert np.ptp(y[-100:]) < 0.01


def test_a_truck_with_its_brakes_on_stands_on_a_slope(truck: Packed) -> None:
    slope = truck.with_values({"world.road_grade_rad": 0.03})
    run = Truck(slope, initial=InitialState(inputs=FULL_BRAKES))
    run.advance(FULL_BRAKES, 10_000)
    start = run.outputs()["tractor_x_m"]
    run.advance(FULL_BRAKES, 30_000)
    assert run.outputs()["tractor_x_m"] == pytest.approx(start, abs=1e-6)
