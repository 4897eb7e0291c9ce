"""Parameter block of one tire, units in the names.

Field positions become numbers in layout.py.

References: none, this is bookkeeping.
Known limits: see layout.py.
Validated with: test/physics/test_layout.py.
"""

from __future__ import annotations

from typing import NamedTuple


class TireParams(NamedTuple):
    """One tire."""

    y_m: int  # from the hub centre, left positive
    model: int  # 0 magic formula, 1 lookup maps, 2 linear
    law: int  # blowout law: 0 continuous, 1 table of steps
    table: int  # position of its map or step table in the tail of the parameter vector
    map_table: int
    unloaded_radius_m: int
    radius_offset_m: int  # rolling radius = unloaded - fraction * deflection + offset
    radius_fraction: int
    stiffness_npm: int  # structural part
    stiffness_npmppa: int  # per gauge pressure
    damping_nspm: int
    pressure_pa: int  # gauge, set cold
    reference_pressure_pa: int
    volume_m3: int
    flat_volume_fraction: int
    hole_area_m2: int  # CdA when blown
    hole_scale: int  # 1; what a diagnosis changes
    hole_opening_s: int  # 0; what a diagnosis changes
    polytropic: int
    blow_time_s: int  # inf: not by itself
    blow_hole_scale: int  # relative hole of a failure by itself
    reference_load_n: int
    friction_scale: int
    shape_y: int
    curvature_y: int
    peak_y: int
    peak_y_load: int
    cornering_peak: int  # pK1
    cornering_load: int  # pK2
    cornering_scale: int  # lug
    cornering_floor_1: int  # 0.74 of the pressure dependence of pK1
    cornering_floor_2: int  # 0.107 of the pressure dependence of pK2
    shape_x: int
    curvature_x: int
    peak_x: int
    peak_x_load: int
    slip_stiffness: int  # K_xk / Fz
    slip_stiffness_load: int
    lateral_stiffness_npm: int
    longitudinal_stiffness_npm: int
    relaxation_scale: int  # 1; what a diagnosis changes
    trail_0: int
    trail_load: int
    trail_pressure: int
    trail_shape: int
    trail_stretch: int
    camber_gain: int
    rolling_0: int
    rolling_spm: int  # per m/s
    rolling_pressure_exponent: int
    rim_radius_m: int  # carcass touches the rim: rho starts
    rim_span_m: int
    rim_contact_radius_m: int  # rim stiffness acts below
    rim_stiffness_npm: int
    rim_damping_nspm: int
    pressure_valid: int  # lower bound of q in the cornering formula
    flat_cornering: int
    flat_cornering_scale: int  # 1; what a diagnosis changes
    saturation: int  # linear tires: inverse of the friction they level off at
    flat_trail: int
    flat_camber: int
    flat_rolling: int
    flat_drag_scale: int  # 1; what a diagnosis changes
    flat_relaxation_m: int
    flat_radius_m: int  # rolling radius on the rim
    linear_cornering_nprad: int
    linear_slip_n: int
