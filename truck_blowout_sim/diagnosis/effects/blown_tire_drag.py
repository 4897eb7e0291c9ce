"""The blown tire drags more, or less, than modelled.

The search ends beyond the limit of nature: seven times 0.15 of the load is more than a road gives,
so there the wheel hardly turns, and more changes nothing.
"""

from __future__ import annotations

from truck_blowout_sim.diagnosis.effects.base import (
    Amount,
    Effect,
    each_tire,
    scaled,
)

EFFECT = Effect(
    name="blown_tire_drag",
    amount=Amount("drag_factor", "1", step=0.2, low=-0.9, high=6.0, material=0.66,
                  source="coefficients of 0.08 to 0.25 on the rim: 33 % (1 sigma)",
                  report=lambda a: 1.0 + a, grid=(0.5, -0.4, 1.5, 4.0),
                  at_high="The blown tire {where} drags as much as the grip of the road allows: "
                          "its wheel hardly turns (90 %: at least {percent} percent of what is "
                          "modelled)."),
    places=each_tire,
    values=lambda packed, place, a: scaled(packed, [f"tire.{place.tire}.flat_drag_scale"], a),
    applies="blowout",
    sentence="The blown tire {where} drags {value} times as much as modelled: carcass and rim rub "
             "the road and pull the vehicle to that side.",
    equation="D_flat = {value} * f_flat * F_z  (rolling moment M = D_flat * R_e)",
    splits="the wheel speed of the blown tire, or the loss of speed against the yaw moment",
    absorbs="flat_drag",
    whole_range=True,
)
