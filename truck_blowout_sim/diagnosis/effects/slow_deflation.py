"""Pressure falls slower, or faster, than modelled: another hole, or one that tears open."""

from __future__ import annotations

from dataclasses import replace

from truck_blowout_sim.diagnosis.effects.base import (
    Amount,
    Effect,
    added,
    each_tire,
)

EFFECT = Effect(
    name="slow_deflation",
    amount=Amount("deflation_time_factor", "1", step=0.3, low=-0.8, high=499.0, material=0.58,
                  source="holes of bursts, 16 to 44 cm2: 29 % (1 sigma)",
                  report=lambda a: 1.0 + a, grid=(-0.7, 1.0, 4.0, 12.0, 40.0, 120.0, 360.0)),
    places=each_tire,
    values=lambda packed, place, a: {
        f"tire.{place.tire}.hole_scale":
            packed[f"tire.{place.tire}.hole_scale"] / max(1.0 + a, 0.05)},
    applies="blowout",
    sentence="The air leaves tire {where} {value} times as slowly as modelled.",
    equation="dp/dt = -(1/{value}) * n R T / V * mdot(p)",
    splits="the pressure of that tire",
    absorbs="deflation",
)

TORN_OPEN = replace(
    EFFECT,
    amount=Amount("hole_opening_s", "s", step=0.3, low=0.0, high=60.0, material=0.5,
                  source="empty 0.5 s after a large hole is cut: what tears open within that is "
                         "no other failure", grid=(1.0, 3.0, 9.0, 27.0)),
    values=lambda packed, place, a: added(packed, f"tire.{place.tire}.hole_opening_s", a),
    variant=True,
    sentence="The hole in tire {where} is not there at once: it tears open within {value} s.",
    equation="A(t) = A_0 min((t - t_blowout) / {value} s, 1)",
)
