"""Attitude: intrinsic z-y-x angles, rotation matrix, Euler rates.

References: ISO 8855 angles; any mechanics text (e.g. Diebel 2006, Representing Attitude).
Known limits: singular at 90 degrees of pitch, which no truck reaches on a road.
Validated with: test/physics/test_rotation.py (orthonormality, rates against finite differences).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics.jit import core
from truck_blowout_sim.physics.layout import UNIT_S, UNIT_W
from truck_blowout_sim.physics.trig import heading, turned

Floats = NDArray[np.float64]


@core
def fill_rotation(x: Floats, s: int, work: Floats, w: int) -> None:
    """Write the rotation body -> map of the unit at state ``s`` into ``work`` at ``w``."""
    cy, sy = heading(x[s + UNIT_S.yaw_rad])
    cp, sp = turned(x[s + UNIT_S.pitch_rad])
    cr, sr = turned(x[s + UNIT_S.roll_rad])
    work[w + UNIT_W.rxx] = cy * cp
    work[w + UNIT_W.rxy] = cy * sp * sr - sy * cr
    work[w + UNIT_W.rxz] = cy * sp * cr + sy * sr
    work[w + UNIT_W.ryx] = sy * cp
    work[w + UNIT_W.ryy] = sy * sp * sr + cy * cr
    work[w + UNIT_W.ryz] = sy * sp * cr - cy * sr
    work[w + UNIT_W.rzx] = -sp
    work[w + UNIT_W.rzy] = cp * sr
    work[w + UNIT_W.rzz] = cp * cr
    work[w + UNIT_W.cos_yaw] = cy
    work[w + UNIT_W.sin_yaw] = sy


@core
def to_map(work: Floats, w: int, bx: float, by: float, bz: float) -> tuple[float, float, float]:
    """Rotate a vector from body to map axes."""
    return (
        work[w + UNIT_W.rxx] * bx + work[w + UNIT_W.rxy] * by + work[w + UNIT_W.rxz] * bz,
        work[w + UNIT_W.ryx] * bx + work[w + UNIT_W.ryy] * by + work[w + UNIT_W.ryz] * bz,
        work[w + UNIT_W.rzx] * bx + work[w + UNIT_W.rzy] * by + work[w + UNIT_W.rzz] * bz,
    )


@core
def to_body(work: Floats, w: int, mx: float, my: float, mz: float) -> tuple[float, float, float]:
    """Rotate a vector from map to body axes."""
    return (
        work[w + UNIT_W.rxx] * mx + work[w + UNIT_W.ryx] * my + work[w + UNIT_W.rzx] * mz,
        work[w + UNIT_W.rxy] * mx + work[w + UNIT_W.ryy] * my + work[w + UNIT_W.rzy] * mz,
        work[w + UNIT_W.rxz] * mx + work[w + UNIT_W.ryz] * my + work[w + UNIT_W.rzz] * mz,
    )


@core
def angle_rates(x: Floats, s: int, work: Floats, w: int) -> tuple[float, float, float]:
    """As `euler_rates`, from the rotation filled at ``w``: no trigonometry."""
    rzy, rzz = work[w + UNIT_W.rzy], work[w + UNIT_W.rzz]
    flat = rzy * rzy + rzz * rzz
    q, r = x[s + UNIT_S.q_radps], x[s + UNIT_S.r_radps]
    yaw_rate = (q * rzy + r * rzz) / flat
    pitch_rate = (q * rzz - r * rzy) / math.sqrt(flat)
    return yaw_rate, pitch_rate, x[s + UNIT_S.p_radps] - work[w + UNIT_W.rzx] * yaw_rate


@core
def euler_rates(x: Floats, s: int) -> tuple[float, float, float]:
    """Yaw, pitch and roll angle rates [rad/s] of the unit at state ``s``."""
    cp, sp = math.cos(x[s + UNIT_S.pitch_rad]), math.sin(x[s + UNIT_S.pitch_rad])
    cr, sr = math.cos(x[s + UNIT_S.roll_rad]), math.sin(x[s + UNIT_S.roll_rad])
    q, r = x[s + UNIT_S.q_radps], x[s + UNIT_S.r_radps]
    yaw_rate = (q * sr + r * cr) / cp
    return yaw_rate, q * cr - r * sr, x[s + UNIT_S.p_radps] + sp * yaw_rate
