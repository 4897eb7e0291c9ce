from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from truck_blowout_sim.physics.aero import add_air
from truck_blowout_sim.physics.layout import STATE_UNIT_AT, UNIT_S, UNIT_W
from truck_blowout_sim.physics.rotation import fill_rotation
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]
S = STATE_UNIT_AT


def wrench(truck: Packed, state: Floats, work: Floats, at: int) -> Floats:
    fill_rotation(state, S, work, 0)
    work[UNIT_W.fx_n:UNIT_W.mz_nm + 1] = 0.0
    add_air(state, S, truck.params, at, work, 0)
    return work[UNIT_W.fx_n:UNIT_W.mz_nm + 1].copy()


def test_drag_grows_with_the_square_of_speed(truck: Packed, state: Floats, work: Floats,
                                             block: Callable[[str], int]) -> None:
    at = block("unit.tractor")
    state[S + UNIT_S.u_mps] = 23.4
    area, density = truck["unit.tractor.drag_area_m2"], truck["world.air_density_kgpm3"]
    found = wrench(truck, state, work, at)
    assert found[0] == pytest.approx(-0.5 * density * area * 23.4**2)
    assert found[4] == pytest.approx(found[0] * truck["unit.tractor.drag_z_m"])


def test_the_whole_truck_has_the_drag_of_its_budget(truck: Packed) -> None:
    """1.8 kN at 52.3 mph."""
    area = truck["unit.tractor.drag_area_m2"] + truck["unit.trailer.drag_area_m2"]
    assert 0.5 * 1.18 * area * (52.3 * 0.44704) ** 2 == pytest.approx(1800.0, rel=0.02)


def test_a_head_wind_counts_as_speed_and_follows_the_heading(truck: Packed, state: Floats,
                                                             work: Floats,
                                                             block: Callable[[str], int]) -> None:
    at = block("unit.tractor")
    state[S + UNIT_S.u_mps] = 30.0
    still = wrench(truck, state, work, at)
    state[S + UNIT_S.u_mps], state[S + UNIT_S.yaw_rad] = 20.0, 0.5 * np.pi
    windy = truck.with_values({"world.wind_y_mps": -10.0})
    assert wrench(windy, state, work, at)[0] == pytest.approx(still[0])


def test_a_gust_pushes_at_the_side_areas_middle_while_it_blows(
        truck: Packed, state: Floats, work: Floats, block: Callable[[str], int]) -> None:
    values = {"unit.trailer.gust_mps": 12.0, "unit.trailer.gust_start_s": 1.0,
              "unit.trailer.gust_end_s": 3.0, "unit.trailer.gust_ramp_s": 0.2}
    gusty, at = truck.with_values(values), block("unit.trailer")
    state[S + UNIT_S.u_mps] = 20.0
    assert wrench(gusty, state, work, at)[1] == 0.0
    state[0] = 2.0
    found = wrench(gusty, state, work, at)
    side = truck["unit.trailer.side_area_m2"]
    assert found[1] == pytest.approx(0.5 * 1.18 * side * np.hypot(20.0, 12.0) * 12.0)
    assert found[5] / found[1] == pytest.approx(truck["unit.trailer.side_x_m"])
    ahead = gusty.with_values({"unit.trailer.gust_ahead_m": 1.5})
    moved = wrench(ahead, state, work, at)
    assert moved[:5] == pytest.approx(found[:5])
    assert moved[5] - found[5] == pytest.approx(1.5 * found[1])
    raised = wrench(gusty.with_values({"unit.trailer.gust_up_m": 0.4}), state, work, at)
    assert raised[:3] == pytest.approx(found[:3])
    assert raised[3] - found[3] == pytest.approx(-0.4 * found[1])
    pushed_back = wrench(gusty.with_values({"unit.trailer.gust_drag_share": 0.2}), state, work, at)
    assert pushed_back[0] - found[0] == pytest.approx(-0.2 * found[1])
    state[0] = 3.3
    assert wrench(gusty, state, work, at)[1] == 0.0
    np.testing.assert_array_equal(wrench(ahead, state, work, at), wrench(truck, state, work, at))
