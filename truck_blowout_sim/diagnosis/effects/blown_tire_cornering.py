"""The blown tire keeps more, or less, cornering force than modelled."""

from __future__ import annotations

from truck_blowout_sim.diagnosis.effects.base import (
    Amount,
    Effect,
    each_tire,
    scaled,
)

EFFECT = Effect(
    name="blown_tire_cornering",
    amount=Amount("cornering_factor", "1", step=0.3, low=-1.0, high=4.0, material=1.2,
                  source="a flat tire keeps 5 to 40 % of it: 60 % (1 sigma)",
                  report=lambda a: 1.0 + a, grid=(1.0, -0.7, 2.5),
                  at_low="The blown tire at {where} has lost all of its cornering force (90 %: at "
                         "most {percent} percent of the sheet's)."),
    places=each_tire,
    values=lambda packed, place, a: scaled(packed, [f"tire.{place.tire}.flat_cornering_scale"], a),
    applies="blowout",
    sentence="The blown tire {where} keeps {value} times the cornering force that the model leaves "
             "it.",
    equation="F_y,flat = {value} * c_flat * F_y(alpha, F_z)",
    splits="a steering reversal after the blowout",
    absorbs="flat_cornering",
    whole_range=True,
)
