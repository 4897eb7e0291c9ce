"""Another tire fails later without being commanded.

The smallest hole that is searched for, a five-hundredth of a burst's, empties a tire in minutes.
Known limits: how a tire's forces change while it empties differs from tire to tire, so hole and
instant of a slow loss that no gauge reads may both be off by much.
"""

from __future__ import annotations

from truck_blowout_sim.diagnosis.effects.base import (
    Amount,
    Effect,
    each_tire,
)

EFFECT = Effect(
    name="secondary_blowout",
    amount=Amount("hole_scale", "1", step=1.0, low=0.002, high=3.0, material=0.001,
                  source="judgement: a nail leaves 1 mm2 (1 sigma), a burst a hole of 27 cm2",
                  grid=(0.01, 0.03, 0.1, 0.3)),
    places=each_tire,
    values=lambda packed, place, a: {f"tire.{place.tire}.blow_hole_scale": max(a, 0.0)},
    hides="leak",
    met=True,
    timing="step",
    timed=lambda packed, place, start, end: {f"tire.{place.tire}.blow_time_s": start},
    sentence="Tire {where} lost its air by itself at {onset}, without a command.",
    equation="p_{where}(t) falls through a hole of {value} * CdA from t = {onset}",
    splits="the pressure of that tire",
)
