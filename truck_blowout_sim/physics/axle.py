"""A solid axle: bounce and roll of its own, carried along by its body in the road plane.

The axle follows its body horizontally at the roll centre, moves freely up and down, and rolls about
the roll centre. Lateral tire force reaches the body there; roll goes through springs.

References: solid-axle model of the UMTRI phase-4 program and TruckSim's manuals (concept only).
Known limits: roll centre fixed in the body; no axle wind-up, no fore-aft compliance; the lateral
reaction of the axle's roll acceleration on the body is left out.
Validated with: test/physics/test_axle.py (static loads, lateral load transfer, axle steer).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics import steering, suspension, wheel
from truck_blowout_sim.physics.body import (
    add_force,
    add_inertia_along,
    add_moment,
    add_rotary_inertia,
)
from truck_blowout_sim.physics.choose import any_of, shared
from truck_blowout_sim.physics.fifth_wheel import point_velocity
from truck_blowout_sim.physics.jit import core
from truck_blowout_sim.physics.layout import (
    AXLE,
    AXLE_S,
    HUB,
    HUB_S,
    TIRE_S,
    TOPOLOGY,
    UNIT,
    UNIT_S,
    UNIT_W,
)
from truck_blowout_sim.physics.places import (
    axle_params,
    axle_state,
    circuit_of,
    hub_at_side,
    hub_of,
    hub_params,
    hub_state,
    partner_of,
    tire_state,
    unit_of,
    unit_params,
    unit_state,
)
from truck_blowout_sim.physics.rotation import angle_rates, to_map

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]


@core
def heading_axes(work: Floats, w: int) -> tuple[
        tuple[float, float, float], tuple[float, float, float], tuple[float, float, float]]:
    """Forward, left and up of the road plane at the unit's heading, in body axes."""
    c, s = work[w + UNIT_W.cos_yaw], work[w + UNIT_W.sin_yaw]
    ex = (c * work[w + UNIT_W.rxx] + s * work[w + UNIT_W.ryx],
          c * work[w + UNIT_W.rxy] + s * work[w + UNIT_W.ryy],
          c * work[w + UNIT_W.rxz] + s * work[w + UNIT_W.ryz])
    ey = (c * work[w + UNIT_W.ryx] - s * work[w + UNIT_W.rxx],
          c * work[w + UNIT_W.ryy] - s * work[w + UNIT_W.rxy],
          c * work[w + UNIT_W.ryz] - s * work[w + UNIT_W.rxz])
    ez = (work[w + UNIT_W.rzx], work[w + UNIT_W.rzy], work[w + UNIT_W.rzz])
    return ex, ey, ez


@core
def spin_cross(x: Floats, us: int, rx: float, rz: float) -> tuple[float, float, float]:
    """Omega x (omega x r) of the point (rx, 0, rz)."""
    p, q, r = x[us + UNIT_S.p_radps], x[us + UNIT_S.q_radps], x[us + UNIT_S.r_radps]
    cx, cy, cz = q * rz, r * rx - p * rz, -q * rx
    return q * cz - r * cy, r * cx - p * cz, p * cy - q * cx


@core
def carry_mass(x: Floats, us: int, p: Floats, a: int, work: Floats, w: int, mass: float,
               gx_n: float, gy_n: float) -> None:
    """Let the body carry the axle's mass in the road plane: inertia, centripetal, slope weight."""
    ex, ey, ez = heading_axes(work, w)
    point = (p[a + AXLE.x_m], 0.0, p[a + AXLE.roll_centre_z_m])
    add_inertia_along(work, w, mass, ex, point)
    add_inertia_along(work, w, mass, ey, point)
    add_rotary_inertia(work, w, p[a + AXLE.izz_kgm2], ez)
    c = spin_cross(x, us, point[0], point[2])
    fx = gx_n - mass * (c[0] * ex[0] + c[1] * ex[1] + c[2] * ex[2])
    fy = gy_n - mass * (c[0] * ey[0] + c[1] * ey[1] + c[2] * ey[2])
    add_force(work, w, (fx * ex[0] + fy * ey[0], fx * ex[1] + fy * ey[1],
                        fx * ex[2] + fy * ey[2]), point)


