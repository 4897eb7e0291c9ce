"""Free play between hand wheel and road wheels."""

from __future__ import annotations

from truck_blowout_sim.diagnosis.effects.base import (
    Amount,
    Effect,
    added,
    steered_axle,
)

_QUARTER_TURN = 1.6  # rad; 49 CFR 393.209 allows 0.5 with power steering

EFFECT = Effect(
    name="steering_lash",
    amount=Amount("extra_lash_rad", "rad", step=0.03, low=0.0, high=_QUARTER_TURN, material=0.074,
                  source="new to worn, 3 to 10 deg: 35 % of 6 deg (1 sigma)",
                  grid=(0.1, 0.25, 0.75)),
    places=steered_axle,
    values=lambda packed, place, a: added(packed, "steering.lash_extra_rad", a),
    sentence="The hand wheel turns {value} rad further than modelled before the road wheels "
             "follow.",
    equation="delta = deadzone(delta_hw, (lash + {value}) / 2) / i",
    splits="small hand-wheel angles and reversals",
    absorbs="steering_lash",
)
