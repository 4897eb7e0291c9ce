"""Every power that enters or leaves a truck in one step, for the energy audit of `energy`.

Forces are those the step stored, velocities the mean of before and after: that is how the step
itself does work.

References: power = force times velocity at the point of action, for each element on both its ends.
Known limits: an imposed speed's push, a probe wrench and a shifting payload are not audited.
Validated with: test/physics/test_energy.py.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics import suspension
from truck_blowout_sim.physics.aero import add_air
from truck_blowout_sim.physics.axle import frame_end, heading_axes
from truck_blowout_sim.physics.fifth_wheel import point_velocity
from truck_blowout_sim.physics.jit import core, entry
from truck_blowout_sim.physics.layout import (
    AXLE,
    AXLE_S,
    GLOBAL_S,
    HUB,
    HUB_S,
    TIRE,
    TIRE_S,
    TOPOLOGY,
    UNIT,
    UNIT_S,
    UNIT_W,
)
from truck_blowout_sim.physics.places import (
    axle_params,
    axle_state,
    hub_at_side,
    hub_of,
    hub_params,
    hub_state,
    tire_params,
    tire_state,
    unit_of,
    unit_params,
    unit_state,
    unit_work,
)
from truck_blowout_sim.physics.rotation import fill_rotation, to_body, to_map
from truck_blowout_sim.physics.tires import blowout

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]


class Powers(NamedTuple):
    """Positions in the vector of powers [W], positive into the truck."""

    slip: int = 0  # tires sliding and scrubbing on the road
    rolling: int = 1  # rolling resistance
    vertical: int = 2  # tires pushed in and out
    drive: int = 3
    brakes: int = 4
    air: int = 5
    dampers: int = 6  # suspension dampers and leaf friction
    coupling: int = 7  # fifth wheel, both sides together
    frame: int = 8  # into the twisting frame


POWER = Powers()
N_POWERS = len(POWER)


@entry
def powers_w(before: Floats, after: Floats, p: Floats, topo: Integers, dt: float, work: Floats,
             middle: Floats, out: Floats) -> None:
    """Fill ``out`` [W] in the order of ``POWER`` for the step between two states.

    ``middle`` is scratch of the size of a state.
    """
    for k in range(topo[TOPOLOGY.state_line_at]):
        middle[k] = 0.5 * (before[k] + after[k])
    for k in range(N_POWERS):
        out[k] = 0.0
    n = topo[TOPOLOGY.n_units]
    for u in range(n):
        s, a, w = unit_state(u), unit_params(u), unit_work(u)
        fill_rotation(middle, s, work, w)
        for k in range(UNIT_W.fx_n, UNIT_W.matrix):
            work[w + k] = 0.0
        add_air(middle, s, p, a, work, w)
        for k in range(6):
            out[POWER.air] += work[w + UNIT_W.fx_n + k] * middle[s + UNIT_S.u_mps + k]
    if n == 2:
        out[POWER.coupling] = _coupling_power(middle, after, p, work)
    for i in range(topo[TOPOLOGY.n_axles]):
        _suspension_powers(before, after, middle, p, topo, i, dt, work, out)
        for side in range(2):
            _hub_powers(middle, after, p, topo, i, side, work, out)


@core
def _coupling_power(x: Floats, after: Floats, p: Floats, work: Floats) -> float:
    """Power of the fifth wheel's force and moments on both units."""
    s0, s1 = unit_state(0), unit_state(1)
    a0, a1, w1 = unit_params(0), unit_params(1), unit_work(1)
    f = (after[GLOBAL_S.coupling_fx_n], after[GLOBAL_S.coupling_fy_n],
         after[GLOBAL_S.coupling_fz_n])
    v0 = point_velocity(x, s0, p[a0 + UNIT.hitch_x_m], p[a0 + UNIT.hitch_y_m],
                        p[a0 + UNIT.hitch_z_m])
    v1 = point_velocity(x, s1, p[a1 + UNIT.hitch_x_m], p[a1 + UNIT.hitch_y_m],
                        p[a1 + UNIT.hitch_z_m])
    m1 = to_map(work, w1, v1[0], v1[1], v1[2])
    r1 = to_body(work, 0, m1[0], m1[1], m1[2])
    power = f[0] * (v0[0] - r1[0]) + f[1] * (v0[1] - r1[1]) + f[2] * (v0[2] - r1[2])
    y0 = (work[UNIT_W.rxy], work[UNIT_W.ryy], work[UNIT_W.rzy])
    z1 = (work[w1 + UNIT_W.rxz], work[w1 + UNIT_W.ryz], work[w1 + UNIT_W.rzz])
    n = (y0[1] * z1[2] - y0[2] * z1[1], y0[2] * z1[0] - y0[0] * z1[2],
         y0[0] * z1[1] - y0[1] * z1[0])
    n0, n1 = to_body(work, 0, n[0], n[1], n[2]), to_body(work, w1, n[0], n[1], n[2])
    for k in range(3):
        power += after[GLOBAL_S.coupling_roll_nm] * (
            n1[k] * x[s1 + UNIT_S.p_radps + k] - n0[k] * x[s0 + UNIT_S.p_radps + k])
    return power + after[GLOBAL_S.coupling_friction_nm] * (
        x[s0 + UNIT_S.r_radps] - x[s1 + UNIT_S.r_radps])


