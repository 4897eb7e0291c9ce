"""Tire forces: five families over a generalized slip, first-order dynamics.

References: Rill, Road Vehicle Dynamics (2012), ch. 3 (TMeasy); Pacejka, Tire and Vehicle Dynamics
(2012), ch. 3 (brush), 4.3 (Magic Formula, similarity); Dugoff, Fancher, Segel, SAE 700377 (1970);
Burckhardt, Fahrwerktechnik: Radschlupf-Regelsysteme (1993), dry asphalt (c1, c2, c3); cornering
stiffness after the spec sheet.
Known differences from a real tire: no temperature, no tread wear, no turn slip.
"""

from __future__ import annotations

import math

from proving_ground.compiled import compiled
from proving_ground.laws import (
    BURCKHARDT,
    DUGOFF,
    LENGTH,
    LOADED,
    MAGIC,
    POWER,
    SINE,
    TMEASY,
    Laws,
)

C1, C2, C3 = 1.2801, 23.99, 0.52   # Burckhardt, dry asphalt
_TOP_SLIP = math.log(C1 * C2 / C3) / C2
TOP = C1 * (1.0 - math.exp(-C2 * _TOP_SLIP)) - C3 * _TOP_SLIP
START = C1 * C2 - C3               # slope of that curve at no slip
STATED_LOAD_N = 26.5e3       # load at which POWER and SINE have their reference slope


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
def cornering_slope(load: float, fill: float, laws: Laws) -> float:
    """Cornering stiffness, N/rad; softer gas gives a stiffer short contact."""
    if laws.slope_law == POWER:
        base = laws.slope_reference * (load / STATED_LOAD_N) ** laws.slope_shape
    elif laws.slope_law == SINE:
        base = laws.slope_reference * (
            math.sin(2.0 * math.atan(load / laws.slope_shape))
            / math.sin(2.0 * math.atan(STATED_LOAD_N / laws.slope_shape)))
    else:
        base = load * (laws.slope - laws.slope_drop * load)
    soft = 1.0 - fill
    return base * (1.0 + laws.soft_gain * soft * (1.0 - 0.012e-3 * load)
                   - laws.soft_loss * soft * soft)


@compiled
def steady_forces(load: float, sx: float, sy: float, slope_y: float, friction: float,
                  peak_y_scale: float, laws: Laws) -> tuple[float, float, float]:
    """Steady (fx, fy) in newtons and the trail fraction left, from slip along and across."""
    over = load / laws.reference_n - 1.0
    slope_x = load * (laws.slope_x - laws.slope_x_drop * over)
    peak_x = friction * load * (laws.peak_x - laws.peak_x_drop * over)
    peak_y = friction * load * (laws.peak_y - laws.peak_y_drop * over) * peak_y_scale
    if laws.family != TMEASY:
        fx, fy = similar(sx, sy, slope_x, slope_y, peak_x, peak_y, laws)
        return fx, fy, trail_fraction(abs(sy) * (0.20 / laws.trail_zero))
    at_x = max(laws.slip_x, 2.05 * peak_x / slope_x)
    at_y = max(laws.slip_y, 2.05 * peak_y / max(slope_y, 1.0))
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
    slide = math.sqrt((laws.slide_x * peak_x * c) ** 2 + (laws.slide_y * peak_y * s) ** 2)
    force = steady_curve(slip, slope, at, peak, max(slide_at, 1.2 * at), slide)
    return force * c, force * s, trail_fraction(abs(sy) * (0.20 / laws.trail_zero))


@compiled
def similar(sx: float, sy: float, slope_x: float, slope_y: float, peak_x: float, peak_y: float,
            laws: Laws) -> tuple[float, float]:
    """Any other family over the slip that similarity makes of both directions, N."""
    kx = slope_x * sx / max(peak_x, 1.0)
    ky = slope_y * sy / max(peak_y, 1.0)
    k = math.sqrt(kx * kx + ky * ky)
    if k < 1.0e-9:
        return 0.0, 0.0
    if laws.family == MAGIC:
        b = k / laws.shape
        share = math.sin(laws.shape * math.atan(b - laws.curvature * (b - math.atan(b))))
    elif laws.family == DUGOFF:
        share = k if k < 0.5 else 1.0 - 0.25 / k
    elif laws.family == BURCKHARDT:
        slip = min(k * TOP / START, 1.0)
        share = (C1 * (1.0 - math.exp(-C2 * slip)) - C3 * slip) / TOP
    elif k < 3.0:
        share = k - k * k / 3.0 + k * k * k / 27.0
    else:
        share = laws.slide_y + (1.0 - laws.slide_y) * math.exp(-(k - 3.0) / 4.0)
    return share * peak_x * kx / k, share * peak_y * ky / k


@compiled
def relaxation_length(load: float, slope: float, slip: float, laws: Laws) -> float:
    """Rolled length over which the lateral force follows its slip, m."""
    if laws.relaxation_law == LENGTH:
        length = laws.relaxation
    elif laws.relaxation_law == LOADED:
        length = laws.relaxation * (load / STATED_LOAD_N) ** laws.relaxation_exponent
    else:
        length = slope / laws.relaxation
    if laws.relaxation_shrinks > 0.0:
        length *= 1.0 - laws.relaxation_shrinks * min(1.0, abs(slip) / 0.2)
    return length


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
