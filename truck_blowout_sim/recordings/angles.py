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
    return quaternion_of(np.stack((roll_rad, pitch_rad, yaw_rad), axis=-1))


def quaternion_of(angles_rad: FloatArray) -> FloatArray:
    """Quaternions (x, y, z, w) of (roll, pitch, yaw) along the last axis.

    Few calls of numpy: for a handful of angles they cost more than the arithmetic.
    """
    half = angles_rad / 2
    c, s = np.cos(half), np.sin(half)
    cr, cp, cy = c[..., 0], c[..., 1], c[..., 2]
    sr, sp, sy = s[..., 0], s[..., 1], s[..., 2]
    cycp, sysp, cysp, sycp = cy * cp, sy * sp, cy * sp, sy * cp
    out = np.empty((*half.shape[:-1], 4))
    out[..., 0] = cycp * sr - sysp * cr
    out[..., 1] = cysp * cr + sycp * sr
    out[..., 2] = sycp * cr - cysp * sr
    out[..., 3] = cycp * cr + sysp * sr
    return out


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
