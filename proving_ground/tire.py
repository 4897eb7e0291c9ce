"""TMeasy tire forces: piecewise rational curves over a generalized slip, first-order dynamics.

References: Rill, Road Vehicle Dynamics (2012), ch. 3; cornering stiffness after the spec sheet.
Known differences from a real tire: no temperature, no tread wear, no turn slip.
"""

from __future__ import annotations

import math

from proving_ground.compiled import compiled

REFERENCE_N = 27.0e3


@compiled
def steady_curve(slip: float, slope: float, slip_peak: float, peak: float,
                 slip_slide: float, slide: float) -> float:
    """Force at a slip >= 0 (N): rational to the peak, cubic to sliding, constant after."""
    if slip <= slip_peak:
        s = slip / slip_peak
        return slope * slip / (1.0 + s * (s + slope * slip_peak / peak - 2.0))
    if slip >= slip_slide:
        return slide
    s = (slip - slip_peak) / (slip_slide - slip_peak)
    return peak - (peak - slide) * s * s * (3.0 - 2.0 * s)


@compiled
def cornering_slope(load: float, fill: float) -> float:
    """Cornering stiffness, N/rad: quadratic in load; softer gas gives a stiffer short contact."""
    quadratic = load * (7.40 - 3.604e-5 * load)
    soft = 1.0 - fill
    return quadratic * (1.0 + 0.62 * soft * (1.0 - 0.012e-3 * load) - 0.15 * soft * soft)


@compiled
def steady_forces(load: float, sx: float, sy: float, slope_y: float, friction: float,
                  peak_y_scale: float) -> tuple[float, float, float]:
    """Steady (fx, fy) in newtons and the trail fraction left, from longitudinal and lateral slip.

    The two curves are joined by the angle of the normalized slip vector.
    """
    over = load / REFERENCE_N - 1.0
    slope_x = load * (14.0 - 3.0 * over)
    peak_x = friction * load * (0.80 - 0.10 * over)
    peak_y = friction * load * (0.80 - 0.06 * over) * peak_y_scale
    at_x = max(0.13, 2.05 * peak_x / slope_x)
    at_y = max(0.27, 2.05 * peak_y / max(slope_y, 1.0))
    norm_x = at_x / (at_x + at_y) + (peak_x / slope_x) / (peak_x / slope_x + peak_y / slope_y)
    norm_y = at_y / (at_x + at_y) + (peak_y / slope_y) / (peak_x / slope_x + peak_y / slope_y)
    nx, ny = sx / norm_x, sy / norm_y
    slip = math.sqrt(nx * nx + ny * ny)
    if slip < 1.0e-9:
        return 0.0, 0.0, 1.0
    c, s = nx / slip, ny / slip
    slope = math.sqrt((slope_x * norm_x * c) ** 2 + (slope_y * norm_y * s) ** 2)
    at = math.sqrt((at_x / norm_x * c) ** 2 + (at_y / norm_y * s) ** 2)
    peak = math.sqrt((peak_x * c) ** 2 + (peak_y * s) ** 2)
    slide_at = math.sqrt((0.75 / norm_x * c) ** 2 + (0.85 / norm_y * s) ** 2)
    slide = math.sqrt((0.74 * peak_x * c) ** 2 + (0.76 * peak_y * s) ** 2)
    force = steady_curve(slip, slope, at, peak, max(slide_at, 1.2 * at), slide)
    return force * c, force * s, trail_fraction(abs(sy))


@compiled
def trail_fraction(slip: float) -> float:
    """Pneumatic trail over its value at rest: falls through zero at 0.20, small negative beyond."""
    if slip >= 0.34:
        return 0.0
    if slip >= 0.20:
        s = (slip - 0.20) / 0.14
        return -0.12 * s * (1.0 - s) * 4.0 * (1.0 - 0.5 * s)
    s = slip / 0.20
    return (1.0 - s) * (1.0 - s) * (1.0 + 0.6 * s)
