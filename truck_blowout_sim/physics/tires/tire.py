"""All tires of a truck in one pass: load, slip, forces, moments, at whatever state of inflation.

References: Pacejka, Tire and Vehicle Dynamics, chapter 5; `string`, `blowout`, `magic_formula`.
Known limits: camber thrust without lag, none on map tires; a standing tire has no trail.
Validated with: test/physics/test_tire.py (steady state, relaxation length, standing spring, flat,
trail in reverse); test/physics/test_lanes.py (lanes do not touch each other).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics.choose import seldom, shared, trucks_in, where
from truck_blowout_sim.physics.jit import core
from truck_blowout_sim.physics.layout import TIRE, TIRE_BLOCK, TIRE_LANES
from truck_blowout_sim.physics.scalar import clip, two_ratios
from truck_blowout_sim.physics.tires import blowout, linear, lookup_map, magic_formula
from truck_blowout_sim.physics.tires.lanes import LANE, LANE_BLOCK, whole_vectors
from truck_blowout_sim.physics.tires.string import kept_share, lag

Floats = NDArray[np.float64]
MAGIC_FORMULA, LOOKUP_MAP, LINEAR = 0.0, 1.0, 2.0  # TIRE.model
STANDSTILL_MPS = 0.5  # below it the string gets a damper, so that a standing truck does not ring
_STANDSTILL_DAMPING = 0.2  # slip per m/s
_LEAST_SLOPE_N = 1.0  # of a tire without load, whose damper has nothing to hold
_STILL_RADPS = 0.5  # rolling resistance fades below this spin


@core
def tire_pass(p: Floats, tires_at: int, table_at: int, lanes: Floats, n_tires: int, dt: float
              ) -> None:
    """Advance slips and fill forces of all tires, whose inputs stand in ``lanes``."""
    done, t, w = 0, tires_at, 0
    while done < n_tires:
        n = min(n_tires - done, TIRE_LANES)
        wide = n if trucks_in(lanes) > 1 else whole_vectors(n)
        for k in range(wide):
            carry(p, t + k, lanes, w + k)
        for k in range(wide):
            stretch(p, t + k, lanes, w + k, dt)
        formula_pass(p, t, lanes, w, wide)
        others_pass(p, t, table_at, lanes, w, n)
        for k in range(wide):
            soften(p, t + k, lanes, w + k)
        done, t, w = done + n, t + TIRE_BLOCK, w + LANE_BLOCK


@core
def formula_pass(p: Floats, t: int, lanes: Floats, w: int, wide: int) -> None:
    """Magic Formula forces of ``wide`` tires, in loops so short that several tires overlap.

    A processor looks a few hundred instructions ahead; a tire's wait for each other.
    """
    for k in range(wide):
        if takes_formula(p, t + k, lanes):
            combine(lanes, w + k)
    for k in range(wide):
        if takes_formula(p, t + k, lanes):
            bend(p, t + k, lanes, w + k)
    for k in range(wide):
        if takes_formula(p, t + k, lanes):
            magic_formula_forces(p, t + k, lanes, w + k)


@core
def takes_formula(p: Floats, t: int, lanes: Floats) -> bool:
    """Whether a tire is worked by the Magic Formula: of one truck all, the others' result unused.

    Its tires stand in vectors, which a branch would break up.
    """
    return trucks_in(lanes) == 1 or shared(p[t + TIRE.model]) == MAGIC_FORMULA


@core
def others_pass(p: Floats, t: int, table_at: int, lanes: Floats, w: int, n: int) -> None:
    """Forces of those of ``n`` tires that are map tires or linear ones."""
    others = 0.0
    for k in range(n):
        others += shared(p[t + k + TIRE.model])
    if others > MAGIC_FORMULA:
        for k in range(n):
            if shared(p[t + k + TIRE.model]) != MAGIC_FORMULA:
                other_forces(p, t + k, table_at, lanes, w + k)


@core
def tire_at_load(p: Floats, t: int, table_at: int, lanes: Floats, w: int, dt: float) -> None:
    """As `tire_pass`, for one tire whose load, rolling radius and rim contact stand in its lane."""
    fill_inflation(p, t, lanes, w)
    stretch(p, t, lanes, w, dt)
    if shared(p[t + TIRE.model]) == MAGIC_FORMULA:
        combine(lanes, w)
        bend(p, t, lanes, w)
        magic_formula_forces(p, t, lanes, w)
    else:
        other_forces(p, t, table_at, lanes, w)
    soften(p, t, lanes, w)


@core
def fill_inflation(p: Floats, t: int, lanes: Floats, w: int) -> None:
    """How far the tire in lane ``w`` is inflated, see `blowout.inflated`."""
    lanes[w + LANE.inflation], lanes[w + LANE.collapse] = blowout.inflated(
        p, t, lanes[w + LANE.pressure_pa])


@core
def carry(p: Floats, t: int, lanes: Floats, w: int) -> None:
    """Rim contact, vertical load, radius and rolling resistance of the tire in lane ``w``."""
    stepped = lanes[w + LANE.stepped] > 0.0
    gauge, above = lanes[w + LANE.pressure_pa], lanes[w + LANE.above_m]
    rim = where(stepped, 0.0, blowout.rim_fraction(p, t, above))
    row_radius, row_free, row_stiffness, row_rolling = 0.0, 0.0, 1.0, 0.0
    if seldom(stepped):
        row_radius, row_free = lanes[w + LANE.row_radius_m], lanes[w + LANE.row_free_m]
        row_stiffness = lanes[w + LANE.row_stiffness_npm]
        row_rolling = lanes[w + LANE.row_rolling]
    fz, deflection = blowout.vertical_load(p, t, gauge, above, lanes[w + LANE.sink_mps], stepped,
                                           row_free, row_stiffness)
    radius = blowout.rolling_radius_m(p, t, deflection, rim)
    radius = where(stepped, row_radius, radius)
    fill_inflation(p, t, lanes, w)
    f = blowout.rolling_coefficient(p, t, lanes[w + LANE.collapse], deflection, rim,
                                    abs(lanes[w + LANE.vx_mps]), lanes[w + LANE.softness])
    f = where(stepped, row_rolling, f)
    lanes[w + LANE.rim] = rim
    lanes[w + LANE.fz_n] = fz
    lanes[w + LANE.radius_m] = radius
    lanes[w + LANE.rolling_nm] = f * fz * radius * clip(
        lanes[w + LANE.spin_radps] / _STILL_RADPS, -1.0, 1.0)


@core
def stretch(p: Floats, t: int, lanes: Floats, w: int, dt: float) -> None:
    """Advance the slips of the tire in lane ``w`` by ``dt``; see `string`."""
    vx, slide_y = lanes[w + LANE.vx_mps], -lanes[w + LANE.vy_mps]
    slide_x = lanes[w + LANE.spin_radps] * lanes[w + LANE.radius_m] - vx
    fz, rim = lanes[w + LANE.fz_n], lanes[w + LANE.rim]
    road, axle_peak = lanes[w + LANE.friction], lanes[w + LANE.axle_peak]
    straight = p[t + TIRE.model] == LINEAR
    bent = magic_formula.cornering_stiffness_nprad(p, t, fz, lanes[w + LANE.inflation])
    cornering = p[t + TIRE.linear_cornering_nprad] * p[t + TIRE.cornering_scale]
    cornering = where(straight, cornering, bent)
    peak_x, peak_y, slope_x = magic_formula.limits(p, t, fz, road, axle_peak)
    limit = linear.limit_n(p, t, fz, road, axle_peak)
    peak_x, peak_y = where(straight, limit, peak_x), where(straight, limit, peak_y)
    slope_x = where(straight, p[t + TIRE.linear_slip_n], slope_x)
    side, along = p[t + TIRE.lateral_stiffness_npm], p[t + TIRE.longitudinal_stiffness_npm]
    bend = max(cornering + rim * (p[t + TIRE.flat_relaxation_m] * side - cornering), 0.02 * side)
    pull = max(fz * p[t + TIRE.slip_stiffness], 0.05 * along)
    up_x, down_x = lag(lanes[w + LANE.slip], vx, slide_x, pull, along, dt)
    up_y, down_y = lag(lanes[w + LANE.slip_tan], vx, slide_y, bend * p[t + TIRE.relaxation_scale],
                       side, dt)
    slip, tan = two_ratios(up_x, down_x, up_y, down_y)
    slip, tan = clip(slip, -1.0, 1.0), clip(tan, -3.0, 3.0)
    grip, grip_tan = two_ratios(slope_x, peak_x, cornering, peak_y)
    kept = kept_share(slip, tan, grip, grip_tan, slide_x, slide_y, vx)
    kept = where(peak_x > 0.0, kept, 1.0)
    slip, tan = kept * slip, kept * tan
    lanes[w + LANE.slip] = slip
    lanes[w + LANE.slip_tan] = tan
    damping = lanes[w + LANE.damping_spm]
    lanes[w + LANE.force_slip] = clip(slip + damping * slide_x, -1.0, 1.0)
    lanes[w + LANE.force_slip_tan] = clip(tan + damping * slide_y, -3.0, 3.0)
    lanes[w + LANE.slope_n], lanes[w + LANE.cornering_nprad] = slope_x, cornering
    lanes[w + LANE.grip], lanes[w + LANE.grip_tan] = grip, grip_tan
    lanes[w + LANE.peak_tan_n] = peak_y
    lanes[w + LANE.soft] = max(rim, lanes[w + LANE.collapse])


@core
def standstill_damping_spm(p: Floats, t: int, vx_mps: float, fz: float, inertia_kgm2: float,
                           dt: float) -> float:
    """Slip that the damper adds per slip speed [1 per m/s], 0 from `STANDSTILL_MPS` on.

    ``inertia_kgm2``: the tire's part of its hub's. The damper takes at most the whole slip speed of
    the wheel in a step: with more the wheel would chatter.
    """
    slope = magic_formula.limits(p, t, fz, 1.0, 1.0)[2]
    slope = where(p[t + TIRE.model] == LINEAR, p[t + TIRE.linear_slip_n], slope)
    radius = p[t + TIRE.unloaded_radius_m]
    whole = inertia_kgm2 / (dt * max(slope, _LEAST_SLOPE_N) * radius * radius)
    return min(whole, _STANDSTILL_DAMPING) * max(1.0 - abs(vx_mps) / STANDSTILL_MPS, 0.0)


@core
def combine(lanes: Floats, w: int) -> None:
    """The slips of the tire in lane ``w`` as one."""
    lanes[w + LANE.slip_angle_rad], lanes[w + LANE.total] = magic_formula.combined(
        lanes[w + LANE.force_slip], lanes[w + LANE.force_slip_tan],
        (lanes[w + LANE.grip], lanes[w + LANE.grip_tan]))


@core
def bend(p: Floats, t: int, lanes: Floats, w: int) -> None:
    """The Magic Formula's curves at the combined slip."""
    lanes[w + LANE.shape], lanes[w + LANE.shape_tan] = magic_formula.shapes(
        lanes[w + LANE.total], p[t + TIRE.shape_x], p[t + TIRE.curvature_x],
        p[t + TIRE.shape_y], p[t + TIRE.curvature_y])


