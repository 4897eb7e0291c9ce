"""Roll, pitch, yaw (intrinsic z-y-x) and unit quaternions, for whole series.

References: Diebel, Representing Attitude (2006), sequence (3, 2, 1).
Known limits: at pitch ±90 degrees roll and yaw are not distinct.
Validated with: test/recordings/test_quaternions.py (round trip, rotation matrices).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


def quaternion(roll_rad: FloatArray, pitch_rad: FloatArray, yaw_rad: FloatArray) -> FloatArray:
    """Quaternion (x, y, z, w) along the last axis, of Rz(yaw) Ry(pitch) Rx(roll)."""
    cr, sr = np.cos(roll_rad / 2), np.sin(roll_rad / 2)
    cp, sp = np.cos(pitch_rad / 2), np.sin(pitch_rad / 2)
    cy, sy = np.cos(yaw_rad / 2), np.sin(yaw_rad / 2)
    x = cy * cp * sr - sy * sp * cr
    y = cy * sp * cr + sy * cp * sr
    z = sy * cp * cr - cy * sp * sr
    w = cy * cp * cr + sy * sp * sr
    return np.stack((x, y, z, w), axis=-1)


def angles(xyzw: FloatArray) -> dict[str, FloatArray]:
    """Angles ``roll``, ``pitch``, ``yaw`` (rad) of quaternions, any norm; yaw in (-pi, pi].

    Args:
        xyzw: shape (..., 4).

    Raises:
        ValueError: a quaternion of zero length.
    """
    norm = np.linalg.norm(xyzw, axis=-1, keepdims=True)
    if not (norm > 0).all():
        raise ValueError("a quaternion of zero length is no orientation")
    x, y, z, w = np.moveaxis(xyzw / norm, -1, 0)
    return {
        "roll": np.arctan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
        "pitch": np.arcsin(np.clip(2 * (w * y - z * x), -1.0, 1.0)),
        "yaw": np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)),
    }
