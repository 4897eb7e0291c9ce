"""A sprung body: mass matrix, wrench at the centre of gravity, accelerations.

Unknowns are the inertial acceleration of the centre of gravity and the angular acceleration, both
in body axes. Solid axles move with the body in the road plane, so their mass enters the matrix as
point masses that resist only along the two horizontal directions.

References: Newton-Euler; Featherstone, Rigid Body Dynamics Algorithms, spatial inertia.
Known limits: gyroscopic moments of the spinning wheels on the body are left out (under 0.1 kN m).
Validated with: test/physics/test_body.py (free fall, free spin, carried mass, twist, payload).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics.jit import core
from truck_blowout_sim.physics.layout import UNIT, UNIT_S, UNIT_W
from truck_blowout_sim.physics.scalar import clip, smooth, smooth_slopes

Floats = NDArray[np.float64]


@core
def entry(i: int, j: int) -> int:
    """Position of (i, j), i <= j, in the packed upper triangle of a 6x6 matrix."""
    return i * 6 - (i * (i - 1)) // 2 + (j - i)


@core
def add_force(work: Floats, w: int, force: tuple[float, float, float],
              point: tuple[float, float, float]) -> None:
    """Add a force [N] acting at ``point`` [m], both in body axes from the centre of gravity."""
    fx, fy, fz = force
    rx, ry, rz = point
    work[w + UNIT_W.fx_n] += fx
    work[w + UNIT_W.fy_n] += fy
    work[w + UNIT_W.fz_n] += fz
    work[w + UNIT_W.mx_nm] += ry * fz - rz * fy
    work[w + UNIT_W.my_nm] += rz * fx - rx * fz
    work[w + UNIT_W.mz_nm] += rx * fy - ry * fx


@core
def add_moment(work: Floats, w: int, mx: float, my: float, mz: float) -> None:
    """Add a moment [N m] in body axes."""
    work[w + UNIT_W.mx_nm] += mx
    work[w + UNIT_W.my_nm] += my
    work[w + UNIT_W.mz_nm] += mz


@core
def add_inertia_along(work: Floats, w: int, mass: float, d: tuple[float, float, float],
                      r: tuple[float, float, float]) -> None:
    """Add a point mass at ``r`` that resists acceleration along the unit vector ``d`` only."""
    jx, jy, jz = d
    lx = r[1] * jz - r[2] * jy
    ly = r[2] * jx - r[0] * jz
    lz = r[0] * jy - r[1] * jx
    row = (jx, jy, jz, lx, ly, lz)
    k = w + UNIT_W.matrix
    for i in range(6):
        for j in range(i, 6):
            work[k] += mass * row[i] * row[j]
            k += 1


@core
def add_rotary_inertia(work: Floats, w: int, inertia: float, d: tuple[float, float, float]) -> None:
    """Add a moment of inertia about the direction ``d``."""
    for i in range(3):
        for j in range(i, 3):
            work[w + UNIT_W.matrix + entry(3 + i, 3 + j)] += inertia * d[i] * d[j]


@core
def start_unit(x: Floats, s: int, p: Floats, a: int, work: Floats, w: int,
               gravity: tuple[float, float, float]) -> None:
    """Clear the wrench, fill the mass matrix, add gravity and gyroscopic terms of the body."""
    for k in range(UNIT_W.fx_n, UNIT_W.matrix + 21):
        work[w + k] = 0.0
    m = p[a + UNIT.mass_kg]
    at = w + UNIT_W.matrix
    for i in range(3):
        work[at + entry(i, i)] = m
    work[at + entry(3, 3)] = p[a + UNIT.ixx_kgm2]
    work[at + entry(4, 4)] = p[a + UNIT.iyy_kgm2]
    work[at + entry(5, 5)] = p[a + UNIT.izz_kgm2]
    work[at + entry(3, 4)] = -p[a + UNIT.ixy_kgm2]
    work[at + entry(3, 5)] = -p[a + UNIT.ixz_kgm2]
    work[at + entry(4, 5)] = -p[a + UNIT.iyz_kgm2]
    gx, gy, gz = gravity
    x[s + UNIT_S.gx_mps2] = gx
    x[s + UNIT_S.gy_mps2] = gy
    x[s + UNIT_S.gz_mps2] = gz
    add_force(work, w, (m * gx, m * gy, m * gz), (0.0, 0.0, 0.0))
    shift_payload(x, s, p, a, work, w)
    _add_gyroscopic(x, s, work, w)


@core
def shift_payload(x: Floats, s: int, p: Floats, a: int, work: Floats, w: int) -> None:
    """Move the payload: first moment, inertia and weight moment of the displaced mass."""
    time = (x[0] - p[a + UNIT.shift_start_s]) / p[a + UNIT.shift_duration_s]
    share = smooth(time)
    if share <= 0.0 or p[a + UNIT.payload_kg] <= 0.0:
        return
    m = p[a + UNIT.payload_kg]
    dx, dy = share * p[a + UNIT.shift_x_m], share * p[a + UNIT.shift_y_m]
    x0, y0, z0 = p[a + UNIT.payload_x_m], p[a + UNIT.payload_y_m], p[a + UNIT.payload_z_m]
    x1, y1 = x0 + dx, y0 + dy
    at = w + UNIT_W.matrix
    sx, sy = m * dx, m * dy
    work[at + entry(0, 5)] -= sy
    work[at + entry(1, 5)] += sx
    work[at + entry(2, 3)] += sy
    work[at + entry(2, 4)] -= sx
    work[at + entry(3, 3)] += m * (y1 * y1 - y0 * y0)
    work[at + entry(4, 4)] += m * (x1 * x1 - x0 * x0)
    work[at + entry(5, 5)] += m * (x1 * x1 + y1 * y1 - x0 * x0 - y0 * y0)
    work[at + entry(3, 4)] -= m * (x1 * y1 - x0 * y0)
    work[at + entry(3, 5)] -= m * (x1 - x0) * z0
    work[at + entry(4, 5)] -= m * (y1 - y0) * z0
    gx, gy, gz = x[s + UNIT_S.gx_mps2], x[s + UNIT_S.gy_mps2], x[s + UNIT_S.gz_mps2]
    add_moment(work, w, sy * gz, -sx * gz, sx * gy - sy * gx)
    # its weight stands on the twisting ends of the frame
    rear = p[a + UNIT.payload_rear_share]
    work[w + UNIT_W.front_nm] += (1.0 - rear) * sy * gz
    work[w + UNIT_W.rear_nm] += rear * sy * gz
    pr, qr, rr = x[s + UNIT_S.p_radps], x[s + UNIT_S.q_radps], x[s + UNIT_S.r_radps]
    dot = pr * sx + qr * sy
    w2 = pr * pr + qr * qr + rr * rr
    work[w + UNIT_W.fx_n] -= pr * dot - w2 * sx
    work[w + UNIT_W.fy_n] -= qr * dot - w2 * sy
    work[w + UNIT_W.fz_n] -= rr * dot
    if time < 1.0:
        _push_back(x, s, p, a, work, w, smooth_slopes(time), (x1, y1, z0))


@core
def _push_back(x: Floats, s: int, p: Floats, a: int, work: Floats, w: int,
               slopes: tuple[float, float], at: tuple[float, float, float]) -> None:
    """What moving the load pushes its unit back with: -m (a_rel + 2 omega x v_rel) where it is."""
    m, duration = p[a + UNIT.payload_kg], p[a + UNIT.shift_duration_s]
    rate, bend = slopes[0] / duration, slopes[1] / (duration * duration)
    dx, dy = p[a + UNIT.shift_x_m], p[a + UNIT.shift_y_m]
    pr, qr, rr = x[s + UNIT_S.p_radps], x[s + UNIT_S.q_radps], x[s + UNIT_S.r_radps]
    add_force(work, w, (-m * (bend * dx - 2.0 * rr * rate * dy),
                        -m * (bend * dy + 2.0 * rr * rate * dx),
                        -2.0 * m * rate * (pr * dy - qr * dx)), at)


@core
def _add_gyroscopic(x: Floats, s: int, work: Floats, w: int) -> None:
    """Subtract omega x (I omega), I being the rotary block of the matrix."""
    pr, qr, rr = x[s + UNIT_S.p_radps], x[s + UNIT_S.q_radps], x[s + UNIT_S.r_radps]
    at = w + UNIT_W.matrix
    ixx, ixy, ixz = work[at + entry(3, 3)], work[at + entry(3, 4)], work[at + entry(3, 5)]
    iyy, iyz, izz = work[at + entry(4, 4)], work[at + entry(4, 5)], work[at + entry(5, 5)]
    hx = ixx * pr + ixy * qr + ixz * rr
    hy = ixy * pr + iyy * qr + iyz * rr
    hz = ixz * pr + iyz * qr + izz * rr
    add_moment(work, w, rr * hy - qr * hz, pr * hz - rr * hx, qr * hx - pr * hy)


@core
def twist_frame(x: Floats, s: int, p: Floats, a: int, work: Floats, w: int, dt: float) -> None:
    """Twist the massless ends of the frame: c dtau/dt = moment - k tau, implicit in all springs."""
    for end in range(2):
        k = p[a + UNIT.torsion_front_nmprad + end]
        if k > 0.0:
            twist = x[s + UNIT_S.twist_front_rad + end]
            rate = (work[w + UNIT_W.front_nm + end] - k * twist) / (
                k * p[a + UNIT.torsion_damping_s] + dt * (k + work[w + UNIT_W.front_nmprad + end]))
            x[s + UNIT_S.twist_front_rad + end] = clip(twist + dt * rate, -0.3, 0.3)


@core
def solve_unit(x: Floats, s: int, work: Floats, w: int) -> None:
    """Solve the 6x6 system (Cholesky, in place) and store the accelerations in the state."""
    at = w + UNIT_W.matrix
    for i in range(6):
        ii = at + entry(i, i)
        for k in range(i):
            work[ii] -= work[at + entry(k, i)] ** 2
        work[ii] = math.sqrt(work[ii])
        inverse = 1.0 / work[ii]
        for j in range(i + 1, 6):
            ij = at + entry(i, j)
            for k in range(i):
                work[ij] -= work[at + entry(k, i)] * work[at + entry(k, j)]
            work[ij] *= inverse
    b = w + UNIT_W.fx_n
    for i in range(6):
        for k in range(i):
            work[b + i] -= work[at + entry(k, i)] * work[b + k]
        work[b + i] /= work[at + entry(i, i)]
    for i in range(5, -1, -1):
        for k in range(i + 1, 6):
            work[b + i] -= work[at + entry(i, k)] * work[b + k]
        work[b + i] /= work[at + entry(i, i)]
        x[s + UNIT_S.ax_mps2 + i] = work[b + i]