@core
def magic_formula_forces(p: Floats, t: int, lanes: Floats, w: int) -> None:
    """Forces of the tire in lane ``w`` while it is whole."""
    fx, fy, mz = magic_formula.forces(
        p, t, lanes[w + LANE.fz_n], lanes[w + LANE.inflation], lanes[w + LANE.force_slip],
        lanes[w + LANE.force_slip_tan], lanes[w + LANE.slip_angle_rad], lanes[w + LANE.total],
        (lanes[w + LANE.slope_n], lanes[w + LANE.cornering_nprad]),
        (lanes[w + LANE.shape], lanes[w + LANE.shape_tan]))
    lanes[w + LANE.fx_n], lanes[w + LANE.fy_n], lanes[w + LANE.mz_nm] = fx, fy, mz


@core
def other_forces(p: Floats, t: int, table_at: int, lanes: Floats, w: int) -> None:
    """As `magic_formula_forces`, of a map tire or a linear one."""
    fz, road = lanes[w + LANE.fz_n], lanes[w + LANE.friction]
    slip, tan = lanes[w + LANE.force_slip], lanes[w + LANE.force_slip_tan]
    if shared(p[t + TIRE.model]) == LOOKUP_MAP:
        at = table_at + int(shared(p[t + TIRE.map_table]))
        fx, fy, mz = lookup_map.forces(p, t, at, fz, slip, tan, road, lanes[w + LANE.axle_peak])
    else:
        fx, fy, mz = linear.forces(p, t, fz, slip, tan, road, lanes[w + LANE.axle_peak],
                                   lanes[w + LANE.cornering_nprad])
    lanes[w + LANE.fx_n], lanes[w + LANE.fy_n], lanes[w + LANE.mz_nm] = fx, fy, mz