@core
def lateral_acceleration(x: Floats, us: int, p: Floats, a: int, work: Floats, w: int) -> float:
    """Lateral acceleration [m/s^2] at the roll centre, from the step before."""
    rx, rz = p[a + AXLE.x_m], p[a + AXLE.roll_centre_z_m]
    c = spin_cross(x, us, rx, rz)
    bx = x[us + UNIT_S.ax_mps2] + x[us + UNIT_S.qdot_radps2] * rz + c[0]
    by = (x[us + UNIT_S.ay_mps2] + x[us + UNIT_S.rdot_radps2] * rx
          - x[us + UNIT_S.pdot_radps2] * rz + c[1])
    bz = x[us + UNIT_S.az_mps2] - x[us + UNIT_S.qdot_radps2] * rx + c[2]
    _, ey, _ = heading_axes(work, w)
    return bx * ey[0] + by * ey[1] + bz * ey[2]


@core
def place_axle(x: Floats, p: Floats, topo: Integers, i: int, first: int, work: Floats, w: int,
               lanes: Floats, dt: float) -> int:
    """Steer one axle and place its tires for the pass over all tires.

    ``first`` is the number of its first tire; returns the number of the next axle's.
    """
    us, a, s = unit_state(unit_of(topo, i)), axle_params(topo, i), axle_state(topo, i)
    left, right = travels(x, us, work, w, p, a, s)
    steer = axle_steer_rad(p, a, left, right)
    if any_of(p[a + AXLE.lateral_compliance_radpn] != 0.0):
        steer += p[a + AXLE.lateral_compliance_radpn] * _axle_lateral(x, topo, i)
    x[s + AXLE_S.steer_rad] = steer
    rx, rz = p[a + AXLE.x_m], p[a + AXLE.roll_centre_z_m]
    at = to_map(work, w, rx, 0.0, rz)
    v = point_velocity(x, us, rx, 0.0, rz)
    m = to_map(work, w, v[0], v[1], v[2])
    cy, sy = work[w + UNIT_W.cos_yaw], work[w + UNIT_W.sin_yaw]
    yaw_rate, _, _ = angle_rates(x, us, work, w)
    motion = (cy * m[0] + sy * m[1],
              cy * m[1] - sy * m[0]
              + x[s + AXLE_S.roll_rate_radps] * (x[us + UNIT_S.z_m] + at[2]), yaw_rate)
    place = (x[us + UNIT_S.x_m] + at[0], x[us + UNIT_S.y_m] + at[1], cy, sy)
    for k in range(2):
        h = hub_params(topo, hub_at_side(i, k))
        hs = hub_state(topo, hub_at_side(i, k))
        angle = steer + p[h + HUB.toe_rad]
        if i == topo[TOPOLOGY.steered_axle]:
            angle += steering.wheel_angle_rad(x, p, 1.0 - 2.0 * k, p[a + AXLE.half_track_m])
        count = tires_of_hub(topo, first, hub_at_side(i, k))
        wheel.place_tires(x, hs, p, h, a, s, topo, first, count, angle, place, motion, lanes, dt)
        first += count
    return first


@core
def tires_of_hub(topo: Integers, first: int, hub: int) -> int:
    """How many tires from number ``first`` on stand on a hub; tires are numbered hub by hub."""
    count = 0
    while first + count < topo[TOPOLOGY.n_tires] and hub_of(topo, first + count) == hub:
        count += 1
    return count


@core
def frame_end(p: Floats, a: int) -> int:
    """Which end of the twisting frame an axle carries: 0 the front, 1 the rear."""
    return 0 if shared(p[a + AXLE.x_m]) > 0.0 else 1


