"""Blow-down of a tire against its closed forms."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray

from truck_blowout_sim.physics.layout import TIRE_S
from truck_blowout_sim.physics.tires.gas import (
    CHOKED,
    CRITICAL_RATIO,
    GAMMA,
    GAS_CONSTANT_JPKGK,
    advance_pressure,
    flow_function,
    leaks,
    pressure_rate_paps,
)
from truck_blowout_sim.vehicle import Packed

PSI = 6894.757293168361
AIR, TEMPERATURE = 101_325.0, 300.0
ROOT_RT = math.sqrt(GAS_CONSTANT_JPKGK * TEMPERATURE)
VOLUME, HOLE = 0.106, 25.9e-4
P0 = 110.0 * PSI + AIR


def blow_down(exponent: float, until_s: float, dt: float = 1e-5) -> float:
    """Absolute pressure after a time, midpoint rule."""
    p = P0
    for _ in range(round(until_s / dt)):
        half = p + 0.5 * dt * pressure_rate_paps(p, P0, AIR, TEMPERATURE, VOLUME, HOLE, exponent)
        p += dt * pressure_rate_paps(half, P0, AIR, TEMPERATURE, VOLUME, HOLE, exponent)
    return p


def test_constants_of_choked_flow() -> None:
    assert pytest.approx(0.6847, abs=1e-4) == CHOKED
    assert pytest.approx(0.5283, abs=1e-4) == CRITICAL_RATIO
    assert pytest.approx(293.5, abs=0.05) == ROOT_RT


def test_flow_is_continuous_where_it_stops_being_choked_and_ends_at_balance() -> None:
    assert flow_function(CRITICAL_RATIO + 1e-9) == pytest.approx(CHOKED, rel=1e-6)
    assert flow_function(1.0) == 0.0
    values = [flow_function(r) for r in np.linspace(CRITICAL_RATIO, 1.0, 50)]
    assert all(b < a for a, b in pairwise(values))


def test_choked_isothermal_is_an_exponential() -> None:
    k = CHOKED * HOLE * ROOT_RT / VOLUME
    assert blow_down(1.0, 0.15) == pytest.approx(P0 * math.exp(-k * 0.15), rel=1e-5)


def test_choked_adiabatic_is_a_power() -> None:
    k = CHOKED * HOLE * ROOT_RT / VOLUME
    g = GAMMA
    closed = P0 * (1.0 + (g - 1.0) / 2.0 * k * 0.12) ** (-2.0 * g / (g - 1.0))
    assert blow_down(g, 0.12) == pytest.approx(closed, rel=1e-5)


def test_end_of_choking_and_subsonic_tail_isothermal() -> None:
    k = CHOKED * HOLE * ROOT_RT / VOLUME
    k2 = 2.6458 * HOLE * ROOT_RT / VOLUME
    choked_s = math.log(0.5283 * P0 / AIR) / k
    assert blow_down(1.0, choked_s) == pytest.approx(AIR / 0.5283, rel=1e-3)

    def tail(tau: float) -> float:
        return tau + 2.0 / 3.0 * tau**3 + 0.2 * tau**5

    # t - t* = 7/k' (F(tau*) - F(tau)): time at which the pressure is 1.2 ambient
    y2 = 1.0 - (1.0 / 1.2) ** ((GAMMA - 1.0) / GAMMA)
    tau = math.sqrt(y2 / (1.0 - y2))
    assert tail(0.4472) == pytest.approx(0.5104, abs=1e-4)
    later_s = choked_s + 7.0 / k2 * (0.5104 - tail(tau))
    assert blow_down(1.0, later_s) == pytest.approx(1.2 * AIR, rel=2e-3)


@pytest.mark.parametrize(("exponent", "hole_cm2"), [(1.0, 25.9), (1.4, 21.9)])
def test_holes_that_empty_a_steer_tire_in_half_a_second(exponent: float, hole_cm2: float) -> None:
    p, t, dt = P0, 0.0, 1e-5
    while p > AIR * 1.0001 and t < 1.0:
        p += dt * pressure_rate_paps(p, P0, AIR, TEMPERATURE, VOLUME, hole_cm2 * 1e-4, exponent)
        t += dt
    assert t == pytest.approx(0.5, abs=0.015)


def test_gauge_pressure_of_a_half_second_blow_down() -> None:
    shares = [(blow_down(1.0, t) - AIR) / (P0 - AIR) for t in np.arange(0.05, 0.46, 0.05)]
    table = [0.75, 0.56, 0.41, 0.29, 0.20, 0.13, 0.07, 0.03, 0.01]
    assert shares == pytest.approx(table, abs=0.008)


def test_a_whole_tire_keeps_its_air_and_a_blown_one_loses_it_all(
        truck: Packed, state: NDArray[np.float64], slot: Callable[[str, str], int],
        block: Callable[[str], int]) -> None:
    s, t = slot("tire", "steer_left"), block("tire.steer_left")
    state[s + TIRE_S.pressure_pa] = truck["tire.steer_left.pressure_pa"]
    state[s + TIRE_S.blown_time_s] = np.inf
    assert not leaks(state, s, truck.params, t)
    state[s + TIRE_S.blown_time_s] = 0.0
    steps = 0
    while leaks(state, s, truck.params, t) and steps < 1000:
        advance_pressure(state, s, truck.params, t, 0.0, 0.001)
        steps += 1
    assert state[s + TIRE_S.pressure_pa] == 0.0


def test_a_tire_that_fails_by_itself_leaks_from_its_time_on(
        truck: Packed, state: NDArray[np.float64], slot: Callable[[str, str], int],
        block: Callable[[str], int]) -> None:
    s, t = slot("tire", "steer_left"), block("tire.steer_left")
    late = truck.with_values({"tire.steer_left.blow_time_s": 2.0}).params
    state[s + TIRE_S.pressure_pa], state[s + TIRE_S.blown_time_s] = 7e5, np.inf
    state[0] = 1.999
    assert not leaks(state, s, late, t)
    state[0] = 2.0
    assert leaks(state, s, late, t)
    assert state[s + TIRE_S.blown_time_s] == 2.0


def test_collapsing_volume_squeezes_the_gas(
        truck: Packed, state: NDArray[np.float64], slot: Callable[[str, str], int],
        block: Callable[[str], int]) -> None:
    """dp/dt = -p/V dV/dt for the isothermal gas: at an open hole the pressure first rises."""
    s, t = slot("tire", "steer_left"), block("tire.steer_left")
    name = "tire.steer_left."
    params = truck.unchecked({name + "hole_area_m2": 0.0, name + "polytropic": 1.0}).params
    before = 2e5
    state[s + TIRE_S.pressure_pa], state[s + TIRE_S.blown_time_s] = before, 0.0
    advance_pressure(state, s, params, t, 0.01, 0.001)
    loss = truck[name + "flat_volume_fraction"] * 0.01
    assert state[s + TIRE_S.pressure_pa] + AIR == pytest.approx((before + AIR) * (1.0 + loss),
                                                                rel=1e-4)


def test_a_hole_that_tears_open_lets_the_pressure_fall_with_the_square_of_time(
        truck: Packed, state: NDArray[np.float64], slot: Callable[[str, str], int],
        block: Callable[[str], int]) -> None:
    """Choked and isothermal, A(t) = A t / T: ln p/p0 = -k t^2 / 2 T until T, then -k (t - T/2)."""
    s, t = slot("tire", "steer_left"), block("tire.steer_left")
    name, opens_s, dt = "tire.steer_left.", 0.08, 1e-5
    values = truck.with_values({name + "hole_opening_s": opens_s, name + "polytropic": 1.0})
    air, warm = truck["world.air_pressure_pa"], truck["world.air_temperature_k"]
    k = CHOKED * truck[name + "hole_area_m2"] * math.sqrt(GAS_CONSTANT_JPKGK * warm) / (
        truck[name + "volume_m3"])
    full = truck[name + "pressure_pa"]
    state[s + TIRE_S.pressure_pa], state[s + TIRE_S.blown_time_s] = full, 0.0
    seen = []
    for step in range(round(0.12 / dt)):
        state[0] = step * dt
        advance_pressure(state, s, values.params, t, 0.0, dt)
        seen.append(math.log((state[s + TIRE_S.pressure_pa] + air) / (full + air)))
    half, later = seen[round(0.04 / dt) - 1], seen[-1]
    assert half == pytest.approx(-k * 0.04**2 / (2.0 * opens_s), rel=2e-3)
    assert later == pytest.approx(-k * (0.12 - 0.5 * opens_s), rel=2e-3)
