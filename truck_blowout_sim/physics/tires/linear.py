"""Linear tire: force proportional to slip, capped by friction, no aligning moment.

With ``saturation`` s > 0 the lateral force levels off: F_y = (mu F_z / s) tanh(s C alpha / mu F_z).
The slope at the origin stays C; s = 0 is the straight line.

References: the linear single-track model (Riekert and Schunck 1940).
Known limits: no load dependence of the stiffness; cap by the friction circle only.
Validated with: test/physics/test_linear_tire.py.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics.choose import any_of, where
from truck_blowout_sim.physics.jit import core
from truck_blowout_sim.physics.layout import TIRE
from truck_blowout_sim.physics.trig import arctan

Floats = NDArray[np.float64]


@core
def limit_n(p: Floats, t: int, fz_n: float, friction: float, axle_peak: float) -> float:
    """Most force [N] in any direction."""
    return p[t + TIRE.peak_y] * p[t + TIRE.friction_scale] * friction * axle_peak * fz_n


@core
def forces(p: Floats, t: int, fz_n: float, slip: float, slip_tan: float, friction: float,
           axle_peak: float, cornering: float) -> tuple[float, float, float]:
    """Longitudinal and lateral force [N]; the aligning moment is zero."""
    fx = p[t + TIRE.linear_slip_n] * slip
    fy = cornering * arctan(slip_tan)
    sharpness = p[t + TIRE.saturation]
    limit = limit_n(p, t, fz_n, friction, axle_peak)
    bends = (sharpness > 0.0) & (limit > 0.0)
    if any_of(bends):
        level = friction * axle_peak * fz_n / sharpness
        fy = where(bends, level * math.tanh(fy / level), fy)
    size = math.sqrt(fx * fx + fy * fy)
    kept = where(size > limit, limit / size, 1.0)
    return fx * kept, fy * kept, 0.0
