"""An axle's thrust line is turned by a fixed angle."""

from __future__ import annotations

from truck_blowout_sim.diagnosis.effects.base import (
    Amount,
    Effect,
    added,
    unsteered_axles,
)

EFFECT = Effect(
    name="axle_misalignment",
    amount=Amount("angle_rad", "rad", step=0.003, low=-0.08, high=0.08, material=0.003,
                  source="judgement: axles are set to 0.1 (trailers) or 0.18 deg, and bushings "
                         "yield: 0.09 deg (1 sigma)"),
    places=unsteered_axles,
    values=lambda packed, place, a: added(packed, f"axle.{place.axle}.misalignment_rad", a),
    sentence="Axle {where} points {value} rad to the left of straight ahead.",
    equation="delta_{where} = {value} rad, at every speed",
    splits="straight driving of tractor and trailer apart: the crab angle of each",
    absorbs="{role}_toe",
)
