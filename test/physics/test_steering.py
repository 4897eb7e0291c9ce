from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from truck_blowout_sim.physics import steering
from truck_blowout_sim.physics.layout import GLOBAL_S
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]
UPRIGHT = {"steering.caster_rad": 0.0}


def moment_nm(p: Floats, *rest: object) -> float:
    return steering.kingpin_moment_nm(p, steering.kingpin_axis(p), *rest)


def lever_mm(truck: Packed, radius_m: float, braked: bool) -> float:
    """Kingpin moment per longitudinal force of the left wheel, along the tilted kingpin."""
    p = truck.with_values(UPRIGHT).params
    brake = 1000.0 * radius_m if braked else 0.0
    moment = moment_nm(p, 1.0, 0.0, 0.0, radius_m, (-1000.0, 0.0, 0.0), 0.0, brake,
                                        0.0)
    tilt = math.cos(truck["steering.kingpin_inclination_rad"])
    return moment / tilt


def test_a_locked_wheel_pulls_at_the_ground_offset(truck: Packed) -> None:
    assert lever_mm(truck, 0.478, braked=True) == pytest.approx(63.0, abs=1.0)
    assert lever_mm(truck, 0.345, braked=True) == pytest.approx(77.0, abs=1.0)


def test_a_free_wheel_pulls_at_the_spindle_offset(truck: Packed) -> None:
    assert lever_mm(truck, 0.478, braked=False) == pytest.approx(115.0, abs=0.1)


def test_drag_of_the_left_wheel_steers_left_and_of_the_right_one_right(truck: Packed) -> None:
    left, right = (moment_nm(truck.params, side, 0.0, 0.0, 0.47,
                                              (-1000.0, 0.0, 0.0), 0.0, 0.0, 0.0)
                   for side in (1.0, -1.0))
    assert left > 0.0
    assert right == pytest.approx(-left)


def test_loads_balance_until_the_axle_tilts(truck: Packed) -> None:
    def both(roll: float) -> float:
        return sum(moment_nm(truck.params, side, roll, 0.0, 0.478,
                                              (0.0, 0.0, 26_000.0), 0.0, 0.0, 0.0)
                   for side in (1.0, -1.0))

    assert both(0.0) == pytest.approx(0.0, abs=1e-9)
    # left corner down: the weight pulls to the left
    assert both(math.radians(-3.7)) > 50.0


def test_lateral_force_behind_the_kingpin_turns_back(truck: Packed) -> None:
    moment = moment_nm(truck.params, 1.0, 0.0, 0.0, 0.478, (0.0, 5000.0, 0.0),
                                        0.0, 0.0, 0.0)
    trail = 0.478 * math.tan(truck["steering.caster_rad"])
    assert moment == pytest.approx(-5000.0 * trail, rel=0.02)


def settle(truck: Packed, state: Floats, hand_wheel: float, moment: float, seconds: float = 6.0
           ) -> float:
    for _ in range(round(1000 * seconds)):
        steering.advance_steering(state, truck.params, hand_wheel, moment, 0.001)
    return float(state[GLOBAL_S.steer_rad])


PLAIN = {"steering.lash_rad": 0.0, "steering.friction_nm": 0.0}


def test_static_compliance(truck: Packed, state: Floats) -> None:
    """0.0008 deg a newton meter."""
    angle = settle(truck.with_values(PLAIN), state, 0.0, 1000.0)
    assert math.degrees(angle) == pytest.approx(1000.0 / 1243.0, rel=1e-4)


def test_lash_is_a_dead_zone_of_its_width(truck: Packed, state: Floats) -> None:
    loose = truck.with_values(PLAIN | {"steering.lash_rad": math.radians(6.0)})
    play = math.radians(3.0) / truck["steering.ratio"]
    assert settle(loose, state, 0.0, 1000.0) == pytest.approx(
        play + math.radians(1000.0 / 1243.0), rel=1e-4)
    assert settle(loose, state, 0.0, -1000.0) == pytest.approx(
        -play - math.radians(1000.0 / 1243.0), rel=1e-4)


def test_friction_keeps_a_small_moment_from_steering_far(truck: Packed, state: Floats) -> None:
    tight = truck.with_values({"steering.lash_rad": 0.0})
    free = settle(truck.with_values(PLAIN), state.copy(), 0.0, 60.0, 20.0)
    held = settle(tight, state, 0.0, 60.0, 20.0)
    assert 0.0 < held < free


def test_rigid_steering_follows_the_hand_wheel_exactly(thesis: Packed, state: Floats) -> None:
    angle = settle(thesis, state, 1.0, 5000.0, 0.001)
    assert angle == 1.0 / 25.0


def test_the_inner_wheel_turns_more(truck: Packed, state: Floats) -> None:
    state[GLOBAL_S.steer_rad] = 0.1
    half = truck["axle.steer.half_track_m"]
    left, right = (steering.wheel_angle_rad(state, truck.params, side, half)
                   for side in (1.0, -1.0))
    wheelbase = truck["steering.wheelbase_m"]
    # both wheels point at one center: cot right - cot left = track / wheelbase
    assert 1.0 / math.tan(right) - 1.0 / math.tan(left) == pytest.approx(2.0 * half / wheelbase,
                                                                         rel=0.02)


def test_a_lag_is_neutral_at_zero_and_of_first_order(thesis: Packed, state: Floats) -> None:
    late = thesis.with_values({"steering.lag_s": 0.2})
    reached = settle(late, state, 1.0, 0.0, 0.2) * 25.0
    assert reached == pytest.approx(1.0 - math.exp(-1.0), abs=0.003)
    assert settle(late, state, 1.0, 0.0, 3.0) == pytest.approx(1.0 / 25.0, rel=1e-6)


def test_a_bent_ratio_turns_further_at_large_angles_only(thesis: Packed) -> None:
    bent = thesis.with_values({"steering.ratio_curve_prad2": 2.0}).params
    small, large = (steering.commanded_rad(bent, wheel) * 25.0 / wheel for wheel in (0.25, 5.0))
    assert small == pytest.approx(1.0, abs=3e-4)
    assert large == pytest.approx(1.0 + 2.0 * 0.2**2)
    assert steering.commanded_rad(bent, -5.0) == -steering.commanded_rad(bent, 5.0)


@pytest.mark.parametrize("compliant", [0.0, 1.0])
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_the_road_wheels_stand_at_one_stop(truck: Packed, state: Floats, compliant: float,
                                           side: float) -> None:
    """However far the hand wheel goes; no rate is kept there, and they leave it at once."""
    p = truck.with_values({"steering.compliance_on": compliant}).params
    for _ in range(3000):
        steering.advance_steering(state, p, side * 50.0, side * 1e5, 0.001)
    assert state[GLOBAL_S.steer_rad] == pytest.approx(side * 0.9)
    assert state[GLOBAL_S.steer_rate_radps] == 0.0
    for _ in range(20):
        steering.advance_steering(state, p, 0.0, 0.0, 0.001)
    assert side * state[GLOBAL_S.steer_rad] < 0.9
