"""The library of candidate effects, one file a name; the order is that of the documentation."""

from __future__ import annotations

from truck_blowout_sim.diagnosis.effects import (
    aerodynamic_drag,
    axle_misalignment,
    blown_tire_cornering,
    blown_tire_drag,
    brake_fade,
    brake_imbalance,
    brake_lag,
    crosswind,
    driveline_drag,
    fifth_wheel_friction,
    friction_change,
    one_sided_drag,
    payload_shift,
    road_bank,
    road_grade,
    roll_steer,
    secondary_blowout,
    slow_deflation,
    steering_angle_offset,
    steering_compliance,
    steering_lag,
    steering_lash,
    steering_ratio,
    tire_relaxation,
    tire_saturation,
    tire_saturation_linear,
    yaw_rate_scale,
)
from truck_blowout_sim.diagnosis.effects.base import Amount, Effect

_MODULES = (
    blown_tire_drag,
    blown_tire_cornering,
    slow_deflation,
    secondary_blowout,
    steering_compliance,
    steering_lash,
    steering_lag,
    steering_ratio,
    roll_steer,
    tire_relaxation,
    tire_saturation,
    tire_saturation_linear,
    friction_change,
    crosswind,
    aerodynamic_drag,
    road_grade,
    road_bank,
    driveline_drag,
    brake_lag,
    brake_imbalance,
    brake_fade,
    axle_misalignment,
    payload_shift,
    fifth_wheel_friction,
    steering_angle_offset,
    yaw_rate_scale,
)
LIBRARY: tuple[Effect, ...] = (*(module.EFFECT for module in _MODULES),
                               driveline_drag.RETARDER, brake_lag.LATE,
                               brake_lag.LATE_AND_SLOW, road_grade.FROM_AN_INSTANT,
                               road_bank.FROM_AN_INSTANT, payload_shift.FOREMOST,
                               payload_shift.REARMOST,
                               steering_ratio.BENT, crosswind.AHEAD, crosswind.BEHIND,
                               one_sided_drag.EFFECT, one_sided_drag.LEFT,
                               one_sided_drag.RIGHT)
"""Every candidate, physics first."""

__all__ = ["LIBRARY", "Amount", "Effect"]
