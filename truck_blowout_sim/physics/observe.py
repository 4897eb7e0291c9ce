"""What instruments on the truck would read: one output vector from the state.

References: INS strapdown equations; axes and positions in docs/recordings.md.
Known limits: ideal instruments (noise and filters belong to recordings); accelerometers do not feel
the road turn while a slope begins (roll, pitch and gyros do).
Validated with: test/physics/test_observe.py (at rest +g, circular motion, gravity through roll,
roll of a banked road, gyros where a slope begins).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics import road
from truck_blowout_sim.physics.choose import where
from truck_blowout_sim.physics.fifth_wheel import point_velocity
from truck_blowout_sim.physics.jit import core, entry
from truck_blowout_sim.physics.layout import (
    GLOBAL_S,
    HUB_S,
    STATE_UNIT_AT,
    TIRE_S,
    TOPOLOGY,
    UNIT,
    UNIT_S,
    UNIT_W,
)
from truck_blowout_sim.physics.places import hub_state, tire_state, unit_params, unit_state
from truck_blowout_sim.physics.rotation import fill_rotation, to_body, to_map
from truck_blowout_sim.physics.scalar import clip

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

UNIT_OUTPUTS = (
    "x_m", "y_m", "yaw_rad", "roll_rad", "pitch_rad", "vx_mps", "vy_mps", "yaw_rate_radps",
    "roll_rate_radps", "pitch_rate_radps", "ax_mps2", "ay_mps2", "az_mps2", "z_m", "vz_mps",
)
HUB_OUTPUTS = ("hub_speed_{}_radps", "hub_spin_angle_{}_rad", "brake_chamber_{}_pa",
               "{}_steer_rad")
TIRE_OUTPUTS = ("tire_pressure_{}_pa", "tire_fx_{}_n", "tire_fy_{}_n", "tire_fz_{}_n",
                "tire_loaded_radius_{}_m")


def output_names(units: tuple[str, ...], hubs: tuple[str, ...],
                 tires: tuple[str, ...]) -> tuple[str, ...]:
    """Names of the output vector's entries, in order; units are the names' suffixes."""
    names = [f"{unit}_{name}" for unit in units for name in UNIT_OUTPUTS]
    names.append("articulation_rad")
    names += [name.format(hub) for hub in hubs for name in HUB_OUTPUTS]
    names += [name.format(tire) for tire in tires for name in TIRE_OUTPUTS]
    return tuple(names)


@entry
def observe(x: Floats, p: Floats, topo: Integers, work: Floats, out: Floats) -> None:
    """Fill ``out`` in the order of :func:`output_names`; ``work`` is scratch."""
    n_units = topo[TOPOLOGY.n_units]
    for u in range(n_units):
        _observe_unit(x, unit_state(u), p, unit_params(u), work, out, u * len(UNIT_OUTPUTS))
    k = n_units * len(UNIT_OUTPUTS)
    out[k] = 0.0
    if n_units == 2:
        out[k] = (x[STATE_UNIT_AT + len(UNIT_S) + UNIT_S.yaw_rad]
                  - x[STATE_UNIT_AT + UNIT_S.yaw_rad])
    k += 1
    for h in range(topo[TOPOLOGY.n_hubs]):
        s = hub_state(topo, h)
        out[k], out[k + 1] = x[s + HUB_S.spin_radps], x[s + HUB_S.angle_rad]
        out[k + 2], out[k + 3] = x[s + HUB_S.chamber_pa], x[s + HUB_S.steer_rad]
        k += len(HUB_OUTPUTS)
    for t in range(topo[TOPOLOGY.n_tires]):
        s = tire_state(topo, t)
        out[k] = x[s + TIRE_S.pressure_pa]
        out[k + 1], out[k + 2] = x[s + TIRE_S.fx_n], x[s + TIRE_S.fy_n]
        out[k + 3], out[k + 4] = x[s + TIRE_S.fz_n], x[s + TIRE_S.loaded_radius_m]
        k += len(TIRE_OUTPUTS)


@core
def _observe_unit(x: Floats, s: int, p: Floats, a: int, work: Floats, out: Floats, k: int) -> None:
    """Pose, velocity, rates and specific force at the unit's base_link."""
    fill_rotation(x, s, work, 0)
    bx, by, bz = p[a + UNIT.base_x_m], p[a + UNIT.base_y_m], p[a + UNIT.base_z_m]
    m = to_map(work, 0, bx, by, bz)
    v = point_velocity(x, s, bx, by, bz)
    out[k], out[k + 1] = x[s + UNIT_S.x_m] + m[0], x[s + UNIT_S.y_m] + m[1]
    roll_rad, pitch_rad = _tilt(x, s, p, work)
    out[k + 2], out[k + 3], out[k + 4] = x[s + UNIT_S.yaw_rad], roll_rad, pitch_rad
    out[k + 5], out[k + 6] = v[0], v[1]
    wx, wy, wz = x[s + UNIT_S.p_radps], x[s + UNIT_S.q_radps], x[s + UNIT_S.r_radps]
    turning = road.turning(p, x[GLOBAL_S.time_s])
    tx, ty, tz = to_body(work, 0, turning[0], turning[1], 0.0)
    out[k + 7], out[k + 8], out[k + 9] = p[a + UNIT.yaw_rate_gain] * (wz + tz), wx + tx, wy + ty
    cx, cy, cz = wy * bz - wz * by, wz * bx - wx * bz, wx * by - wy * bx
    dx, dy, dz = x[s + UNIT_S.pdot_radps2], x[s + UNIT_S.qdot_radps2], x[s + UNIT_S.rdot_radps2]
    out[k + 10] = (x[s + UNIT_S.ax_mps2] + dy * bz - dz * by + wy * cz - wz * cy
                   - x[s + UNIT_S.gx_mps2])
    out[k + 11] = (x[s + UNIT_S.ay_mps2] + dz * bx - dx * bz + wz * cx - wx * cz
                   - x[s + UNIT_S.gy_mps2])
    out[k + 12] = (x[s + UNIT_S.az_mps2] + dx * by - dy * bx + wx * cy - wy * cx
                   - x[s + UNIT_S.gz_mps2])
    out[k + 13] = x[s + UNIT_S.z_m] + m[2]
    out[k + 14] = (work[UNIT_W.rzx] * v[0] + work[UNIT_W.rzy] * v[1] + work[UNIT_W.rzz] * v[2])


@core
def _tilt(x: Floats, s: int, p: Floats, work: Floats) -> tuple[float, float]:
    """Roll and pitch [rad] against the true horizontal: of the unit on its road, and of the road.

    ``work`` holds the unit's rotation. Without gravity there is no horizontal but the road.
    """
    g = road.gravity(p, x[GLOBAL_S.time_s])
    size = math.sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2])
    down = to_body(work, 0, g[0] / size, g[1] / size, g[2] / size)
    roll_rad, pitch_rad = math.atan2(-down[1], -down[2]), math.asin(clip(down[0], -1.0, 1.0))
    heavy = size > 0.0
    return (where(heavy, roll_rad, x[s + UNIT_S.roll_rad]),
            where(heavy, pitch_rad, x[s + UNIT_S.pitch_rad]))
