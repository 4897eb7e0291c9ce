"""Kingpin moments turn the road wheels against a held hand wheel."""

from __future__ import annotations

from truck_blowout_sim.diagnosis.effects.base import (
    Amount,
    Effect,
    steered_axle,
)

_LOOSE = 19.0  # a twentieth of the stiffness: what is softer is a broken linkage

EFFECT = Effect(
    name="steering_compliance",
    amount=Amount("compliance_factor", "1", step=0.15, low=-1.0, high=_LOOSE, material=0.48,
                  source="column, gear and drag link, 700 to 1,600 N m/deg: 24 % (1 sigma)",
                  report=lambda a: 1.0 + a, grid=(0.5, 1.5, 3.0, 9.0, -0.5)),
    places=steered_axle,
    values=lambda packed, place, a: {
        "steering.stiffness_gain": packed["steering.stiffness_gain"] / max(1.0 + a, 0.02),
        # in a model whose road wheels follow the hand wheel exactly, this switches compliance on
        "steering.compliance_on": 1.0 if a > -1.0 else packed["steering.compliance_on"]},
    neutral=lambda packed: 0.0 if packed["steering.compliance_on"] else -1.0,
    sentence="The front wheels turn against the held hand wheel when a moment acts at the "
             "kingpins: the steering gives {value} times as much as the linkage of its sheet.",
    equation="delta = delta_hw / i - {value} * M_kingpin / K_s",
    splits="the road-wheel angle; yaw without hand-wheel motion that grows with kingpin moment",
    absorbs="steering_stiffness",
)
