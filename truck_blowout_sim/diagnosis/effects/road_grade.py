"""Gravity along the road."""

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
    name="road_grade",
    amount=Amount("grade_rad", "rad", step=0.003, low=-0.12, high=0.12, material=0.0012,
                  source="a level track's slope, 0.06 % (1 sigma)"),
    places=whole_truck,
    met=True,
    values=lambda packed, place, a: added(packed, "world.road_grade_rad", a),
    sentence="The road climbs by {percent} percent along its course.",
    equation="F_x = -m g sin({value} rad)",
    splits="the accelerometer against the wheel speeds, at any speed",
    drags=True,
    absorbs="road_slope",
)

FROM_AN_INSTANT = replace(
    EFFECT,
    values=lambda packed, place, a: {"world.grade_change_rad": a},
    timing="ramp",
    ramp_s=SLOPE_ENTERED_IN_S,
    timed=lambda packed, place, start, end: {
        "world.grade_change_time_s": start, "world.grade_change_ramp_s": end - start},
    onset_form_s=0.5,
    variant=True,
    sentence="From {onset} on the road climbs by {percent} percent along its course.",
    equation="F_x = -m g sin({value} rad) from t = {onset}",
    absorbs="",
)
