"""The gyro has a wrong gain (an instrument, asked of the model).

Kinematics tells it where heading or positions were recorded; without them only a model can.
"""

from __future__ import annotations

from truck_blowout_sim.diagnosis.effects.base import (
    Amount,
    Effect,
    added,
    each_unit,
)

EFFECT = Effect(
    name="yaw_rate_scale",
    amount=Amount("scale_error", "1", 0.02, -0.4, 0.4, 0.03,
                  source="scale of a rate gyro, by data sheets: 1.5 % (1 sigma)"),
    places=each_unit,
    values=lambda packed, place, a: added(packed, f"unit.{place.body}.yaw_rate_gain", a),
    sentence="The yaw rate of the {where} reads {percent} percent too much.",
    equation="r_measured = (1 + {value}) r",
    splits="turn a known angle (a full circle): the integrated yaw rate shows the gain",
    kind="sensor",
)
