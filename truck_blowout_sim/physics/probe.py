"""A wrench of unknown origin on a unit: what a diagnosis finds before it can name a cause.

Constant over an interval, plus plain laws that hold throughout: each of Fx, Fy and Mz as a sum of
terms in speed, speed squared, yaw rate times speed, and roll. All zero in a vehicle that is
understood.

References: none; the input of an augmented-state smoother.
Known limits: acts at base_link, in the road plane; roll is that of the body on its road.
Validated with: test/physics/test_probe.py (impulse, interval, lever, every law).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics.body import add_force, add_moment
from truck_blowout_sim.physics.choose import any_of, where
from truck_blowout_sim.physics.jit import core
from truck_blowout_sim.physics.layout import UNIT, UNIT_S
from truck_blowout_sim.physics.scalar import ramp, reached

Floats = NDArray[np.float64]


@core
def add_probe(x: Floats, s: int, p: Floats, a: int, work: Floats, w: int) -> None:
    """Add the unexplained wrench of the unit at state ``s``, parameters ``a``, work ``w``."""
    fx = _law(x, s, p, a + UNIT.probe_fx_v_nspm)
    fy = _law(x, s, p, a + UNIT.probe_fy_v_nspm)
    mz = _law(x, s, p, a + UNIT.probe_mz_v_ns)
    begun = reached(x[0], p[a + UNIT.probe_start_s])
    if any_of(begun):
        share = where(begun, ramp(x[0], p[a + UNIT.probe_start_s], p[a + UNIT.probe_end_s],
                                  p[a + UNIT.probe_ramp_s]), 0.0)
        fx += share * p[a + UNIT.probe_fx_n]
        fy += share * p[a + UNIT.probe_fy_n]
        mz += share * p[a + UNIT.probe_mz_nm]
    if not any_of((fx != 0.0) | (fy != 0.0) | (mz != 0.0)):
        return
    add_force(work, w, (fx, fy, 0.0),
              (p[a + UNIT.base_x_m], p[a + UNIT.base_y_m], p[a + UNIT.base_z_m]))
    add_moment(work, w, 0.0, 0.0, mz)


@core
def _law(x: Floats, s: int, p: Floats, first: int) -> float:
    """One component of the laws whose four factors begin at ``first``."""
    speed = x[s + UNIT_S.u_mps]
    return (p[first] * speed + p[first + 1] * speed * speed
            + p[first + 2] * speed * x[s + UNIT_S.r_radps] + p[first + 3] * x[s + UNIT_S.roll_rad])
