"""An axle steers as its suspension rolls or its corner drops."""

from __future__ import annotations

from truck_blowout_sim.diagnosis.effects.base import (
    Amount,
    Effect,
    added,
    each_axle,
)

EFFECT = Effect(
    name="roll_steer",
    amount=Amount("extra_roll_steer", "1", step=0.05, low=-1.0, high=1.0, material=0.14,
                  grid=(0.2, -0.2)),
    places=each_axle,
    values=lambda packed, place, a: added(packed, f"axle.{place.axle}.roll_steer_extra", a),
    sentence="Axle {where} steers by {value} degrees for every degree its suspension rolls, beyond "
             "what is modelled.",
    equation="delta_axle = (e + {value}) * (phi_body - phi_axle)",
    splits="the roll angle: the steer follows roll, not kingpin moment",
    absorbs="{role}_roll_steer",
)
