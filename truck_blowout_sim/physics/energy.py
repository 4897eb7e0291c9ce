"""What a truck holds: kinetic and potential energy. No step calls this; an audit does.

With `powers.powers_w` it shows that action is reaction everywhere: energy must change by exactly
what tires, air, engine, brakes, dampers, dry friction, coupling and frame deliver.

References: T = 1/2 m v^2 + 1/2 w I w of every body; elastic energy as the integral of the force.
Known limits: payload must not shift; tires, fifth wheel and frame hold none here (their power is in
`powers`); steering and gas are not audited.
Validated with: test/physics/test_energy.py.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics import road, suspension
from truck_blowout_sim.physics.axle import frame_end, heading_axes
from truck_blowout_sim.physics.fifth_wheel import point_velocity
from truck_blowout_sim.physics.jit import core, entry
from truck_blowout_sim.physics.layout import (
    AXLE,
    AXLE_S,
    GLOBAL_S,
    HUB,
    HUB_S,
    TOPOLOGY,
    UNIT,
    UNIT_S,
)
from truck_blowout_sim.physics.places import (
    axle_params,
    axle_state,
    hub_params,
    hub_state,
    partner_of,
    unit_of,
    unit_params,
    unit_state,
    unit_work,
)
from truck_blowout_sim.physics.rotation import fill_rotation, to_map

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]


@entry
def energy_j(x: Floats, p: Floats, topo: Integers, work: Floats) -> float:
    """Kinetic and potential energy [J] of bodies, axles, wheels and suspension springs."""
    g = road.gravity(p, x[GLOBAL_S.time_s])
    total = 0.0
    for u in range(topo[TOPOLOGY.n_units]):
        s, a = unit_state(u), unit_params(u)
        fill_rotation(x, s, work, unit_work(u))
        total += _unit_energy(x, s, p, a, g)
    for i in range(topo[TOPOLOGY.n_axles]):
        total += _axle_energy(x, p, topo, i, work, g)
    for h in range(topo[TOPOLOGY.n_hubs]):
        spin = x[hub_state(topo, h) + HUB_S.spin_radps]
        total += 0.5 * p[hub_params(topo, h) + HUB.spin_inertia_kgm2] * spin * spin
    return total


@core
def _unit_energy(x: Floats, s: int, p: Floats, a: int, g: tuple[float, float, float]) -> float:
    """A sprung body: translation, rotation, height."""
    m = p[a + UNIT.mass_kg]
    u, v, w = x[s + UNIT_S.u_mps], x[s + UNIT_S.v_mps], x[s + UNIT_S.w_mps]
    pr, qr, rr = x[s + UNIT_S.p_radps], x[s + UNIT_S.q_radps], x[s + UNIT_S.r_radps]
    spin = (p[a + UNIT.ixx_kgm2] * pr * pr + p[a + UNIT.iyy_kgm2] * qr * qr
            + p[a + UNIT.izz_kgm2] * rr * rr
            - 2.0 * (p[a + UNIT.ixy_kgm2] * pr * qr + p[a + UNIT.ixz_kgm2] * pr * rr
                     + p[a + UNIT.iyz_kgm2] * qr * rr))
    height = (g[0] * x[s + UNIT_S.x_m] + g[1] * x[s + UNIT_S.y_m] + g[2] * x[s + UNIT_S.z_m])
    return 0.5 * m * (u * u + v * v + w * w) + 0.5 * spin - m * height


@core
def _axle_energy(x: Floats, p: Floats, topo: Integers, i: int, work: Floats,
                 g: tuple[float, float, float]) -> float:
    """A solid axle with its springs."""
    unit = unit_of(topo, i)
    us, w = unit_state(unit), unit_work(unit)
    a, s = axle_params(topo, i), axle_state(topo, i)
    ex, ey, ez = heading_axes(work, w)
    rx, rz = p[a + AXLE.x_m], p[a + AXLE.roll_centre_z_m]
    v = point_velocity(x, us, rx, 0.0, rz)
    at = to_map(work, w, rx, 0.0, rz)
    m, roll_rate = p[a + AXLE.mass_kg], x[s + AXLE_S.roll_rate_radps]
    above = x[s + AXLE_S.z_m] - x[us + UNIT_S.z_m] - at[2]
    along = v[0] * ex[0] + v[1] * ex[1] + v[2] * ex[2]
    across = v[0] * ey[0] + v[1] * ey[1] + v[2] * ey[2] - above * roll_rate
    turn = (x[us + UNIT_S.p_radps] * ez[0] + x[us + UNIT_S.q_radps] * ez[1]
            + x[us + UNIT_S.r_radps] * ez[2])
    vz = x[s + AXLE_S.vz_mps]
    total = 0.5 * m * (along * along + across * across + vz * vz)
    total += 0.5 * p[a + AXLE.ixx_kgm2] * roll_rate * roll_rate
    total += 0.5 * p[a + AXLE.izz_kgm2] * turn * turn
    total -= m * (g[0] * (x[us + UNIT_S.x_m] + at[0]) + g[1] * (x[us + UNIT_S.y_m] + at[1])
                  + g[2] * x[s + AXLE_S.z_m])
    left, right, lean = _travels(x, p, topo, i, work)
    return (total + _spring_energy(p, a, left) + _spring_energy(p, a, right)
            + 0.5 * p[a + AXLE.aux_roll_nmprad] * lean * lean)


@core
def _travels(x: Floats, p: Floats, topo: Integers, i: int, work: Floats
             ) -> tuple[float, float, float]:
    """Spring compressions left and right after the equaliser [m], and body lean [rad]."""
    unit = unit_of(topo, i)
    us, w = unit_state(unit), unit_work(unit)
    a, s = axle_params(topo, i), axle_state(topo, i)
    twist = x[us + UNIT_S.twist_front_rad + frame_end(p, a)]
    left = suspension.travel_m(x, us, work, w, p, a, s, 1.0, twist)
    right = suspension.travel_m(x, us, work, w, p, a, s, -1.0, twist)
    lean = 0.5 * (left - right) / p[a + AXLE.half_spacing_m]
    partner = partner_of(topo, i)
    if partner >= 0:
        pa, ps = axle_params(topo, partner), axle_state(topo, partner)
        left = suspension.equalised_m(
            p, a, left, suspension.travel_m(x, us, work, w, p, pa, ps, 1.0, twist))
        right = suspension.equalised_m(
            p, a, right, suspension.travel_m(x, us, work, w, p, pa, ps, -1.0, twist))
    return left, right, lean


@core
def _spring_energy(p: Floats, a: int, travel: float) -> float:
    """Integral of the elastic force of one side, stops included."""
    energy = p[a + AXLE.preload_n] * travel + 0.5 * p[a + AXLE.spring_npm] * travel * travel
    if travel > p[a + AXLE.jounce_m]:
        energy += 0.5 * p[a + AXLE.stop_npm] * (travel - p[a + AXLE.jounce_m]) ** 2
    elif travel < -p[a + AXLE.rebound_m]:
        energy += 0.5 * p[a + AXLE.stop_npm] * (travel + p[a + AXLE.rebound_m]) ** 2
    return energy
