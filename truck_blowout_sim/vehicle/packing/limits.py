"""Bounds of packed parameters that no file key of the same name bounds, each with its reason.

What a file states under another name has the bounds of that key. A diagnosis searches within the
bounds of its effects, which these contain.

References: nothing is measured here; each limit lies beyond what vehicles and roads are, or keeps a
division or a sign of the core.
Known limits: bounds are those of one parameter; only drive shares are looked at together.
Validated with: test/vehicle/test_bounds.py.
"""

from __future__ import annotations

from math import inf
from typing import Any

from truck_blowout_sim.physics import layout
from truck_blowout_sim.vehicle.fields import Rule, rules
from truck_blowout_sim.vehicle.schema import axle, body, controls
from truck_blowout_sim.vehicle.schema.road import LEAST_GRIP

# Packed field: section and key of the file that it follows from.
RENAMED: dict[type[Any], dict[str, tuple[type[Any], str]]] = {
    layout.SteeringParams: {"compliance_on": (controls.SteeringSpec, "compliant")},
    layout.UnitParams: {"cg_height_m": (body.BodySpec, "z_m")},
    layout.AxleParams: {"half_track_m": (axle.AxleSpec, "track_m"),
                        "half_spacing_m": (axle.AxleSpec, "spring_spacing_m")},
    layout.HubParams: {f"brake_{key}": (axle.BrakeSpec, key)
                       for key in ("linear_nmppa", "quadratic_nmppa2", "pushout_pa")},
}


def _from(low: float, doc: str, high: float = inf) -> Rule:
    return Rule("number", doc, low, high)


def _above_zero(doc: str) -> Rule:
    return Rule("number", doc, 0.0, open_low=True)


def _either_way(most: float, doc: str) -> Rule:
    return Rule("number", doc, -most, most)


_ANY = Rule("number", "may have either sign and any size")
_SCALE = _from(0.0, "a factor; the other sign would turn the effect around")
_GRIP = _from(LEAST_GRIP, "a factor of grip, by which the limit of adhesion is divided; the least "
                          "is less than wet ice has")
_PLACE = _either_way(100.0, "a place on a vehicle, the longest of which is 60 m")
_RAMP = _from(0.0, "time over which something comes about")
_SLOPE = _either_way(0.5, "a slope, as `road_grade_rad`")
_AXLE_ANGLE = _either_way(0.5, "of an axle or wheel at rest: 30 degrees")
_SWITCH = Rule("switch", "whether it is there")


def _each(names: str, rule: Rule) -> dict[str, Rule]:
    return dict.fromkeys(names.split(), rule)


OWN: dict[type[Any], dict[str, Rule]] = {
    layout.WorldParams: {
        **_each("grade_change_rad bank_change_rad", _SLOPE),
        **_each("grade_change_time_s bank_change_time_s friction_change_x_m friction_change_time_s "
                "patch_x0_m patch_x1_m patch_y0_m patch_y1_m", _ANY),
        "grade_change_ramp_s": _RAMP,
        "bank_change_ramp_s": _RAMP,
        **_each("friction_change_scale patch_scale", _GRIP),
    },
    layout.SteeringParams: {
        "stiffness_gain": _SCALE,
        "lash_extra_rad": _either_way(6.3, "one turn of the hand wheel"),
        "wheelbase_m": _above_zero("the Ackermann angle divides by it"),
    },
    layout.CouplingParams: {"preload_z_n": _ANY},
    layout.DrivelineParams: {
        # down to the drag of a truck's engine: a diagnosis may find that it has none
        **_each("drag_extra_n retarder_n", _from(-1500.0, "more than an engine's drag would push")),
        "drag_extra_nspm": _ANY,
        "retarder_throttle": _above_zero("the retarder's law divides by it"),
        "push_n": _ANY,
    },
    layout.CircuitParams: _each("delay_extra_s lag_extra_s", _from(
        0.0, "later than modeled; `delay_s` and `lag_s` say how late that is")),
    layout.UnitParams: {
        **_each("ixy_kgm2 iyz_kgm2 yaw_rate_gain", _ANY),
        **_each("base_x_m base_y_m base_z_m hitch_x_m hitch_y_m hitch_z_m origin_x_m torsion_z_m "
                "drag_z_m side_x_m side_z_m gust_ahead_m gust_up_m payload_x_m payload_y_m "
                "payload_z_m shift_x_m shift_y_m", _PLACE),
        **_each("torsion_front_nmprad torsion_rear_nmprad", _from(0.0, "a stiffness; 0 is rigid")),
        "drag_area_extra_m2": _from(-10.0, "no truck has more drag area to lose"),
        "gust_mps": _either_way(100.0, "a wind; hurricanes blow with 80 m/s"),
        "gust_drag_share": _either_way(1.0, "a side wind pushes sideways more than back"),
        **_each("gust_start_s gust_end_s shift_start_s probe_start_s probe_end_s", _ANY),
        **_each("gust_ramp_s probe_ramp_s", _RAMP),
        "payload_kg": _from(0.0, "a mass"),
        "payload_rear_share": _from(0.0, "a share", 1.0),
        "shift_duration_s": _from(1e-3, "a load does not jump: the reaction goes with its square"),
        **_each(" ".join(name for name in layout.UnitParams._fields if name.startswith("probe_")
                         and not name.endswith("_s")), _ANY),
    },
    layout.AxleParams: {
        **_each("x_m roll_centre_z_m", _PLACE),
        "center_height_m": _above_zero("a wheel stands on the road"),
        "preload_n": _ANY,
        "roll_steer_extra": _either_way(10.0, "axle steer per body roll; linkages reach 0.3"),
        "drop_steer_radpm": _either_way(10.0, "axle steer per travel: a radian in 0.1 m"),
        "misalignment_rad": _AXLE_ANGLE,
        "peak_scale": _GRIP,
        "lateral_compliance_radpn": _either_way(1e-4, "a degree a newton would be 0.02"),
        "behind_m": _PLACE,
    },
    layout.HubParams: {
        "y_m": _PLACE,
        **_each("toe_rad camber_rad", _AXLE_ANGLE),
        "brake_gain": _from(0.0, "a brake never speeds its wheel up"),
        "brake_enabled": _SWITCH,
    },
    layout.TireParams: {
        "y_m": _PLACE,
        **_each("table map_table blow_time_s", _ANY),
        **_each("hole_scale blow_hole_scale flat_cornering_scale flat_drag_scale", _SCALE),
        "hole_opening_s": _from(0.0, "a time; 0: at once"),
        "relaxation_scale": _from(0.01, "a factor; tires differ by 3, and the lag divides by it"),
        "rim_damping_nspm": _from(0.0, "a damping"),
        "saturation": _from(0.0, "the inverse of a friction; 0: no limit"),
    },
}


def own_rules(block: type[Any]) -> dict[str, Rule]:
    """Rules of a block's fields that no key of the same name has."""
    renamed = {field: rules(section)[key]
               for field, (section, key) in RENAMED.get(block, {}).items()}
    return renamed | OWN.get(block, {})
