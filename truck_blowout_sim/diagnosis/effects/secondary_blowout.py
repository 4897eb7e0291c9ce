"""Another tire fails later without being commanded.

How a flat tire drags, what cornering it keeps and how far it sinks differ much from tire to tire,
so these numbers of its law are fitted with the hole, within their priors. The smallest hole that is
searched for, a five-hundredth of a burst's, is hardly flat at the end of a long run.
"""

from __future__ import annotations

from truck_blowout_sim.diagnosis.effects import blown_tire_cornering, blown_tire_drag
from truck_blowout_sim.diagnosis.effects.base import (
    Amount,
    Effect,
    FormNumber,
    each_tire,
)

_DRAG, _CORNERING = blown_tire_drag.EFFECT.amount, blown_tire_cornering.EFFECT.amount
_LAW = (
    FormNumber("tire.{tire}.flat_drag_scale", lambda packed, place: 0.5 * _DRAG.material,
               _DRAG.source, scales=True),
    FormNumber("tire.{tire}.flat_cornering_scale", lambda packed, place: 0.5 * _CORNERING.material,
               _CORNERING.source, scales=True),
    FormNumber("tire.{tire}.rim_radius_m", lambda packed, place: 0.1,
               "bead and folded carcass under the rim: 10 %", scales=True),
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
    form_numbers=_LAW,
    timing="step",
    timed=lambda packed, place, start, end: {f"tire.{place.tire}.blow_time_s": start},
    sentence="Tire {where} lost its air by itself at {onset}, without a command.",
    equation="p_{where}(t) falls through a hole of {value} * CdA from t = {onset}",
    splits="the pressure of that tire",
)
