"""What ideal instruments read."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from truck_blowout_sim.physics.layout import STATE_UNIT_AT, UNIT, UNIT_AT, UNIT_S
from truck_blowout_sim.physics.observe import observe, output_names
from truck_blowout_sim.simulation import InitialState, Inputs, Truck
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]
S = STATE_UNIT_AT


def read(truck: Packed, state: Floats, work: Floats) -> dict[str, float]:
    names = output_names(*((truck.names.units, truck.names.hubs, truck.names.tires)))
    out = np.zeros(len(names))
    observe(state, truck.params, truck.topology, work, out)
    return dict(zip(names, out.tolist(), strict=True))


def test_at_rest_it_reads_gravity_upward(truck: Packed) -> None:
    run = Truck(truck)
    run.advance(Inputs(), 100)
    out = run.outputs()
    for unit in ("tractor", "trailer"):
        assert out[f"{unit}_az_mps2"] == pytest.approx(9.81, abs=2e-3)
        assert out[f"{unit}_ay_mps2"] == pytest.approx(0.0, abs=5e-3)


def test_gravity_enters_through_roll_and_pitch(truck: Packed, state: Floats, work: Floats) -> None:
    """Left side up: the accelerometer's left axis points up a little and reads positive."""
    roll = 0.05
    state[S + UNIT_S.roll_rad] = roll
    state[S + UNIT_S.gy_mps2] = -9.81 * math.sin(roll)
    state[S + UNIT_S.gz_mps2] = -9.81 * math.cos(roll)
    out = read(truck, state, work)
    assert out["tractor_ay_mps2"] == pytest.approx(9.81 * math.sin(roll))
    assert out["tractor_az_mps2"] == pytest.approx(9.81 * math.cos(roll))


def test_roll_and_pitch_are_against_the_true_horizontal(truck: Packed, state: Floats, work: Floats
                                                        ) -> None:
    """A truck that stands square on its road leans with the road."""
    banked = truck.with_values({"world.road_bank_rad": 0.03})
    assert read(banked, state, work)["trailer_roll_rad"] == pytest.approx(0.03)
    uphill = truck.with_values({"world.road_grade_rad": 0.02})
    assert read(uphill, state, work)["tractor_pitch_rad"] == pytest.approx(-0.02)
    state[S + UNIT_S.yaw_rad] = math.pi / 2.0  # across the slope: its left side is downhill
    turned = read(uphill, state, work)
    assert turned["tractor_roll_rad"] == pytest.approx(-0.02)
    assert turned["tractor_pitch_rad"] == pytest.approx(0.0, abs=1e-12)


def test_gyros_feel_a_slope_begin(truck: Packed) -> None:
    """Roll and pitch rates are the rates of roll and pitch, the road's part included."""
    slope = truck.with_values({
        "world.bank_change_rad": 0.04, "world.bank_change_time_s": 1.0,
        "world.grade_change_rad": 0.03, "world.grade_change_time_s": 1.5,
        "world.grade_change_ramp_s": 2.0, "world.bank_change_ramp_s": 2.0})
    run, rows = Truck(slope, initial=InitialState(speed_mps=20.0)), []
    for _ in range(400):
        run.advance(Inputs(), 10)
        out = run.outputs()
        rows.append([out[f"trailer_{name}"] for name in (
            "roll_rad", "roll_rate_radps", "pitch_rad", "pitch_rate_radps")])
    roll, roll_rate, pitch, pitch_rate = np.array(rows).T
    assert (roll[-1], pitch[-1]) == pytest.approx((0.04, -0.03), abs=0.003)
    dt = 10 * run.step_s
    for angle, rate in ((roll, roll_rate), (pitch, pitch_rate)):
        assert np.max(np.abs(rate)) > 0.02
        np.testing.assert_allclose(np.gradient(angle, dt), rate, atol=1e-3)


def test_steady_circle(truck: Packed, state: Floats, work: Floats) -> None:
    """Yaw rate and speed alone: centripetal at the instrument, velocity by the lever arm."""
    r, u = 0.2, 15.0
    bx, by, bz = truck.params[UNIT_AT + UNIT.base_x_m:UNIT_AT + UNIT.base_z_m + 1]
    state[S + UNIT_S.u_mps], state[S + UNIT_S.r_radps] = u, r
    state[S + UNIT_S.ay_mps2] = r * u
    out = read(truck, state, work)
    assert out["tractor_vx_mps"] == pytest.approx(u - r * by)
    assert out["tractor_vy_mps"] == pytest.approx(r * bx)
    assert out["tractor_ay_mps2"] == pytest.approx(r * u - r * r * by)
    assert out["tractor_ax_mps2"] == pytest.approx(-r * r * bx)
    assert out["tractor_z_m"] == pytest.approx(bz)


def test_turning_acceleration_acts_through_the_lever_arm(truck: Packed, state: Floats, work: Floats
                                                         ) -> None:
    bx = truck.params[UNIT_AT + UNIT.base_x_m]
    state[S + UNIT_S.rdot_radps2] = 0.7
    assert read(truck, state, work)["tractor_ay_mps2"] == pytest.approx(0.7 * bx)


def test_lateral_identity_over_a_maneuver(truck: Packed) -> None:
    """ay = d(vy)/dt + vx r + g sin(roll): no force can break it."""
    run = Truck(truck, initial=InitialState(speed_mps=20.0))
    rows = []
    for k in range(300):
        run.advance(Inputs(0.8 * math.sin(0.02 * k), 0.25), 10)
        rows.append(run.output_vector())
    table = dict(zip(run.output_names, np.array(rows).T, strict=True))
    rate = np.gradient(table["tractor_vy_mps"], 0.01)
    right = (rate + table["tractor_vx_mps"] * table["tractor_yaw_rate_radps"]
             + 9.81 * np.sin(table["tractor_roll_rad"]))
    assert np.abs(table["tractor_ay_mps2"] - right)[5:-5].max() < 0.02


def test_position_is_the_integral_of_velocity(truck: Packed) -> None:
    run = Truck(truck, initial=InitialState(speed_mps=15.0, yaw_rad=0.6))
    start = run.outputs()
    run.advance(Inputs(throttle=0.3), 1000)
    end = run.outputs()
    moved = math.hypot(end["tractor_x_m"] - start["tractor_x_m"],
                       end["tractor_y_m"] - start["tractor_y_m"])
    assert moved == pytest.approx(0.5 * (start["tractor_vx_mps"] + end["tractor_vx_mps"]), rel=1e-3)
    assert math.atan2(end["tractor_y_m"], end["tractor_x_m"]) == pytest.approx(0.6, abs=2e-3)
