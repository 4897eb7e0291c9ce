"""A sprung body: mass matrix, wrench at the centre of gravity, accelerations.

Unknowns are the inertial acceleration of the centre of gravity and the angular acceleration, both
in body axes. Solid axles move with the body in the road plane, so their mass enters the matrix as
point masses that resist only along the two horizontal directions.

References: Newton-Euler; Featherstone, Rigid Body Dynamics Algorithms, spatial inertia.
Known limits: gyroscopic moments of the spinning wheels on the body are left out (under 0.1 kN m).
Validated with: test/physics/test_body.py (free fall, free spin, carried mass, twist, payload).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics.choose import any_of, where
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
    # a load that is not there, or has not begun to move, adds zeros
    m = max(p[a + UNIT.payload_kg], 0.0)
    if not any_of((share > 0.0) & (m > 0.0)):
        return
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
    if any_of(time < 1.0):
        _push_back(x, s, p, a, work, w, smooth_slopes(time), (x1, y1, z0))


@core
def _push_back(x: Floats, s: int, p: Floats, a: int, work: Floats, w: int,
               slopes: tuple[float, float], at: tuple[float, float, float]) -> None:
    """What moving the load pushes its unit back with: -m (a_rel + 2 omega x v_rel) where it is."""
    m, duration = max(p[a + UNIT.payload_kg], 0.0), p[a + UNIT.shift_duration_s]
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
        if any_of(k > 0.0):
            twist = x[s + UNIT_S.twist_front_rad + end]
            rate = (work[w + UNIT_W.front_nm + end] - k * twist) / (
                k * p[a + UNIT.torsion_damping_s] + dt * (k + work[w + UNIT_W.front_nmprad + end]))
            x[s + UNIT_S.twist_front_rad + end] = where(
                k > 0.0, clip(twist + dt * rate, -0.3, 0.3), twist)


@core
def inverse3(a: float, b: float, c: float, d: float, e: float, f: float
             ) -> tuple[float, float, float, float, float, float]:
    """Inverse of the symmetric matrix (a b c; b d e; c e f), in the same order."""
    aa, bb, cc = d * f - e * e, c * e - b * f, b * e - c * d
    scale = 1.0 / (a * aa + b * bb + c * cc)
    return (scale * aa, scale * bb, scale * cc, scale * (a * f - c * c), scale * (b * c - a * e),
            scale * (a * d - b * b))


@core
def times3(m: tuple[float, float, float, float, float, float], x: float, y: float, z: float
           ) -> tuple[float, float, float]:
    """Product of a symmetric matrix, as of `inverse3`, and a vector."""
    return (m[0] * x + m[1] * y + m[2] * z, m[1] * x + m[3] * y + m[4] * z,
            m[2] * x + m[4] * y + m[5] * z)


@core
def solve_unit(x: Floats, s: int, work: Floats, w: int) -> None:
    """Solve the 6x6 system and store the accelerations in the state.

    Block by block: with (M B; B' J) (a, alpha) = (f, m), the moments less what the forces account
    for, m - B' M^-1 f, turn the inertia J - B' M^-1 B; the rest accelerates M.
    """
    k = w + UNIT_W.matrix
    mass = inverse3(work[k], work[k + 1], work[k + 2], work[k + 6], work[k + 7], work[k + 11])
    # columns of B, and of M^-1 B
    b0 = (work[k + 3], work[k + 8], work[k + 12])
    b1 = (work[k + 4], work[k + 9], work[k + 13])
    b2 = (work[k + 5], work[k + 10], work[k + 14])
    c0 = times3(mass, b0[0], b0[1], b0[2])
    c1 = times3(mass, b1[0], b1[1], b1[2])
    c2 = times3(mass, b2[0], b2[1], b2[2])
    inertia = inverse3(work[k + 15] - dot(b0, c0), work[k + 16] - dot(b0, c1),
                       work[k + 17] - dot(b0, c2), work[k + 18] - dot(b1, c1),
                       work[k + 19] - dot(b1, c2), work[k + 20] - dot(b2, c2))
    b = w + UNIT_W.fx_n
    force = (work[b], work[b + 1], work[b + 2])
    turn = times3(inertia, work[b + 3] - dot(c0, force), work[b + 4] - dot(c1, force),
                  work[b + 5] - dot(c2, force))
    move = times3(mass, force[0], force[1], force[2])
    for i in range(3):
        x[s + UNIT_S.pdot_radps2 + i] = turn[i]
        x[s + UNIT_S.ax_mps2 + i] = (move[i] - c0[i] * turn[0] - c1[i] * turn[1]
                                     - c2[i] * turn[2])


@core
def dot(a: tuple[float, float, float], b: tuple[float, float, float]) -> float:
    """Scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