@core
def soften(p: Floats, t: int, lanes: Floats, w: int) -> None:
    """What is left of the forces of a tire that loses its air; camber thrust; side of the trail."""
    stepped, soft = lanes[w + LANE.stepped] > 0.0, lanes[w + LANE.soft]
    fz, mapped = lanes[w + LANE.fz_n], p[t + TIRE.model] == LOOKUP_MAP
    flat = 1.0 - soft * (1.0 - p[t + TIRE.flat_cornering] * p[t + TIRE.flat_cornering_scale])
    trail = 1.0 - soft * (1.0 - p[t + TIRE.flat_trail])
    if seldom(stepped):
        flat = where(stepped, lanes[w + LANE.row_cornering], flat)
        trail = where(stepped, lanes[w + LANE.row_aligning], trail)
    # the contact trails behind the wheel: on the other side of it in reverse
    trail *= clip(lanes[w + LANE.vx_mps] / STANDSTILL_MPS, -1.0, 1.0)
    camber = p[t + TIRE.camber_gain] * (1.0 - soft * (1.0 - p[t + TIRE.flat_camber]))
    camber = where(mapped, 0.0, camber)
    limit = where(mapped, np.inf, flat * lanes[w + LANE.peak_tan_n])
    fy = clip(lanes[w + LANE.fy_n] * flat + camber * fz * lanes[w + LANE.sin_camber], -limit, limit)
    # no load, no force
    lanes[w + LANE.fx_n] = where(fz > 0.0, lanes[w + LANE.fx_n], 0.0)
    lanes[w + LANE.fy_n] = where(fz > 0.0, fy, 0.0)
    lanes[w + LANE.mz_nm] = where(fz > 0.0, lanes[w + LANE.mz_nm] * trail, 0.0)