@core
def travels(x: Floats, us: int, work: Floats, w: int, p: Floats, a: int, s: int
            ) -> tuple[float, float]:
    """Compression [m] of the springs of the axle at ``a`` and ``s``, left and right."""
    twist = x[us + UNIT_S.twist_front_rad + frame_end(p, a)]
    return (suspension.travel_m(x, us, work, w, p, a, s, 1.0, twist),
            suspension.travel_m(x, us, work, w, p, a, s, -1.0, twist))


@core
def axle_steer_rad(p: Floats, a: int, left: float, right: float) -> float:
    """Steer [rad] of an axle from its build and its springs."""
    lean = 0.5 * (left - right) / p[a + AXLE.half_spacing_m]
    return (p[a + AXLE.misalignment_rad]
            - (p[a + AXLE.roll_steer] + p[a + AXLE.roll_steer_extra]) * lean
            + p[a + AXLE.drop_steer_radpm] * 0.5 * (left + right))


@core
def move_axle(x: Floats, p: Floats, topo: Integers, i: int, first: int, work: Floats, w: int,
              gravity: tuple[float, float, float], kingpin_axis: tuple[float, float, float],
              drive: tuple[float, float, float], lanes: Floats, dt: float) -> tuple[int, float]:
    """One axle after the pass over all tires: its wrench to the body, its velocities and spins.

    Returns the number of the next axle's first tire, and the kingpin moment [N m] of a steered
    axle, else 0.
    """
    unit = unit_of(topo, i)
    us, a, s = unit_state(unit), axle_params(topo, i), axle_state(topo, i)
    end = frame_end(p, a)
    high = _roll_centre_z(x, us, p, a, work, w)
    first, force, kingpin = _collect(x, p, topo, i, first, a, s, high, kingpin_axis, drive, lanes,
                                     dt)
    left, right = travels(x, us, work, w, p, a, s)
    arm = p[a + AXLE.half_spacing_m]
    lean = 0.5 * (left - right) / arm
    partner = partner_of(topo, i)
    if partner >= 0:
        pa, ps = axle_params(topo, partner), axle_state(topo, partner)
        twist = x[us + UNIT_S.twist_front_rad + end]
        left = suspension.equalised_m(
            p, a, left, suspension.travel_m(x, us, work, w, p, pa, ps, 1.0, twist))
        right = suspension.equalised_m(
            p, a, right, suspension.travel_m(x, us, work, w, p, pa, ps, -1.0, twist))
    rate = suspension.travel_rate_mps(x, us, work, w, p, a, s, 1.0)
    f_left = suspension.side_force_n(x, s, p, a, 1.0, left, rate, dt)
    rate = suspension.travel_rate_mps(x, us, work, w, p, a, s, -1.0)
    f_right = suspension.side_force_n(x, s, p, a, -1.0, right, rate, dt)
    x[s + AXLE_S.spring_left_n], x[s + AXLE_S.spring_right_n] = f_left, f_right
    roll_nm = arm * (f_left - f_right) + p[a + AXLE.aux_roll_nmprad] * lean
    spring = 2.0 * p[a + AXLE.spring_npm] * arm * arm + p[a + AXLE.aux_roll_nmprad]
    over = p[a + AXLE.roll_centre_z_m] - p[unit_params(unit) + UNIT.torsion_z_m]
    work[w + UNIT_W.front_nm + end] += roll_nm - over * force[1]
    work[w + UNIT_W.front_nmprad + end] += spring
    _load_body(work, w, p, a, force, f_left + f_right, roll_nm)
    cy, sy = work[w + UNIT_W.cos_yaw], work[w + UNIT_W.sin_yaw]
    mass = p[a + AXLE.mass_kg]
    slope = cy * gravity[1] - sy * gravity[0]
    carry_mass(x, us, p, a, work, w, mass, mass * (cy * gravity[0] + sy * gravity[1]), mass * slope)
    above = x[s + AXLE_S.z_m] - high
    pull = mass * above * (lateral_acceleration(x, us, p, a, work, w) - slope)
    inertia = p[a + AXLE.ixx_kgm2] + mass * above * above
    x[s + AXLE_S.vz_mps] += dt * ((force[2] - f_left - f_right) / mass + gravity[2])
    x[s + AXLE_S.roll_rate_radps] += dt * (force[3] - roll_nm + pull) / inertia
    return first, kingpin


