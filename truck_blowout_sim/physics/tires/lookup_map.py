"""Lookup-map tire: lateral force and aligning moment over slip angle and load.

The form of the commercial simulator's dataset (thesis section 3.3.1, figures 18-21).

References: thesis L691-L711.
Known limits: bilinear, held constant beyond the last slip angle, linear in load below the first
row; the longitudinal part is the Magic Formula's, joined by a friction ellipse; no
camber thrust, no pressure dependence of its own.
Validated with: test/physics/test_lookup_map.py (nodes, midpoints, scaling).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics.choose import pick, shared, where, whole
from truck_blowout_sim.physics.jit import core
from truck_blowout_sim.physics.layout import TIRE
from truck_blowout_sim.physics.scalar import clip
from truck_blowout_sim.physics.tires.magic_formula import limits, shape
from truck_blowout_sim.physics.trig import arctan

Floats = NDArray[np.float64]


@core
def interpolate(p: Floats, at: int, which: int, slip_rad: float, fz_n: float) -> float:
    """Value of map ``which`` (0 lateral force, 1 aligning moment) at |slip| and load."""
    n_slip, n_load = int(shared(p[at])), int(shared(p[at + 1]))
    s = clip(slip_rad / p[at + 2], 0.0, n_slip - 1.0)
    f = clip(fz_n / p[at + 3], 0.0, n_load - 1.0)
    i = min(whole(s), n_slip - 2)
    j = min(whole(f), n_load - 2)
    a, b = s - i, f - j
    k = at + 4 + which * n_slip * n_load + i * n_load + j
    low = pick(p, k) * (1.0 - b) + pick(p, k + 1) * b
    high = pick(p, k + n_load) * (1.0 - b) + pick(p, k + n_load + 1) * b
    return low * (1.0 - a) + high * a


@core
def forces(p: Floats, t: int, at: int, fz_n: float, slip: float, slip_tan: float,
           friction: float, axle_peak: float) -> tuple[float, float, float]:
    """Forces [N] and aligning moment [N m] of a whole tire, rolling forward."""
    peak_x, _, stiffness_x = limits(p, t, fz_n, friction, axle_peak)
    mu = friction * p[t + TIRE.friction_scale]
    fx = peak_x * shape(stiffness_x * slip / peak_x, p[t + TIRE.shape_x], p[t + TIRE.curvature_x])
    alpha = arctan(slip_tan)
    side = where(alpha >= 0.0, 1.0, -1.0)
    used = fx / peak_x
    rest = math.sqrt(max(1.0 - used * used, 0.0))
    fy = side * interpolate(p, at, 0, abs(alpha), fz_n) * mu * axle_peak * rest
    mz = -side * interpolate(p, at, 1, abs(alpha), fz_n) * rest
    return fx, fy, mz
