"""Aerodynamic drag and side force of one unit, steady wind and a gust.

References: F = 0.5 rho A_d |v| v against the relative air; values with sources in
config/vehicles (the thesis has none). What a gust pushes back, a share of its side force, stands
for an axial force that changes with the air angle.
Known limits: the side force is linear in the air angle; no lift, no yaw damping of its own.
Validated with: test/physics/test_aero.py (square law, drag budget, head wind, line of action).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics.body import add_force
from truck_blowout_sim.physics.choose import any_of, where
from truck_blowout_sim.physics.jit import core
from truck_blowout_sim.physics.layout import UNIT, UNIT_S, UNIT_W, WORLD, WORLD_AT
from truck_blowout_sim.physics.scalar import ramp

Floats = NDArray[np.float64]


@core
def add_air(x: Floats, s: int, p: Floats, a: int, work: Floats, w: int) -> None:
    """Add drag and side force of the unit whose state, parameters, work start at s, a, w."""
    gust, side_x, side_z = p[a + UNIT.gust_mps], p[a + UNIT.side_x_m], p[a + UNIT.side_z_m]
    back = 0.0
    if any_of(gust != 0.0):
        gust *= ramp(x[0], p[a + UNIT.gust_start_s], p[a + UNIT.gust_end_s],
                     p[a + UNIT.gust_ramp_s])
        side_x += where(gust != 0.0, p[a + UNIT.gust_ahead_m], 0.0)
        side_z += where(gust != 0.0, p[a + UNIT.gust_up_m], 0.0)
        back = where(gust != 0.0, p[a + UNIT.gust_drag_share], 0.0)
    wind_x = p[WORLD_AT + WORLD.wind_x_mps]
    wind_y = p[WORLD_AT + WORLD.wind_y_mps] + gust
    cy, sy = work[w + UNIT_W.cos_yaw], work[w + UNIT_W.sin_yaw]
    vx = x[s + UNIT_S.u_mps] - (cy * wind_x + sy * wind_y)
    vy = x[s + UNIT_S.v_mps] - (cy * wind_y - sy * wind_x)
    pressure = 0.5 * p[WORLD_AT + WORLD.air_density_kgpm3] * math.sqrt(vx * vx + vy * vy)
    area = p[a + UNIT.drag_area_m2] + p[a + UNIT.drag_area_extra_m2]
    add_force(work, w, (-pressure * area * vx, 0.0, 0.0), (0.0, 0.0, p[a + UNIT.drag_z_m]))
    push = -pressure * p[a + UNIT.side_area_m2] * vy
    add_force(work, w, (-back * abs(push), push, 0.0), (side_x, 0.0, side_z))