@core
def _axle_lateral(x: Floats, topo: Integers, i: int) -> float:
    """Lateral tire force [N] of the axle in the step before."""
    total = 0.0
    for k in range(topo[TOPOLOGY.n_tires]):
        hub = hub_of(topo, k)
        if hub // 2 == i:
            total += x[tire_state(topo, k) + TIRE_S.fy_n]
    return total


@core
def _roll_centre_z(x: Floats, us: int, p: Floats, a: int, work: Floats, w: int) -> float:
    """Height [m] of the roll centre in map."""
    return (x[us + UNIT_S.z_m] + work[w + UNIT_W.rzx] * p[a + AXLE.x_m]
            + work[w + UNIT_W.rzz] * p[a + AXLE.roll_centre_z_m])


@core
def _collect(x: Floats, p: Floats, topo: Integers, i: int, first: int, a: int, s: int, up: float,
             kingpin_axis: tuple[float, float, float], drive: tuple[float, float, float],
             lanes: Floats, dt: float
             ) -> tuple[int, tuple[float, float, float, float, float, float], float]:
    """Sum both hubs about the roll centre, ``up`` above the road, and its kingpin moments.

    Returns the next axle's first tire, fx … mz in heading axes, and the kingpin moment.
    """
    fx, fy, fz, mx, my, mz, kingpin = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    circuit = circuit_of(topo, i)
    for k in range(2):
        h = hub_params(topo, hub_at_side(i, k))
        hs = hub_state(topo, hub_at_side(i, k))
        spin = x[hs + HUB_S.spin_radps]
        count = tires_of_hub(topo, first, hub_at_side(i, k))
        out = wheel.collect_tires(x, hs, p, h, topo, first, count, circuit, drive, lanes, dt)
        fx, fy, fz = fx + out[0], fy + out[1], fz + out[2]
        mx, my, mz = mx + out[3] + up * out[1], my + out[4] - up * out[0], mz + out[5]
        if i == topo[TOPOLOGY.steered_axle]:
            ts = tire_state(topo, first)
            gyro = -p[h + HUB.spin_inertia_kgm2] * spin * x[s + AXLE_S.roll_rate_radps]
            kingpin += steering.kingpin_moment_nm(
                p, kingpin_axis, 1.0 - 2.0 * k, x[s + AXLE_S.roll_rad], x[hs + HUB_S.steer_rad],
                out[6], (x[ts + TIRE_S.fx_n], x[ts + TIRE_S.fy_n], x[ts + TIRE_S.fz_n]),
                x[ts + TIRE_S.mz_nm], x[hs + HUB_S.brake_nm], gyro)
        first += count
    return first, (fx, fy, fz, mx, my, mz), kingpin


@core
def _load_body(work: Floats, w: int, p: Floats, a: int,
               force: tuple[float, float, float, float, float, float], spring_n: float,
               roll_nm: float) -> None:
    """Hand the axle's force and moments to the body at the roll centre."""
    ex, ey, ez = heading_axes(work, w)
    point = (p[a + AXLE.x_m], 0.0, p[a + AXLE.roll_centre_z_m])
    add_force(work, w, (force[0] * ex[0] + force[1] * ey[0] + spring_n * ez[0],
                        force[0] * ex[1] + force[1] * ey[1] + spring_n * ez[1],
                        force[0] * ex[2] + force[1] * ey[2] + spring_n * ez[2]), point)
    mx, my, mz = roll_nm, force[4], force[5]
    add_moment(work, w, mx * ex[0] + my * ey[0] + mz * ez[0],
               mx * ex[1] + my * ey[1] + mz * ez[1], mx * ex[2] + my * ey[2] + mz * ez[2])
