"""Another tire fails later without being commanded."""

from __future__ import annotations

from truck_blowout_sim.diagnosis.effects.base import (
    Amount,
    Effect,
    each_tire,
)

EFFECT = Effect(
    name="secondary_blowout",
    amount=Amount("hole_scale", "1", step=1.0, low=0.02, high=3.0, material=0.03,
                  source="judgement: a leak of 3 % of a burst's hole takes 30 times as long",
                  grid=(0.1, 0.3)),
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
