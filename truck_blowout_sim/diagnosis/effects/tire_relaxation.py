"""Lateral force follows slip after a rolled distance."""

from __future__ import annotations

from truck_blowout_sim.diagnosis.effects.base import (
    Amount,
    Effect,
    scaled,
    whole_truck,
)

EFFECT = Effect(
    name="tire_relaxation",
    amount=Amount("relaxation_factor", "1", step=0.3, low=0.0, high=8.0, material=0.56,
                  source="0.3 to 0.8 m between truck tires: 28 % (1 sigma)",
                  report=lambda a: 1.0 + a, grid=(1.0, 3.0, 6.0)),
    places=whole_truck,
    values=lambda packed, place, a: scaled(
        packed, [f"tire.{t}.relaxation_scale" for t in packed.vehicle.tires], a),
    sentence="Lateral tire force builds up over {value} times the rolled distance that is "
             "modelled.",
    equation="{value} * sigma * d(alpha')/ds + alpha' = alpha",
    splits="the lag at two speeds: it shrinks as speed grows",
    absorbs="relaxation",
)
