"""Tires side by side: what the pass over all tires of a truck reads and writes, lane by lane.

Lane k of a quantity stands beside lane k + 1 of it, a constant distance from every other quantity,
both here and in the tires' parameters. The compiler therefore turns one tire's arithmetic into
instructions for four or eight tires at once.

References: none, this is bookkeeping.
Known limits: at most ``layout.MAX_TIRES`` tires; packing refuses more.
Validated with: test/physics/test_lanes.py.
"""

from __future__ import annotations

from typing import NamedTuple

from numba.extending import register_jitable

from truck_blowout_sim.physics.layout import MAX_BLOCKS, TIRE_BLOCK, TIRE_LANES


class TireLanes(NamedTuple):
    """Quantities of one step; each holds ``TIRE_LANES`` tires."""

    # in
    vx_mps: int  # contact point, wheel axes
    vy_mps: int
    spin_radps: int
    above_m: int  # height of the wheel center above the road
    sink_mps: int  # rate of compression
    sin_camber: int
    friction: int  # scale of the road's
    axle_peak: int  # scale of the lateral peak
    pressure_pa: int
    softness: int  # factor of rolling resistance for low pressure
    stepped: int  # 1: a row of a step table rules the tire, the next six
    row_radius_m: int
    row_free_m: int  # radius without load
    row_stiffness_npm: int
    row_cornering: int
    row_aligning: int
    row_rolling: int
    arm_m: int  # lateral place on the axle
    cos_steer: int
    sin_steer: int
    damping_spm: int  # slip per slip speed, at standstill
    # in and out
    slip: int
    slip_tan: int
    # out
    rim: int
    fz_n: int
    radius_m: int  # rolling radius
    fx_n: int
    fy_n: int
    mz_nm: int
    rolling_nm: int
    # between the loops
    inflation: int  # of `blowout.inflated`
    collapse: int
    force_slip: int  # slips that make force, the standstill damper included
    force_slip_tan: int
    slope_n: int  # of the force over slip, along and across
    cornering_nprad: int
    grip: int  # these divided by the peaks of the force
    grip_tan: int
    peak_tan_n: int  # peak of the lateral force while the tire is whole
    soft: int
    slip_angle_rad: int
    total: int  # combined slip, in which both curves are
    shape: int  # the curves there, along and across
    shape_tan: int


LANE = TireLanes(*(k * TIRE_LANES for k in range(len(TireLanes._fields))))
LANE_BLOCK = len(LANE) * TIRE_LANES
N_LANES = MAX_BLOCKS * LANE_BLOCK
SIMD = 8  # widest vector; loops run over whole vectors


@register_jitable
def tire_offset(tire: int) -> int:
    """Place of a tire's first parameter behind that of the first tire's."""
    return (tire // TIRE_LANES) * TIRE_BLOCK + tire % TIRE_LANES


@register_jitable
def lane_offset(tire: int) -> int:
    """Place of a tire's first lane."""
    return (tire // TIRE_LANES) * LANE_BLOCK + tire % TIRE_LANES


@register_jitable
def whole_vectors(tires: int) -> int:
    """Number of lanes that hold this many tires in whole vectors."""
    return (tires + SIMD - 1) // SIMD * SIMD
