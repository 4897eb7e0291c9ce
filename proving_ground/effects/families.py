"""Effects that look alike, or act through the same parts: a family.

Where a whole family is taken out of a diagnosis's library, what is concealed of it has no name left
and no look-alike: the diagnosis must say that it does not know.
"""

from __future__ import annotations

FAMILIES: dict[str, tuple[str, ...]] = {
    "along the course": ("aerodynamic_drag", "driveline_drag", "road_grade"),
    "brakes": ("brake_lag", "brake_imbalance", "brake_fade"),
    "the flat tire": ("blown_tire_drag", "blown_tire_cornering", "slow_deflation"),
    "across the course": ("crosswind", "road_bank", "payload_shift"),
    "steering": ("steering_compliance", "steering_lash", "roll_steer", "axle_misalignment",
                 "steering_angle_offset", "steering_lag", "steering_ratio"),
    "another tire lost": ("secondary_blowout",),
    "grip": ("tire_saturation", "friction_change", "tire_relaxation"),
    "the coupling": ("fifth_wheel_friction",),
}
