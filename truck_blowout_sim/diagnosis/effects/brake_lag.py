"""Chamber pressure follows the control pressure late: it fills slowly, or begins late.

A narrow or leaking line fills slowly; a long line or a slow relay valve begins late.

References: FMVSS 121 S5.3.3 and S5.3.4 (a stop in timing holds both: dead time and rise).
Validated with: test/diagnosis/test_effects.py.
"""

from __future__ import annotations

from dataclasses import replace

from truck_blowout_sim.diagnosis.effects.base import (
    Amount,
    Effect,
    Values,
    added,
    each_circuit,
)
from truck_blowout_sim.diagnosis.result.parts import Place
from truck_blowout_sim.vehicle import Packed

_LATEST_S = 0.8  # the model's line holds 1 s, of which a sheet's own delay takes 0.1 to 0.15 s

EFFECT = Effect(
    name="brake_lag",
    amount=Amount("extra_lag_s", "s", step=0.08, low=0.0, high=3.0, material=0.08,
                  source="FMVSS 121 timing of good equipment, 60-70 % of the limits: 0.03 s, of "
                         "trailers, one to two relay valves, 0.05 s (1 sigma)",
                  grid=(0.2, 0.6, 1.5)),
    places=each_circuit,
    values=lambda packed, place, a: added(packed, f"circuit.{place.axle}.lag_extra_s", a),
    applies="brakes",
    sentence="The {where} brakes fill {value} s later than modelled.",
    equation="(tau + {value} s) dp/dt + p = p_control(t - T)",
    splits="the chamber pressures",
)

LATE = replace(
    EFFECT,
    amount=replace(EFFECT.amount, high=_LATEST_S, grid=EFFECT.amount.grid[:2]),
    values=lambda packed, place, a: added(packed, f"circuit.{place.axle}.delay_extra_s", a),
    variant=True,
    sentence="The {where} brakes begin to fill {value} s later than modelled.",
    equation="tau dp/dt + p = p_control(t - T - {value} s)",
)


def _both(packed: Packed, place: Place, amount: float) -> Values:
    """Half of the time before the chamber begins to fill, half for filling."""
    circuit = f"circuit.{place.axle}"
    return {**added(packed, f"{circuit}.delay_extra_s", 0.5 * amount),
            **added(packed, f"{circuit}.lag_extra_s", 0.5 * amount)}


LATE_AND_SLOW = replace(
    EFFECT,
    # half of the amount is either
    amount=replace(EFFECT.amount, high=2.0 * _LATEST_S, material=2.0 * EFFECT.amount.material),
    values=_both,
    variant=True,
    sentence="The {where} brakes begin to fill later than modelled and fill more slowly, by "
             "{value} s in all.",
    equation="(tau + {value} s / 2) dp/dt + p = p_control(t - T - {value} s / 2)",
)
