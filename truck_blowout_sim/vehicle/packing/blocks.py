"""Filling one block of the parameter vector, and the values that change nothing.

A block is a NamedTuple of the layout. Every field must come from somewhere: from a section of the
same field name, from a value computed while packing, or from `NEUTRAL`. A field without source is a
mistake in this package and fails at once.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from math import inf
from typing import Any

from truck_blowout_sim.physics import layout

# Fields that no file sets: off, or 1 where they scale. A vehicle file reaches them by `effects:`.
NEUTRAL: dict[type[Any], dict[str, float]] = {
    layout.WorldParams: {
        "grade_change_rad": 0.0,
        "grade_change_time_s": inf,
        "bank_change_rad": 0.0,
        "bank_change_time_s": inf,
        "grade_change_ramp_s": 2.0,
        "bank_change_ramp_s": 2.0,
        "friction_change_scale": 1.0,
        "friction_change_x_m": inf,
        "friction_change_time_s": inf,
    },
    layout.SteeringParams: {"stiffness_gain": 1.0, "lash_extra_rad": 0.0},
    layout.CouplingParams: {},
    layout.DrivelineParams: {"drag_extra_n": 0.0, "drag_extra_nspm": 0.0, "push_n": 0.0,
                            "retarder_n": 0.0, "retarder_throttle": 0.05},
    layout.AbsParams: {},
    layout.CircuitParams: {"delay_extra_s": 0.0, "lag_extra_s": 0.0},
    layout.UnitParams: {
        "yaw_rate_gain": 1.0,
        "drag_area_extra_m2": 0.0,
        "gust_mps": 0.0,
        "gust_start_s": inf,
        "gust_end_s": inf,
        "gust_ramp_s": 0.5,
        "gust_ahead_m": 0.0,
        "gust_up_m": 0.0,
        "gust_drag_share": 0.0,
        "shift_x_m": 0.0,
        "shift_y_m": 0.0,
        "shift_start_s": inf,
        "shift_duration_s": 1.0,
        "probe_fx_n": 0.0,
        "probe_fy_n": 0.0,
        "probe_mz_nm": 0.0,
        "probe_start_s": inf,
        "probe_end_s": inf,
        "probe_ramp_s": 0.0,
        "probe_fx_v_nspm": 0.0,
        "probe_fx_vv_ns2pm2": 0.0,
        "probe_fx_vr_kg": 0.0,
        "probe_fx_roll_nprad": 0.0,
        "probe_fy_v_nspm": 0.0,
        "probe_fy_vv_ns2pm2": 0.0,
        "probe_fy_vr_kg": 0.0,
        "probe_fy_roll_nprad": 0.0,
        "probe_mz_v_ns": 0.0,
        "probe_mz_vv_ns2pm": 0.0,
        "probe_mz_vr_kgm": 0.0,
        "probe_mz_roll_nmprad": 0.0,
    },
    layout.AxleParams: {
        "roll_steer_extra": 0.0,
        "drop_steer_radpm": 0.0,
        "misalignment_rad": 0.0,
        "peak_scale": 1.0,
        "lateral_compliance_radpn": 0.0,
    },
    layout.HubParams: {"brake_gain": 1.0},
    layout.TireParams: {
        "hole_scale": 1.0,
        "hole_opening_s": 0.0,
        "blow_time_s": inf,
        "blow_hole_scale": 1.0,
        "relaxation_scale": 1.0,
        "flat_cornering_scale": 1.0,
        "saturation": 0.0,
        "flat_drag_scale": 1.0,
    },
}


def fill(
    block: type[Any], computed: Mapping[str, float], sections: Iterable[object] = ()
) -> list[float]:
    """Values of a block in the order of its fields.

    Args:
        block: the NamedTuple of the layout.
        computed: values made while packing; they come before everything else.
        sections: typed sections whose numbers of the same name are taken.

    Raises:
        LookupError: a field without source, or a computed value without field.
    """
    names: tuple[str, ...] = block._fields
    if strangers := sorted(set(computed) - set(names)):
        raise LookupError(f"{block.__name__} has no field {', '.join(strangers)}")
    values = dict(NEUTRAL[block])
    for section in sections:
        values |= {
            name: float(getattr(section, name))
            for name in names
            if isinstance(getattr(section, name, None), (int, float))
        }
    values |= computed
    if missing := [name for name in names if name not in values]:
        raise LookupError(f"{block.__name__} has no source for {', '.join(missing)}")
    return [values[name] for name in names]
