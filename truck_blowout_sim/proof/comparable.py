"""Where the strength of a concealed effect and a diagnosed parameter are the same quantity.

Truth and model use different laws on purpose, so many strengths have no counterpart: a factor on
one curve says nothing about a factor on another. Only quantities with a meaning of their own (a
slope, an area, a moment, an offset) are compared; the rest is listed with the reason.

Validated with: test/proof/test_score.py.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from truck_blowout_sim.proof.cases import Cause


@dataclass(frozen=True)
class Rule:
    """The parameter that states the same quantity, and the truth's strength in its terms."""

    parameter: str
    convert: Callable[[float], float] = float


@dataclass(frozen=True)
class ParameterScore:
    """One comparison of an estimate with the truth.

    Attributes:
        covered: whether the stated 90 % interval holds the truth.
        arms: distance of the truth, as a multiple of the interval's arm on its side; None if that
            side is open.
    """

    name: str
    truth: float
    found: float
    relative_error: float
    covered: bool
    arms: float | None = None


COMPARABLE: Mapping[str, Rule] = {
    "aerodynamic_drag": Rule("extra_drag_area_m2"),
    "axle_misalignment": Rule("angle_rad"),
    "road_grade": Rule("grade_rad"),
    "road_bank": Rule("bank_rad"),
    "brake_lag": Rule("extra_lag_s"),
    "brake_imbalance": Rule("torque_ratio"),
    "fifth_wheel_friction": Rule("extra_moment_nm"),
    "steering_lash": Rule("extra_lash_rad"),
    "friction_change": Rule("friction_factor", lambda lost: 1.0 - lost),
    "yaw_rate_bias": Rule("bias"),
    "yaw_rate_scale": Rule("scale_error"),
    "lateral_accel_scale": Rule("scale_error"),
    "lateral_accel_roll": Rule("roll_leak"),
    "speed_scale": Rule("scale_error"),
    "channel_delay": Rule("delay"),
    "steering_angle_offset": Rule("offset"),
    "steering_lag": Rule("extra_lag_s"),
}
# Another law means another quantity; said to the reader as it stands here.
NOT_COMPARABLE: Mapping[str, str] = {
    "blown_tire_drag": "added resistance of a rubbing law against a factor on the rolling loss",
    "blown_tire_cornering": "share of a sound tire's slope against a factor on the flat's",
    "slow_deflation": "hole that tears open against one time factor",
    "secondary_blowout": "hole area against a multiple of the commanded blowout's hole",
    "steering_compliance": "hardening linkage against a linear one",
    "roll_steer": "progressive in roll against linear",
    "tire_relaxation": "grows with load against one factor",
    "tire_saturation": "peak lost more under load against one factor",
    "crosswind": "peak of a 1-cos gust against a gust of constant speed",
    "driveline_drag": "force at one speed of a law that fades against a constant force",
    "brake_fade": "loss over drum temperature against loss over energy",
    "payload_shift": "one block moves against the whole load",
    "steering_ratio": "another gear or one that bends with the angle: two laws of one name",
    "wheel_drag": "has no name of the list: it stands for whatever drags a wheel",
    "corner_drag": "has no name of the list: the verdict is unknown",
    "yaw_moment": "has no name of the list: the verdict is unknown",
    "lever_arm": "multiple of a vector against its components",
}


def compare_parameter(cause: Cause, effect: Mapping[str, Any]) -> ParameterScore | None:
    """Score a diagnosed effect of the right name; None where nothing can be compared."""
    rule = COMPARABLE.get(cause.name)
    if rule is None or effect["name"] != cause.name:
        return None
    stated = effect["parameters"].get(rule.parameter)
    truth = rule.convert(cause.strength[1])
    if stated is None or truth == 0.0:
        return None
    low, high = stated["ci90"]
    covered = (low is None or low <= truth) and (high is None or truth <= high)
    found = float(stated["value"])
    return ParameterScore(cause.name, truth, found, abs(found - truth) / abs(truth), covered,
                          _arms(found, truth, high if truth > found else low))


def _arms(found: float, truth: float, end: float | None) -> float | None:
    """How far the truth is from the estimate, in arms of the interval toward it."""
    if end is None or end == found:
        return None
    return abs(truth - found) / abs(float(end) - found)
