"""Drag that grows with speed squared.

A tail wind as fast as a truck takes all of its drag area away, some 6 m^2, and a faster one pushes;
the search ends where the bounds of a vehicle file do.
"""

from __future__ import annotations

from truck_blowout_sim.diagnosis.effects.base import (
    Amount,
    Effect,
    added,
    drag_area_m2,
    each_unit,
)

EFFECT = Effect(
    name="aerodynamic_drag",
    amount=Amount("extra_drag_area_m2", "m^2", step=1.0, low=-10.0, high=30.0, material=0.16,
                  source="a head wind of 1 m/s at 25 m/s alone is 8 % (1 sigma)",
                  grid=(3.0, 10.0, -3.0)),
    places=each_unit,
    values=lambda packed, place, a: added(packed, f"unit.{place.body}.drag_area_extra_m2", a),
    sentence="The {where} has {value} m^2 more drag area than modelled.",
    equation="F_x = -0.5 rho (CdA + {value} m^2) v^2",
    splits="a coast-down at two speeds",
    drags=True,
    grows_with=drag_area_m2,
    absorbs="drag_area",
)
