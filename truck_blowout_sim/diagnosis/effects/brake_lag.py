"""Chamber pressure follows the control pressure late."""

from __future__ import annotations

from truck_blowout_sim.diagnosis.effects.base import (
    Amount,
    Effect,
    added,
    each_circuit,
)

EFFECT = Effect(
    name="brake_lag",
    amount=Amount("extra_lag_s", "s", step=0.08, low=0.0, high=3.0, material=0.035,
                  source="judgement: valves and hoses of one type to 18 ms (1 sigma)",
                  grid=(0.2, 0.6)),
    places=each_circuit,
    values=lambda packed, place, a: added(packed, f"circuit.{place.axle}.lag_extra_s", a),
    applies="brakes",
    sentence="The {where} brakes fill {value} s later than modelled.",
    equation="(tau + {value} s) dp/dt + p = p_control(t - T)",
    splits="the chamber pressures",
)
