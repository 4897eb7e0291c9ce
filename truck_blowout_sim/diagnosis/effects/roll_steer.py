"""An axle steers as its suspension rolls or its corner drops.

Near the limit of grip a tire's form looks the same: the slip at which it makes a force grows with
the force, as roll does. Between a brush tire, tanh, the Magic Formula and Dugoff's tire of equal
slope and peak, the slips at a share u of the peak differ by 0.16 u^2 (1 sigma, up to u = 0.6, and
no less beyond) in units of the peak over the slope. Divided by the roll angle there, with 6/rad
of slope over load and 0.1 rad/g of roll, that is a roll steer of 0.27 u up to
u = 0.6 and of 0.2 u nearer to the limit, where it matters.

References: Pacejka 2012, ch. 3 (brush) and 4 (Magic Formula); Dugoff et al. 1970.
Validated with: test/diagnosis/test_effects.py (the four forms, inverted).
"""

from __future__ import annotations

from truck_blowout_sim.diagnosis.effects.base import (
    Amount,
    Effect,
    added,
    each_axle,
)

_FORMS_DIFFER = 0.2  # of four forms at the limit of grip, as above

EFFECT = Effect(
    name="roll_steer",
    amount=Amount("extra_roll_steer", "1", step=0.05, low=-1.0, high=1.0, material=0.174,
                  source="steer axles, -0.15 to 0.15: 0.087 (1 sigma)",
                  grid=(0.2, -0.2, 0.6, -0.6)),
    places=each_axle,
    values=lambda packed, place, a: added(packed, f"axle.{place.axle}.roll_steer_extra", a),
    sentence="Axle {where} steers by {value} degrees for every degree its suspension rolls, beyond "
             "what is modelled.",
    equation="delta_axle = (e + {value}) * (phi_body - phi_axle)",
    splits="the roll angle: the steer follows roll, not kingpin moment",
    absorbs="{role}_roll_steer",
    near_limit=_FORMS_DIFFER,
)
