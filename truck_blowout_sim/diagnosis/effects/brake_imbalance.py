"""One hub brakes more or less than its partner."""

from __future__ import annotations

from truck_blowout_sim.diagnosis.effects.base import (
    Amount,
    Effect,
    each_hub,
    scaled,
)

EFFECT = Effect(
    name="brake_imbalance",
    amount=Amount("torque_ratio", "1", step=-0.2, low=-1.0, high=2.0, material=0.13,
                  source="wheel ends to 4 %, their linings to 5 % (1 sigma)",
                  report=lambda a: 1.0 + a, grid=(-0.5, -0.9, 0.7, 1.5),
                  at_low="The brake at {where} is dead: it gives no torque, whatever its pressure "
                         "(90 %: at most {percent} percent of what it should)."),
    places=each_hub,
    values=lambda packed, place, a: scaled(packed, [f"hub.{place.hub}.brake_gain"], a),
    applies="brakes",
    sentence="The brake at {where} gives {percent_of} percent of the torque its pressure should "
             "give.",
    equation="T_{where} = {value} * T(p_chamber)",
    splits="the wheel speeds under braking; a yaw moment proportional to pressure",
    absorbs="brake_gain_{hub}",
)
