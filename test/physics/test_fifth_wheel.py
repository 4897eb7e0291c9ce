from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from truck_blowout_sim.physics import fifth_wheel
from truck_blowout_sim.physics.layout import (
    GLOBAL_S,
    STATE_UNIT_AT,
    UNIT,
    UNIT_AT,
    UNIT_S,
    UNIT_SIZE,
    UNIT_W,
    UNIT_WORK_SIZE,
)
from truck_blowout_sim.physics.rotation import fill_rotation, to_map
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]
S0, S1 = STATE_UNIT_AT, STATE_UNIT_AT + len(UNIT_S)
A0, A1, W1 = UNIT_AT, UNIT_AT + UNIT_SIZE, UNIT_WORK_SIZE


def coupled(truck: Packed, state: Floats, work: Floats, seed: int, friction: float = 1.0) -> Floats:
    """Both units anyhow, kingpin near the plate; returns force and moment sums in map."""
    random = np.random.default_rng(seed)
    p = truck.params
    for s in (S0, S1):
        state[s + UNIT_S.yaw_rad:s + UNIT_S.roll_rad + 1] = random.normal(0.0, 0.05, 3)
        state[s + UNIT_S.u_mps:s + UNIT_S.r_radps + 1] = random.normal(0.0, 0.2, 6)
    fill_rotation(state, S0, work, 0)
    fill_rotation(state, S1, work, W1)
    q0 = to_map(work, 0, *p[A0 + UNIT.hitch_x_m:A0 + UNIT.hitch_z_m + 1])
    q1 = to_map(work, W1, *p[A1 + UNIT.hitch_x_m:A1 + UNIT.hitch_z_m + 1])
    state[S1 + UNIT_S.x_m:S1 + UNIT_S.z_m + 1] = np.array(q0) - q1
    work[UNIT_W.fx_n:UNIT_W.matrix] = 0.0
    work[W1 + UNIT_W.fx_n:W1 + UNIT_W.matrix] = 0.0
    fifth_wheel.add_coupling(state, S0, S1, p, A0, A1, work, 0, W1, 0.001)
    total = np.zeros(6)
    for s, w in ((S0, 0), (S1, W1)):
        force = np.array(to_map(work, w, *work[w + UNIT_W.fx_n:w + UNIT_W.fz_n + 1]))
        moment = np.array(to_map(work, w, *work[w + UNIT_W.mx_nm:w + UNIT_W.mz_nm + 1]))
        place = state[s + UNIT_S.x_m:s + UNIT_S.z_m + 1]
        total[:3] += force
        total[3:] += moment + np.cross(place, force)
    return total


@pytest.mark.parametrize("seed", range(5))
def test_action_is_reaction(truck: Packed, state: Floats, work: Floats, seed: int) -> None:
    """Forces and, with the kingpin on the plate and no friction, moments add up to nothing."""
    smooth = truck.with_values({"fifth_wheel.yaw_friction_nm": 0.0})
    total = coupled(smooth, state, work, seed)
    assert np.abs(total[:3]).max() < 1e-6
    assert np.abs(total[3:]).max() < 1e-5
    assert abs(state[GLOBAL_S.coupling_fz_n]) > 1e4


def test_yaw_and_pitch_are_free(truck: Packed, state: Floats, work: Floats) -> None:
    free = truck.with_values({"fifth_wheel.yaw_friction_nm": 0.0})
    for name in ("yaw_rad", "pitch_rad"):
        state[:] = 0.0
        state[S1 + getattr(UNIT_S, name)] = 0.3
        fill_rotation(state, S0, work, 0)
        fill_rotation(state, S1, work, W1)
        work[:UNIT_W.matrix] = np.where(np.arange(UNIT_W.matrix) >= UNIT_W.fx_n, 0.0,
                                        work[:UNIT_W.matrix])
        fifth_wheel.add_coupling(state, S0, S1, free.params, A0, A1, work, 0, W1, 0.001)
        assert state[GLOBAL_S.coupling_roll_nm] == pytest.approx(0.0, abs=1e-6)


def test_roll_is_stiff_then_lifts_through_the_lash_then_stiff_again(truck: Packed) -> None:
    p, load = truck.params, 60_000.0
    k = truck["fifth_wheel.roll_stiffness_nmprad"]
    lift = load * truck["fifth_wheel.plate_half_width_m"]
    lash = truck["fifth_wheel.roll_lash_rad"]
    small, edge = 0.2 * lift / k, lift / k
    assert fifth_wheel.roll_moment_nm(p, small, load) == pytest.approx(k * small)
    assert fifth_wheel.roll_moment_nm(p, edge + 0.5 * lash, load) == pytest.approx(lift)
    assert fifth_wheel.roll_moment_nm(p, edge + lash + 0.01, load) == pytest.approx(lift + k * 0.01)
    assert fifth_wheel.roll_moment_nm(p, -small, load) == pytest.approx(-k * small)
    assert not fifth_wheel.in_contact(p, edge + 0.5 * lash, load)


def test_friction_opposes_yaw_and_holds_its_size(truck: Packed, state: Floats, work: Floats
                                                 ) -> None:
    limit = truck["fifth_wheel.yaw_friction_nm"]
    state[S1 + UNIT_S.r_radps] = 0.2
    for _ in range(200):
        fill_rotation(state, S0, work, 0)
        fill_rotation(state, S1, work, W1)
        fifth_wheel.add_coupling(state, S0, S1, truck.params, A0, A1, work, 0, W1, 0.001)
    friction = state[GLOBAL_S.coupling_friction_nm]
    # on the tractor it acts along the trailer's relative turn
    assert friction == pytest.approx(limit, rel=0.06)
    before = friction
    state[S1 + UNIT_S.r_radps] = 0.0
    fifth_wheel.add_coupling(state, S0, S1, truck.params, A0, A1, work, 0, W1, 0.001)
    assert state[GLOBAL_S.coupling_friction_nm] == before
