from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from truck_blowout_sim.physics import suspension
from truck_blowout_sim.physics.layout import AXLE_S, STATE_UNIT_AT, UNIT_S
from truck_blowout_sim.physics.rotation import euler_rates, fill_rotation, to_map
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]
Block = Callable[[str], int]
Slot = Callable[[str, str], int]
US = STATE_UNIT_AT


@pytest.mark.parametrize("axle", ["steer", "drive_2"])
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_rate_of_travel_is_the_derivative_of_travel(
        truck: Packed, state: Floats, work: Floats, block: Block, slot: Slot, axle: str,
        side: float) -> None:
    """Also for a rolled body in a turn, which pitches about its own axis without any travel."""
    random = np.random.default_rng(3)
    a, s = block(f"axle.{axle}"), slot("axle", axle)
    state[US + UNIT_S.yaw_rad:US + UNIT_S.roll_rad + 1] = 0.9, 0.02, 0.07
    state[US + UNIT_S.u_mps:US + UNIT_S.r_radps + 1] = (14.0, -0.3, 0.1, 0.05, 0.02, 0.25)
    state[s + AXLE_S.vz_mps], state[s + AXLE_S.roll_rate_radps] = random.normal(0.0, 0.2, 2)

    def travel() -> float:
        fill_rotation(state, US, work, 0)
        return suspension.travel_m(state, US, work, 0, truck.params, a, s, side, 0.0)

    before, h = travel(), 1e-6
    rate = suspension.travel_rate_mps(state, US, work, 0, truck.params, a, s, side)
    moved = to_map(work, 0, *state[US + UNIT_S.u_mps:US + UNIT_S.w_mps + 1])
    yaw, pitch, roll = euler_rates(state, US)
    state[US + UNIT_S.z_m] += h * moved[2]
    state[US + UNIT_S.yaw_rad] += h * yaw
    state[US + UNIT_S.pitch_rad] += h * pitch
    state[US + UNIT_S.roll_rad] += h * roll
    state[s + AXLE_S.z_m] += h * state[s + AXLE_S.vz_mps]
    state[s + AXLE_S.roll_rad] += h * state[s + AXLE_S.roll_rate_radps]
    assert (travel() - before) / h == pytest.approx(rate, abs=1e-5)


def test_spring_rate_preload_and_stops(truck: Packed, block: Block) -> None:
    p, a = truck.params, block("axle.steer")
    preload, rate = truck["axle.steer.preload_n"], truck["axle.steer.spring_npm"]
    jounce, stop = truck["axle.steer.jounce_m"], truck["axle.steer.stop_npm"]
    rebound = truck["axle.steer.rebound_m"]
    assert suspension.spring_force_n(p, a, 0.0) == pytest.approx(preload)
    assert suspension.spring_force_n(p, a, 0.02) == pytest.approx(preload + 0.02 * rate)
    assert suspension.spring_force_n(p, a, jounce + 0.01) == pytest.approx(
        preload + (jounce + 0.01) * rate + 0.01 * stop)
    assert suspension.spring_force_n(p, a, -rebound - 0.01) == pytest.approx(
        preload - (rebound + 0.01) * rate - 0.01 * stop)


def test_leaf_hysteresis_encloses_the_area_of_its_friction(truck: Packed, state: Floats,
                                                           block: Block, slot: Slot) -> None:
    """A wide cycle loses about 4 F A (1 - beta-share): Coulomb friction softened at the ends."""
    a, s = block("axle.trailer_1"), slot("axle", "trailer_1")
    friction = truck["axle.trailer_1.friction_n"]
    beta = truck["axle.trailer_1.friction_transition_m"]
    amplitude, n = 0.03, 4000
    times = np.linspace(0.0, 2.0, 2 * n + 1)
    travel = amplitude * np.sin(2.0 * np.pi * times)
    lost, dt = 0.0, times[1]
    for k in range(1, times.size):
        rate = (travel[k] - travel[k - 1]) / dt
        force = suspension.side_force_n(state, s, truck.params, a, 1.0, travel[k], rate, dt)
        elastic = suspension.spring_force_n(truck.params, a, travel[k])
        if times[k] > 1.0:
            lost += (force - elastic) * rate * dt
    expected = 4.0 * friction * (amplitude - beta)
    assert lost == pytest.approx(expected, rel=0.03)


def test_an_equaliser_shares_within_its_travel_and_no_further(truck: Packed, block: Block) -> None:
    p, a, reach = truck.params, block("axle.trailer_1"), truck["axle.trailer_1.equalizer_m"]
    assert suspension.equalised_m(p, a, 0.05, -0.01) == pytest.approx(0.02)
    assert suspension.equalised_m(p, a, 4.0 * reach, 0.0) == pytest.approx(3.0 * reach)
    # an axle without one keeps its own
    assert suspension.equalised_m(p, block("axle.drive_1"), 0.05, -0.01) == 0.05