@core
def _suspension_powers(before: Floats, after: Floats, x: Floats, p: Floats, topo: Integers, i: int,
                       dt: float, work: Floats, out: Floats) -> None:
    """Dampers and dry friction of one axle, and what its springs push into the twisting frame."""
    unit = unit_of(topo, i)
    us, w = unit_state(unit), unit_work(unit)
    a, s = axle_params(topo, i), axle_state(topo, i)
    for k in range(2):
        side = 1.0 - 2.0 * k
        rate = suspension.travel_rate_mps(x, us, work, w, p, a, s, side)
        # the step damped with the rate at its beginning
        begin = suspension.travel_rate_mps(before, us, work, w, p, a, s, side)
        force = p[a + AXLE.damping_nspm] * begin + after[s + AXLE_S.friction_left_n + k]
        out[POWER.dampers] -= force * rate
    end = us + UNIT_S.twist_front_rad + frame_end(p, a)
    arm = p[a + AXLE.half_spacing_m]
    lean = 0.5 * (suspension.travel_m(before, us, work, w, p, a, s, 1.0, before[end])
                  - suspension.travel_m(before, us, work, w, p, a, s, -1.0, before[end])) / arm
    roll = (arm * (after[s + AXLE_S.spring_left_n] - after[s + AXLE_S.spring_right_n])
            + p[a + AXLE.aux_roll_nmprad] * lean)
    out[POWER.frame] -= roll * (after[end] - before[end]) / dt


@core
def _hub_powers(x: Floats, after: Floats, p: Floats, topo: Integers, i: int, side: int,
                work: Floats, out: Floats) -> None:
    """Tires, engine and brake of one hub, with their reaction on the axle."""
    unit = unit_of(topo, i)
    us, w = unit_state(unit), unit_work(unit)
    a, s = axle_params(topo, i), axle_state(topo, i)
    hub = hub_at_side(i, side)
    h, hs = hub_params(topo, hub), hub_state(topo, hub)
    _, ey, ez = heading_axes(work, w)
    pitch, yaw = 0.0, 0.0
    for k in range(3):
        pitch += x[us + UNIT_S.p_radps + k] * ey[k]
        yaw += x[us + UNIT_S.p_radps + k] * ez[k]
    spin = x[hs + HUB_S.spin_radps]
    motion = _contact_motion(x, us, p, a, s, work, w)
    cd, sd = math.cos(after[hs + HUB_S.steer_rad]), math.sin(after[hs + HUB_S.steer_rad])
    radius = 0.0
    for t in range(topo[TOPOLOGY.n_tires]):
        if hub_of(topo, t) != hub:
            continue
        ts, tp = tire_state(topo, t), tire_params(topo, t)
        arm = p[h + HUB.y_m] + p[tp + TIRE.y_m]
        radius = _rolling_radius(x, after, ts, p, tp, topo[TOPOLOGY.table_at])
        vx, vy = motion[0] - yaw * arm, motion[1]
        fx, fy = after[ts + TIRE_S.fx_n], after[ts + TIRE_S.fy_n]
        out[POWER.slip] += (fx * (vx * cd + vy * sd - radius * spin) + fy * (vy * cd - vx * sd)
                            + after[ts + TIRE_S.mz_nm] * yaw)
        out[POWER.rolling] -= after[ts + TIRE_S.rolling_nm] * spin
        out[POWER.vertical] += after[ts + TIRE_S.fz_n] * (
            x[s + AXLE_S.vz_mps] + arm * x[s + AXLE_S.roll_rate_radps])
    out[POWER.drive] += after[hs + HUB_S.drive_nm] * (spin - pitch)
    out[POWER.brakes] -= after[hs + HUB_S.brake_nm] * (spin - pitch)


@core
def _contact_motion(x: Floats, us: int, p: Floats, a: int, s: int, work: Floats, w: int
                    ) -> tuple[float, float]:
    """Velocity of the axle's middle at the road, along and across the unit's heading."""
    rx, rz = p[a + AXLE.x_m], p[a + AXLE.roll_centre_z_m]
    at = to_map(work, w, rx, 0.0, rz)
    v = point_velocity(x, us, rx, 0.0, rz)
    m = to_map(work, w, v[0], v[1], v[2])
    cy, sy = work[w + UNIT_W.cos_yaw], work[w + UNIT_W.sin_yaw]
    return (cy * m[0] + sy * m[1], cy * m[1] - sy * m[0]
            + x[s + AXLE_S.roll_rate_radps] * (x[us + UNIT_S.z_m] + at[2]))


@core
def _rolling_radius(x: Floats, after: Floats, ts: int, p: Floats, tp: int, table_at: int
                    ) -> float:
    """The rolling radius that the step used."""
    if p[tp + TIRE.law] > 0.0:
        # mid-step time: the rows of a table change at step edges
        return p[blowout.step_row(x, ts, p, table_at + int(p[tp + TIRE.table])) + 1]
    deflection = p[tp + TIRE.unloaded_radius_m] - after[ts + TIRE_S.loaded_radius_m]
    return blowout.rolling_radius_m(p, tp, deflection, after[ts + TIRE_S.rim])
