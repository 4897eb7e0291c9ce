"""The fifth wheel: three stiff translations, yaw and pitch free, roll stiff with separation lash.

In roll the coupler plate lies flat until the moment exceeds kingpin load times half the plate
width; then it lifts through the lash and is stiff again. A half width of zero gives free play
around the middle instead.

References: stiffness and damping after the MathWorks tractor-trailer example and a published 7-DOF
set (docs/physics.md, "Fifth wheel"); roll as the coupler's normal against the plate's pitch axis.
Known limits: force acts at one point; yaw friction does not depend on the kingpin load.
Validated with: test/physics/test_fifth_wheel.py (action = reaction, roll law, friction loop).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics.body import add_force, add_moment
from truck_blowout_sim.physics.choose import where
from truck_blowout_sim.physics.jit import core
from truck_blowout_sim.physics.layout import (
    COUPLING,
    COUPLING_AT,
    GLOBAL_S,
    UNIT,
    UNIT_S,
    UNIT_W,
)
from truck_blowout_sim.physics.rotation import to_body, to_map
from truck_blowout_sim.physics.scalar import hysteresis

Floats = NDArray[np.float64]


@core
def point_velocity(x: Floats, s: int, rx: float, ry: float, rz: float
                   ) -> tuple[float, float, float]:
    """Velocity [m/s], body axes, of the point at r of the unit at state ``s``."""
    p, q, r = x[s + UNIT_S.p_radps], x[s + UNIT_S.q_radps], x[s + UNIT_S.r_radps]
    return (x[s + UNIT_S.u_mps] + q * rz - r * ry,
            x[s + UNIT_S.v_mps] + r * rx - p * rz,
            x[s + UNIT_S.w_mps] + p * ry - q * rx)


@core
def roll_moment_nm(p: Floats, angle_rad: float, load_n: float) -> float:
    """Elastic roll moment [N m] at a relative roll ``angle_rad`` under a kingpin load."""
    k = p[COUPLING_AT + COUPLING.roll_stiffness_nmprad]
    lift = max(load_n, 0.0) * p[COUPLING_AT + COUPLING.plate_half_width_m]
    open_at = lift / k
    size = abs(angle_rad)
    shut_at = open_at + p[COUPLING_AT + COUPLING.roll_lash_rad]
    moment = lift + k * max(size - shut_at, 0.0)
    return where(size <= open_at, k * angle_rad, where(angle_rad > 0.0, moment, -moment))


@core
def in_contact(p: Floats, angle_rad: float, load_n: float) -> bool:
    """Whether plate and coupler touch flat or at the end of the lash, where they damp roll."""
    k = p[COUPLING_AT + COUPLING.roll_stiffness_nmprad]
    open_at = max(load_n, 0.0) * p[COUPLING_AT + COUPLING.plate_half_width_m] / k
    shut_at = open_at + p[COUPLING_AT + COUPLING.roll_lash_rad]
    return (abs(angle_rad) <= open_at) | (abs(angle_rad) >= shut_at)


@core
def add_coupling(x: Floats, s0: int, s1: int, p: Floats, a0: int, a1: int, work: Floats, w0: int,
                 w1: int, dt: float) -> None:
    """Add the fifth wheel's force and moments to tractor (0) and trailer (1)."""
    _add_translation(x, s0, s1, p, a0, a1, work, w0, w1)
    _add_roll(x, s0, s1, p, work, w0, w1)
    rate = x[s1 + UNIT_S.r_radps] - x[s0 + UNIT_S.r_radps]
    x[GLOBAL_S.coupling_friction_nm] = hysteresis(
        x[GLOBAL_S.coupling_friction_nm], rate * dt, p[COUPLING_AT + COUPLING.yaw_friction_nm],
        p[COUPLING_AT + COUPLING.yaw_friction_transition_rad])
    add_moment(work, w0, 0.0, 0.0, x[GLOBAL_S.coupling_friction_nm])
    add_moment(work, w1, 0.0, 0.0, -x[GLOBAL_S.coupling_friction_nm])


