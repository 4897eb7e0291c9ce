"""Friction moment between tractor and trailer."""

from __future__ import annotations

from truck_blowout_sim.diagnosis.effects.base import (
    Amount,
    Effect,
    added,
    whole_truck,
)

EFFECT = Effect(
    name="fifth_wheel_friction",
    amount=Amount("extra_moment_nm", "N m", step=1500.0, low=0.0, high=60000.0, material=640.0,
                  source="friction of greased plates, 0.05 to 0.15: 32 % of 1 kN m (1 sigma)",
                  grid=(6000.0, 20000.0, 45000.0)),
    places=lambda vehicle: whole_truck(vehicle) if len(vehicle.units) == 2 else (),
    values=lambda packed, place, a: added(packed, "fifth_wheel.yaw_friction_nm", a),
    sentence="The fifth wheel resists turning with {value} N m more than modelled.",
    equation="M_z = -(M_f + {value} N m) sgn(d(gamma)/dt), equal and opposite on both units",
    splits="the articulation angle sticking at reversals",
    absorbs="fifth_wheel_friction",
)
