from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from truck_blowout_sim.physics.layout import STATE_UNIT_AT, UNIT_S, UNIT_W
from truck_blowout_sim.physics.probe import add_probe
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]
S = STATE_UNIT_AT
INTERVAL = {"unit.tractor.probe_start_s": 1.0, "unit.tractor.probe_end_s": 2.0,
            "unit.tractor.probe_ramp_s": 0.1}


def wrench(truck: Packed, state: Floats, work: Floats, at: int) -> Floats:
    work[:] = 0.0
    add_probe(state, S, truck.params, at, work, 0)
    return work[UNIT_W.fx_n:UNIT_W.mz_nm + 1].copy()


def test_it_acts_at_base_link_inside_its_interval(truck: Packed, state: Floats, work: Floats,
                                                  block: Callable[[str], int]) -> None:
    probed = truck.with_values(INTERVAL | {"unit.tractor.probe_fy_n": 1000.0,
                                           "unit.tractor.probe_mz_nm": 50.0})
    found = []
    for time in (0.5, 1.5, 2.5):
        state[0] = time
        found.append(wrench(probed, state, work, block("unit.tractor")))
    base_x = truck["unit.tractor.base_x_m"]
    assert found[0][1] == found[2][1] == 0.0
    assert found[1][1] == pytest.approx(1000.0)
    assert found[1][5] == pytest.approx(50.0 + base_x * 1000.0)


def test_its_impulse_is_force_times_duration(truck: Packed, state: Floats, work: Floats,
                                             block: Callable[[str], int]) -> None:
    probed = truck.with_values(INTERVAL | {"unit.tractor.probe_fx_n": -700.0})
    impulse = 0.0
    for k in range(3000):
        state[0] = 0.001 * k
        impulse += 0.001 * wrench(probed, state, work, block("unit.tractor"))[0]
    assert impulse == pytest.approx(-700.0, rel=2e-3)


@pytest.mark.parametrize(("key", "component", "per_unit"), [
    ("probe_fx_v_nspm", 0, 20.0), ("probe_fx_vv_ns2pm2", 0, 400.0), ("probe_fx_vr_kg", 0, 2.0),
    ("probe_fx_roll_nprad", 0, 0.05), ("probe_fy_v_nspm", 1, 20.0),
    ("probe_fy_vv_ns2pm2", 1, 400.0), ("probe_fy_vr_kg", 1, 2.0), ("probe_fy_roll_nprad", 1, 0.05),
    ("probe_mz_v_ns", 5, 20.0), ("probe_mz_vv_ns2pm", 5, 400.0), ("probe_mz_vr_kgm", 5, 2.0),
    ("probe_mz_roll_nmprad", 5, 0.05),
])  # fmt: skip
def test_its_laws_follow_the_motion(truck: Packed, state: Floats, work: Floats,
                                    block: Callable[[str], int], key: str, component: int,
                                    per_unit: float) -> None:
    law = truck.with_values({f"unit.tractor.{key}": -30.0})
    at = block("unit.tractor")
    state[S + UNIT_S.u_mps], state[S + UNIT_S.r_radps] = 20.0, 0.1
    state[S + UNIT_S.roll_rad] = 0.05
    assert wrench(law, state, work, at)[component] == pytest.approx(-30.0 * per_unit)
    assert np.abs(wrench(truck, state, work, at)).max() == 0.0
