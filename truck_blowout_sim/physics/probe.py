"""A wrench of unknown origin on a unit: what a diagnosis finds before it can name a cause.

Constant over an interval, plus two plain laws that hold throughout: a lateral force proportional to
yaw rate times speed, and a drag proportional to speed. All zero in a vehicle that is understood.

References: none; the input of an augmented-state smoother.
Known limits: acts at base_link, in the road plane.
Validated with: test/physics/test_probe.py (impulse, interval, lever).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics.body import add_force, add_moment
from truck_blowout_sim.physics.jit import core
from truck_blowout_sim.physics.layout import UNIT, UNIT_S
from truck_blowout_sim.physics.scalar import ramp

Floats = NDArray[np.float64]


@core
def add_probe(x: Floats, s: int, p: Floats, a: int, work: Floats, w: int) -> None:
    """Add the unexplained wrench of the unit at state ``s``, parameters ``a``, work ``w``."""
    side = p[a + UNIT.probe_fy_law_npmps2]
    drag = p[a + UNIT.probe_fx_law_nspm]
    timed = p[a + UNIT.probe_start_s] <= x[0]
    if not timed and side == 0.0 and drag == 0.0:
        return
    share = 0.0
    if timed:
        share = ramp(x[0] + 1e-9, p[a + UNIT.probe_start_s], p[a + UNIT.probe_end_s],
                     p[a + UNIT.probe_ramp_s])
    speed = x[s + UNIT_S.u_mps]
    fx = share * p[a + UNIT.probe_fx_n] - drag * speed
    fy = share * p[a + UNIT.probe_fy_n] + side * speed * x[s + UNIT_S.r_radps]
    add_force(work, w, (fx, fy, 0.0),
              (p[a + UNIT.base_x_m], p[a + UNIT.base_y_m], p[a + UNIT.base_z_m]))
    add_moment(work, w, 0.0, 0.0, share * p[a + UNIT.probe_mz_nm])
