"""Engine, retarder or driveline slows the drive axles off throttle."""

from __future__ import annotations

from dataclasses import replace

from truck_blowout_sim.diagnosis.effects.base import (
    Amount,
    Effect,
    added,
    weight_n,
    whole_truck,
)

EFFECT = Effect(
    name="driveline_drag",
    amount=Amount("extra_drag_n", "N", step=800.0, low=-1500.0, high=40000.0, material=0.0024,
                  source="tires lose a fifth of 0.006 of the load as they warm up (1 sigma)",
                  grid=(3000.0, 9000.0, 27000.0)),
    places=whole_truck,
    values=lambda packed, place, a: added(packed, "driveline.drag_extra_n", a),
    sentence="Off the throttle the driveline holds the drive wheels back with {value} N more than "
             "modelled.",
    equation="F_x,drive = -(F_drag + {value} N) (1 - throttle)",
    splits="the slip of the drive hubs when the throttle goes",
    drags=True,
    grows_with=weight_n,
    absorbs="driveline_loss",
)

RETARDER = replace(
    EFFECT,
    values=lambda packed, place, a: added(packed, "driveline.retarder_n", a),
    variant=True,
    sentence="With the throttle closed a retarder holds the drive wheels back with {value} N.",
    equation="F_x,drive = -{value} N while the throttle is closed",
    absorbs="",
)
