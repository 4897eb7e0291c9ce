"""Brake torque falls as the brake heats."""

from __future__ import annotations

from truck_blowout_sim.diagnosis.effects.base import (
    Amount,
    Effect,
    each_circuit,
)

EFFECT = Effect(
    name="brake_fade",
    amount=Amount("fade_per_mj", "1/MJ", step=0.3, low=0.0, high=20.0, material=0.1,
                  source="judgement: linings of one type fade alike to 5 % a megajoule (1 sigma)",
                  grid=(0.5, 2.0, 8.0)),
    places=each_circuit,
    values=lambda packed, place, a: {
        f"circuit.{place.axle}.fade_per_j":
            packed[f"circuit.{place.axle}.fade_per_j"] + a * 1e-6},
    applies="brakes",
    sentence="The {where} brakes lose torque as they heat: by 1/(1 + {value}) after the first "
             "megajoule at a wheel.",
    equation="T = T(p) / (1 + {value} * E),  E in MJ dissipated at the hub",
    splits="a long stop at constant pressure",
)
