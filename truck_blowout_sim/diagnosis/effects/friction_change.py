"""The road is more or less slippery from some place or time on.

A tire of another form bends earlier. That shows only from the instant on at which the vehicle is
driven hard, and looks like less friction from then on, by as much as it looks like a lower peak
(`tire_saturation.py`). Braking hard shows friction as turning hard does.
"""

from __future__ import annotations

from truck_blowout_sim.diagnosis.effects.base import (
    TIRE_FORMS_DIFFER,
    Amount,
    Effect,
    whole_truck,
)

_ICE = -0.95  # wet ice, 0.05, instead of dry asphalt (Wong 2008, ch. 1: 0.07 to 0.1)

EFFECT = Effect(
    name="friction_change",
    amount=Amount("friction_factor", "1", step=-0.45, low=_ICE, high=0.5, material=0.12,
                  source="dry asphalt from place to place: 6 % (1 sigma)",
                  report=lambda a: 1.0 + a, grid=(-0.5, -0.7, -0.85)),
    places=whole_truck,
    values=lambda packed, place, a: {"world.friction_change_scale": 1.0 + a},
    onset_form_s=0.15,
    hides="grip",
    met=True,
    timing="step",
    timed=lambda packed, place, start, end: {"world.friction_change_time_s": start},
    sentence="From {onset} on the road gives only {value} times the friction.",
    equation="mu(t >= {onset}) = {value} * mu",
    splits="hard braking: both axes feel it, and only near the limit",
    absorbs="peak_friction",
    far_from_limit=TIRE_FORMS_DIFFER,
    cuts_grip=True,
    any_direction=True,
)
