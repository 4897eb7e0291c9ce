"""The road wheels follow the hand wheel late: actuator, hydraulics, column.

First order; a pure delay of the same length turns the truck alike below about 1 Hz.
"""

from __future__ import annotations

from truck_blowout_sim.diagnosis.effects.base import (
    Amount,
    Effect,
    added,
    steered_axle,
)

EFFECT = Effect(
    name="steering_lag",
    amount=Amount("extra_lag_s", "s", step=0.03, low=0.0, high=2.0, material=0.02,
                  source="judgement: one type of power steering follows alike to 10 ms (1 sigma)",
                  grid=(0.05, 0.15, 0.4, 1.2)),
    places=steered_axle,
    values=lambda packed, place, a: added(packed, "steering.lag_s", a),
    sentence="The road wheels follow the hand wheel {value} s later than modelled.",
    equation="(tau + {value} s) d(delta)/dt + delta = delta_hw / i",
    splits="the road-wheel angle against the hand wheel: it is late itself, at every speed, where "
           "tires answer late only at low speed",
)