@core
def _add_translation(x: Floats, s0: int, s1: int, p: Floats, a0: int, a1: int, work: Floats,
                     w0: int, w1: int) -> None:
    """Spring and damper between fifth wheel and kingpin, in tractor axes."""
    h0 = (p[a0 + UNIT.hitch_x_m], p[a0 + UNIT.hitch_y_m], p[a0 + UNIT.hitch_z_m])
    h1 = (p[a1 + UNIT.hitch_x_m], p[a1 + UNIT.hitch_y_m], p[a1 + UNIT.hitch_z_m])
    q0 = to_map(work, w0, h0[0], h0[1], h0[2])
    q1 = to_map(work, w1, h1[0], h1[1], h1[2])
    gap = to_body(work, w0, x[s1 + UNIT_S.x_m] + q1[0] - x[s0 + UNIT_S.x_m] - q0[0],
                  x[s1 + UNIT_S.y_m] + q1[1] - x[s0 + UNIT_S.y_m] - q0[1],
                  x[s1 + UNIT_S.z_m] + q1[2] - x[s0 + UNIT_S.z_m] - q0[2])
    v0 = point_velocity(x, s0, h0[0], h0[1], h0[2])
    v1 = point_velocity(x, s1, h1[0], h1[1], h1[2])
    m1 = to_map(work, w1, v1[0], v1[1], v1[2])
    r1 = to_body(work, w0, m1[0], m1[1], m1[2])
    kxy, cxy = p[COUPLING_AT + COUPLING.stiffness_xy_npm], p[COUPLING_AT + COUPLING.damping_xy_nspm]
    kz, cz = p[COUPLING_AT + COUPLING.stiffness_z_npm], p[COUPLING_AT + COUPLING.damping_z_nspm]
    fx = kxy * gap[0] + cxy * (r1[0] - v0[0])
    fy = kxy * gap[1] + cxy * (r1[1] - v0[1])
    fz = kz * gap[2] + cz * (r1[2] - v0[2]) - p[COUPLING_AT + COUPLING.preload_z_n]
    add_force(work, w0, (fx, fy, fz), h0)
    f1 = to_map(work, w0, -fx, -fy, -fz)
    b1 = to_body(work, w1, f1[0], f1[1], f1[2])
    add_force(work, w1, b1, h1)
    # the plate and the coupler sit on the twisting ends of the frames
    work[w0 + UNIT_W.rear_nm] -= (h0[2] - p[a0 + UNIT.torsion_z_m]) * fy
    work[w1 + UNIT_W.front_nm] -= (h1[2] - p[a1 + UNIT.torsion_z_m]) * b1[1]
    x[GLOBAL_S.coupling_fx_n] = fx
    x[GLOBAL_S.coupling_fy_n] = fy
    x[GLOBAL_S.coupling_fz_n] = fz


@core
def _add_roll(x: Floats, s0: int, s1: int, p: Floats, work: Floats, w0: int, w1: int) -> None:
    """Roll moment between plate and coupler, which sit on the twisting ends of the frames."""
    yx, yy, yz = work[w0 + UNIT_W.rxy], work[w0 + UNIT_W.ryy], work[w0 + UNIT_W.rzy]
    zx, zy, zz = work[w1 + UNIT_W.rxz], work[w1 + UNIT_W.ryz], work[w1 + UNIT_W.rzz]
    angle = yx * zx + yy * zy + yz * zz
    nx, ny, nz = yy * zz - yz * zy, yz * zx - yx * zz, yx * zy - yy * zx
    n0 = to_body(work, w0, nx, ny, nz)
    n1 = to_body(work, w1, nx, ny, nz)
    turn1 = (n1[0] * x[s1 + UNIT_S.p_radps] + n1[1] * x[s1 + UNIT_S.q_radps]
             + n1[2] * x[s1 + UNIT_S.r_radps])
    turn0 = (n0[0] * x[s0 + UNIT_S.p_radps] + n0[1] * x[s0 + UNIT_S.q_radps]
             + n0[2] * x[s0 + UNIT_S.r_radps])
    load = -x[GLOBAL_S.coupling_fz_n]
    twist = x[s1 + UNIT_S.twist_front_rad] - x[s0 + UNIT_S.twist_rear_rad]
    moment = roll_moment_nm(p, angle - twist, load)
    stiff = p[COUPLING_AT + COUPLING.roll_stiffness_nmprad]
    work[w1 + UNIT_W.front_nm] += moment
    work[w0 + UNIT_W.rear_nm] -= moment
    work[w1 + UNIT_W.front_nmprad] += stiff
    work[w0 + UNIT_W.rear_nmprad] += stiff
    damped = moment + p[COUPLING_AT + COUPLING.roll_damping_nmsprad] * (turn0 - turn1)
    moment = where(in_contact(p, angle - twist, load), damped, moment)
    x[GLOBAL_S.coupling_roll_nm] = moment
    add_moment(work, w1, moment * n1[0], moment * n1[1], moment * n1[2])
    add_moment(work, w0, -moment * n0[0], -moment * n0[1], -moment * n0[2])
