"""Gravity across the road."""

from __future__ import annotations

from dataclasses import replace

from truck_blowout_sim.diagnosis.effects.base import (
    SLOPE_ENTERED_IN_S,
    Amount,
    Effect,
    added,
    whole_truck,
)

EFFECT = Effect(
    name="road_bank",
    amount=Amount("bank_rad", "rad", step=0.005, low=-0.12, high=0.12, material=0.0025,
                  source="a level track's crossfall, 0.13 % (1 sigma)"),
    places=whole_truck,
    met=True,
    values=lambda packed, place, a: added(packed, "world.road_bank_rad", a),
    sentence="The road is banked by {percent} percent (positive: left side high).",
    equation="F_y = -m g sin({value} rad)",
    splits="the lateral accelerometer against yaw rate times speed",
    absorbs="road_crossfall",
)

FROM_AN_INSTANT = replace(
    EFFECT,
    amount=replace(EFFECT.amount, material=0.0012,
                   source="half of a crossfall: the same road before has shown the rest"),
    values=lambda packed, place, a: {"world.bank_change_rad": a},
    timing="ramp",
    ramp_s=SLOPE_ENTERED_IN_S,
    timed=lambda packed, place, start, end: {
        "world.bank_change_time_s": start, "world.bank_change_ramp_s": end - start},
    onset_form_s=0.5,
    variant=True,
    sentence="From {onset} on the road is banked by {percent} percent (positive: left side high).",
    equation="F_y = -m g sin({value} rad) from t = {onset}",
    absorbs="",
)
