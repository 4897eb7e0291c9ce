"""The state between inflated and flat: published tables, continuity, rim contact."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from truck_blowout_sim.physics.layout import TIRE, TIRE_S, TOPOLOGY
from truck_blowout_sim.physics.tires import blowout
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]
KMH = 1.0 / 3.6
TABLE_9 = [(0.0, 491, 980), (0.05, 471.9, 700), (0.10, 452.8, 500), (0.15, 433.7, 300),
           (0.20, 414.6, 300), (0.25, 395.5, 300), (0.30, 376.4, 3000), (0.35, 357.3, 10000),
           (0.40, 338.2, 50000), (0.45, 319.1, 90000), (0.50, 300, 98000)]
TABLE_10 = [(0.0041, 0.0000256), (0.01025, 0.000064), (0.0164, 0.0001024), (0.02255, 0.0001408),
            (0.0287, 0.0001792), (0.03485, 0.0002176), (0.041, 0.000256), (0.04715, 0.0002944),
            (0.0533, 0.0003228), (0.05945, 0.0003712), (0.0656, 0.0004096)]


def row(thesis: Packed, state: Floats, time_s: float) -> int:
    """Step-table row of the left steer tire a time after its blowout at 0."""
    s = int(thesis.topology[TOPOLOGY.state_tire_at])
    state[0], state[s + TIRE_S.blown_time_s] = time_s, 0.0
    table = int(thesis.topology[TOPOLOGY.table_at] + thesis["tire.steer_left.table"])
    return blowout.step_row(state, s, thesis.params, table)


@pytest.mark.parametrize("number", range(11))
def test_tables_9_and_10_to_the_digit(thesis: Packed, state: Floats, number: int) -> None:
    time_s, radius_mm, stiffness_npmm = TABLE_9[number]
    constant, per_kmh = TABLE_10[number]
    r = row(thesis, state, time_s)
    p = thesis.params
    t = min(i for n, i in thesis.index.items() if n.startswith("tire.steer_left."))
    assert p[r + 1] == pytest.approx(radius_mm / 1000, abs=1e-12)
    # the published radius is the one under the reference load, with the published rate
    load = p[t + TIRE.reference_load_n]
    free = blowout.free_radius_m(p, t, p[r + 1], p[r + 2])
    fz, more = (blowout.vertical_load(p, t, 0.0, height, 0.0, True, free, p[r + 2])[0]
                for height in (radius_mm / 1000, radius_mm / 1000 - 1e-6))
    assert fz == pytest.approx(load, rel=1e-9)
    assert (more - fz) / 1e-6 == pytest.approx(1000.0 * stiffness_npmm, rel=1e-6)
    assert p[r + 5] + p[r + 6] * 88.5 * KMH == pytest.approx(constant + per_kmh * 88.5, abs=1e-12)


def test_steps_change_at_their_instants_and_not_before(thesis: Packed, state: Floats) -> None:
    edges = [row(thesis, state, t - 1e-6) for t, _, _ in TABLE_9[1:]]
    after = [row(thesis, state, t) for t, _, _ in TABLE_9[1:]]
    assert all(b > a for a, b in zip(edges, after, strict=True))
    state[int(thesis.topology[TOPOLOGY.state_tire_at]) + TIRE_S.blown_time_s] = np.inf
    table = int(thesis.topology[TOPOLOGY.table_at] + thesis["tire.steer_left.table"])
    s = int(thesis.topology[TOPOLOGY.state_tire_at])
    assert blowout.step_row(state, s, thesis.params, table) == table + 1


def curve(truck: Packed, at: int, gauge_pa: float, heights: Floats) -> Floats:
    return np.array([blowout.vertical_load(truck.params, at, gauge_pa, h, 0.0, False, 0.0, 1.0)[0]
                     for h in heights])


def test_continuous_law_has_no_step_anywhere(truck: Packed, block: Callable[[str], int]) -> None:
    at = block("tire.steer_left")
    heights = np.linspace(0.51, 0.33, 20_000)
    move = heights[0] - heights[1]
    for gauge in (7.6e5, 3e5, 0.0):
        loads = curve(truck, at, gauge, heights)
        assert np.abs(np.diff(loads)).max() < 5e6 * move
        rims = np.array([blowout.rim_fraction(truck.params, at, h) for h in heights])
        radii = np.array([blowout.rolling_radius_m(truck.params, at, 0.506 - h, r)
                          for h, r in zip(heights, rims, strict=True)])
        assert np.abs(np.diff(radii)).max() < 2.0 * move
        lost = blowout.inflated(truck.params, at, gauge)[1]
        f = np.array([blowout.rolling_coefficient(truck.params, at, lost, 0.506 - h, r, 23.0, 1.0)
                      for h, r in zip(heights, rims, strict=True)])
        assert np.abs(np.diff(f)).max() < 10.0 * move


def test_stiffness_falls_with_pressure_and_rises_on_the_rim(truck: Packed,
                                                            block: Callable[[str], int]) -> None:
    """Not monotonic: 968 kN/m inflated, 84 flat, over 3,000 on the rim."""
    at = block("tire.steer_left")

    def stiffness(gauge: float, height: float) -> float:
        loads = curve(truck, at, gauge, np.array([height, height - 1e-5]))
        return float(loads[1] - loads[0]) / 1e-5

    inflated = stiffness(truck["tire.steer_left.pressure_pa"], 0.48)
    assert inflated == pytest.approx(968e3, rel=2e-3)
    assert stiffness(0.0, 0.42) == pytest.approx(83.7e3, rel=1e-3)
    assert stiffness(0.0, 0.34) > 3.0e6


def test_flat_tire_carries_a_steer_load_at_its_flat_radius(truck: Packed,
                                                            block: Callable[[str], int]) -> None:
    at = block("tire.steer_left")
    heights = np.linspace(0.36, 0.33, 3001)
    loads = curve(truck, at, 0.0, heights)
    assert np.interp(25_000.0, loads, heights) == pytest.approx(0.345, abs=0.002)
    assert blowout.rim_fraction(truck.params, at, 0.345) == 1.0


def test_a_tire_in_the_air_carries_nothing(truck: Packed, block: Callable[[str], int]) -> None:
    at = block("tire.steer_left")
    assert blowout.vertical_load(truck.params, at, 7e5, 0.6, 5.0, False, 0.0, 1.0)[0] == 0.0


def test_a_flat_tire_that_stops_short_of_the_rim_drags_as_much(truck: Packed,
                                                               block: Callable[[str], int]
                                                               ) -> None:
    """Both duals of a light hub stand at 0.372 to 0.376 m, the rim begins at 0.375 m."""
    at, flat = block("tire.trailer_1_left_outer"), truck["tire.trailer_1_left_outer.flat_rolling"]
    free = truck["tire.trailer_1_left_outer.unloaded_radius_m"]

    def drag(gauge_share: float, radius: float) -> float:
        rim = blowout.rim_fraction(truck.params, at, radius)
        gauge = gauge_share * truck["tire.trailer_1_left_outer.reference_pressure_pa"]
        lost = blowout.inflated(truck.params, at, gauge)[1]
        return float(blowout.rolling_coefficient(truck.params, at, lost, free - radius, rim, 20.0,
                                                 1.0))

    assert drag(0.0, 0.376) == pytest.approx(flat, rel=0.02)
    # halfway to the rim half of it and the usual rolling resistance; with its air none of it
    assert drag(0.0, 0.5 * (free + 0.375)) == pytest.approx(0.5 * flat, rel=0.15)
    assert drag(0.9, 0.47) < 0.01


def test_rolling_resistance_rises_as_a_tire_softens(truck: Packed, block: Callable[[str], int]
                                                    ) -> None:
    at, full = block("tire.steer_left"), truck["tire.steer_left.reference_pressure_pa"]
    assert blowout.softness(truck.params, at, 0.96 * full) == 1.0
    assert blowout.softness(truck.params, at, 0.5 * full) == pytest.approx(0.5**-0.4)
    assert blowout.softness(truck.params, at, 0.0) == pytest.approx(0.05**-0.4)
