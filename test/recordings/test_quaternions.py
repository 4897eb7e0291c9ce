"""Angles and quaternions against rotation matrices written out by hand."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from truck_blowout_sim.recordings.angles import angles, quaternion

TILT = st.floats(-1.5, 1.5)


@given(TILT, TILT, st.floats(-3.1, 3.1))
def test_round_trip_and_scipy_agree(roll: float, pitch: float, yaw: float) -> None:
    xyzw = quaternion(np.array(roll), np.array(pitch), np.array(yaw))
    peer = Rotation.from_euler("ZYX", [yaw, pitch, roll]).as_quat()
    np.testing.assert_allclose(np.abs(xyzw @ peer), 1.0, atol=1e-12)
    back = angles(xyzw)
    np.testing.assert_allclose([back["roll"], back["pitch"], back["yaw"]], [roll, pitch, yaw],
                               atol=1e-9)  # fmt: skip


def test_positive_pitch_is_nose_down_and_positive_roll_left_side_up() -> None:
    nose = Rotation.from_quat(quaternion(np.array(0.0), np.array(0.1), np.array(0.0)))
    assert nose.apply([1.0, 0.0, 0.0])[2] < 0
    left = Rotation.from_quat(quaternion(np.array(0.1), np.array(0.0), np.array(0.0)))
    assert left.apply([0.0, 1.0, 0.0])[2] > 0


def test_length_does_not_matter_but_zero_is_refused() -> None:
    xyzw = 3.0 * quaternion(np.array(0.1), np.array(0.2), np.array(0.3))
    assert angles(xyzw)["yaw"] == pytest.approx(0.3)
    with pytest.raises(ValueError, match="zero length"):
        angles(np.zeros(4))
