"""Combined-slip Magic Formula of a truck tire, with load and pressure dependence.

References: Pacejka, Tire and Vehicle Dynamics; reduced set fitted to Goodyear/Calspan data at four
pressures and the 315/80R22.5 book set (docs/physics.md, "Tires").
Known limits: pressure dependence valid down to ``pressure_valid`` of the reference; trail held
above its largest (at 53 kN); no turn slip; combined slip by similarity, so peak friction is an
ellipse in force.
Validated with: test/physics/test_magic_formula.py (four loads, pressure, slopes, combined limits).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics.choose import seldom, where
from truck_blowout_sim.physics.jit import core
from truck_blowout_sim.physics.layout import TIRE
from truck_blowout_sim.physics.scalar import two_ratios
from truck_blowout_sim.physics.trig import arctan, arctans, cosine, sine

Floats = NDArray[np.float64]
_LEAST_SLIP = 1e-9  # below it the curve is its tangent


@core
def cornering_stiffness_nprad(p: Floats, t: int, fz_n: float, inflation: float) -> float:
    """K_ya [N/rad] at load ``fz_n`` and gauge pressure fraction ``inflation``.

    K = s pK1 Fz0 (a + (1-a) q) sin(2 atan(Fz / (pK2 Fz0 (b + (1-b) q)))).
    """
    q = max(inflation, p[t + TIRE.pressure_valid])
    fz0 = p[t + TIRE.reference_load_n]
    floor_1, floor_2 = p[t + TIRE.cornering_floor_1], p[t + TIRE.cornering_floor_2]
    load = p[t + TIRE.cornering_load] * fz0 * (floor_2 + (1.0 - floor_2) * q)
    peak = p[t + TIRE.cornering_peak] * fz0 * (floor_1 + (1.0 - floor_1) * q)
    # sin(2 atan(a / b)) = 2 a b / (a^2 + b^2)
    return p[t + TIRE.cornering_scale] * peak * 2.0 * fz_n * load / (fz_n * fz_n + load * load)


@core
def shape(slip: float, c: float, e: float) -> float:
    """sin(C atan(x - E (x - atan x))) with x = slip / C: unit slope at the origin."""
    return shapes(slip, c, e, c, e)[0]


@core
def shapes(slip: float, c_x: float, e_x: float, c_y: float, e_y: float) -> tuple[float, float]:
    """`shape` along and across: the two share their divisions."""
    x, y = two_ratios(slip, c_x, slip, c_y)
    bend_x, bend_y = arctans(x, y)
    bend_x, bend_y = arctans(x - e_x * (x - bend_x), y - e_y * (y - bend_y))
    return sine(c_x * bend_x), sine(c_y * bend_y)


@core
def pneumatic_trail_m(p: Floats, t: int, fz_n: float, inflation: float, slip_tan: float,
                      alpha: float) -> float:
    """Trail [m] at a slip angle [rad] and its tangent; Mz = -trail * Fy."""
    q = max(inflation, p[t + TIRE.pressure_valid])
    ratio = fz_n / p[t + TIRE.reference_load_n]
    level, slope = p[t + TIRE.trail_0], p[t + TIRE.trail_load]
    # load times trail is a parabola: beyond its vertex there are no data, so it is held there
    beyond = 2.0 * slope * ratio > level + slope
    if seldom(beyond):
        ratio = where(beyond, 0.5 * (level + slope) / slope, ratio)
    base = level - slope * (ratio - 1.0)
    stretch = 1.0 + p[t + TIRE.trail_pressure] * (1.0 - q)
    decay = cosine(p[t + TIRE.trail_shape] * arctan(p[t + TIRE.trail_stretch] * alpha))
    # cos(atan z) = 1 / sqrt(1 + z^2)
    leaning = math.sqrt(1.0 + slip_tan * slip_tan)
    return p[t + TIRE.unloaded_radius_m] * ratio * base * stretch * decay / leaning


@core
def limits(p: Floats, t: int, fz_n: float, friction: float, axle_peak: float
           ) -> tuple[float, float, float]:
    """Peak forces along and across [N], and slope of the longitudinal force over slip [N].

    ``axle_peak`` scales the lateral peak alone.
    """
    d = fz_n / p[t + TIRE.reference_load_n] - 1.0
    load = friction * p[t + TIRE.friction_scale] * fz_n
    return (max(p[t + TIRE.peak_x] - p[t + TIRE.peak_x_load] * d, 0.1) * load,
            max(p[t + TIRE.peak_y] - p[t + TIRE.peak_y_load] * d, 0.1) * axle_peak * load,
            max(p[t + TIRE.slip_stiffness] - p[t + TIRE.slip_stiffness_load] * d, 1.0) * fz_n)


@core
def combined(slip: float, slip_tan: float, grips: tuple[float, float]) -> tuple[float, float]:
    """Slip angle [rad], and combined slip in which both curves of the force are; never zero.

    ``grips``: slopes of the forces over slip [N], along and across, divided by their peaks.
    """
    alpha = arctan(slip_tan)
    sx, sy = grips[0] * slip, grips[1] * alpha
    return alpha, max(math.sqrt(sx * sx + sy * sy), _LEAST_SLIP)


@core
def forces(p: Floats, t: int, fz_n: float, inflation: float, slip: float, slip_tan: float,
           alpha: float, total: float, slopes: tuple[float, float], bent: tuple[float, float]
           ) -> tuple[float, float, float]:
    """Longitudinal and lateral force [N] and aligning moment [N m], rolling forward.

    ``slip`` and ``slip_tan`` are the lagged longitudinal slip and the lagged -vy/|vx|: a positive
    ``slip_tan`` gives a force to the left. ``alpha``, ``total``: of `combined`; ``slopes``: of the
    forces over slip [N], along and across (K_ya); ``bent``: the `shapes` at ``total``.
    """
    fx = slopes[0] * slip * bent[0] / total
    fy = slopes[1] * alpha * bent[1] / total
    return fx, fy, -pneumatic_trail_m(p, t, fz_n, inflation, slip_tan, alpha) * fy
