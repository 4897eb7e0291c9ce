from __future__ import annotations

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from truck_blowout_sim.physics.layout import STATE_UNIT_AT, UNIT_S
from truck_blowout_sim.physics.rotation import euler_rates, fill_rotation, to_body, to_map

Floats = NDArray[np.float64]
S = STATE_UNIT_AT
angle = st.floats(-1.2, 1.2)


def matrix(state: Floats, work: Floats) -> Floats:
    fill_rotation(state, S, work, 0)
    return work[:9].reshape(3, 3).copy()


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)
@given(yaw=st.floats(-10.0, 10.0), pitch=angle, roll=angle)
def test_rotation_is_orthonormal_and_inverts(state: Floats, work: Floats, yaw: float, pitch: float,
                                             roll: float) -> None:
    state[S + UNIT_S.yaw_rad:S + UNIT_S.roll_rad + 1] = yaw, pitch, roll
    m = matrix(state, work)
    assert m @ m.T == pytest.approx(np.eye(3), abs=1e-12)
    assert np.linalg.det(m) == pytest.approx(1.0)
    there = to_map(work, 0, 1.0, -2.0, 3.0)
    assert to_body(work, 0, *there) == pytest.approx((1.0, -2.0, 3.0))


def test_signs_of_the_angles(state: Floats, work: Floats) -> None:
    """Yaw turns x to the left, pitch lowers the nose, roll lifts the left side."""
    for name, point, expected in (("yaw_rad", (1, 0, 0), (0, 1, 0)),
                                  ("pitch_rad", (1, 0, 0), (0, 0, -1)),
                                  ("roll_rad", (0, 1, 0), (0, 0, 1))):
        state[:] = 0.0
        state[S + getattr(UNIT_S, name)] = 1e-3
        matrix(state, work)
        moved = np.array(to_map(work, 0, *point)) - point
        assert moved / 1e-3 == pytest.approx(expected, abs=1e-3)


def test_angle_rates_are_the_derivative_of_the_rotation(state: Floats, work: Floats) -> None:
    state[S + UNIT_S.yaw_rad:S + UNIT_S.roll_rad + 1] = 0.7, 0.2, -0.4
    omega = np.array([0.3, -0.5, 0.8])
    state[S + UNIT_S.p_radps:S + UNIT_S.r_radps + 1] = omega
    before = matrix(state, work)
    yaw, pitch, roll = euler_rates(state, S)
    h = 1e-6
    state[S + UNIT_S.yaw_rad] += h * yaw
    state[S + UNIT_S.pitch_rad] += h * pitch
    state[S + UNIT_S.roll_rad] += h * roll
    derivative = (matrix(state, work) - before) / h
    spin = np.array([[0, -omega[2], omega[1]], [omega[2], 0, -omega[0]], [-omega[1], omega[0], 0]])
    assert derivative == pytest.approx(before @ spin, abs=1e-5)
