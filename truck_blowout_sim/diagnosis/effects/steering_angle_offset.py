"""The hand-wheel zero is off (an instrument, asked of the model)."""

from __future__ import annotations

from truck_blowout_sim.diagnosis.effects.base import (
    Amount,
    Effect,
    added,
    steered_axle,
)

EFFECT = Effect(
    name="steering_angle_offset",
    amount=Amount("offset_rad", "rad", step=0.02, low=-0.6, high=0.6, material=0.05,
                  source="0.06 deg at the road wheel, ratio 24 (1 sigma)"),
    places=steered_axle,
    values=lambda packed, place, a: added(packed, "steering.offset_rad", a),
    sentence="The hand-wheel angle reads {value} rad when the wheels point straight ahead.",
    equation="delta_hw,measured = delta_hw + {value} rad",
    splits="a straight run with hands off",
    kind="sensor",
    absorbs="steering_zero",
)
