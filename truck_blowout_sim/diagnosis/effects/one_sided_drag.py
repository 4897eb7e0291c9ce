"""Something on one side holds the vehicle back: a bearing that seizes, a chain that trails.

No name is promised for it. Where it explains more than any listed effect, the verdict is `unknown`
and says where it acts.
"""

from __future__ import annotations

from dataclasses import replace

from truck_blowout_sim.diagnosis.effects.base import (
    Amount,
    Effect,
    Values,
    added,
    drag_area_m2,
    each_hub,
    each_unit,
)
from truck_blowout_sim.diagnosis.result.parts import Place
from truck_blowout_sim.vehicle import Packed

EFFECT = Effect(
    name="wheel_drag",
    amount=Amount("drag_share", "1", step=0.02, low=0.0, high=1.0, material=0.002,
                  source="rolling resistance of truck tires, 0.004 to 0.008 of the load, cold or "
                         "soft ones a fifth more (1 sigma: 0.001)"),
    places=each_hub,
    values=lambda packed, place, a: {
        name: value for tire in packed.vehicle.tires_of_hub(place.hub or "")
        for name, value in added(packed, f"tire.{tire}.rolling_0", a).items()},
    sentence="The wheels at {where} are held back by {percent} percent of the load on them, as a "
             "dragging brake or a seizing bearing would have it.",
    equation="F_x,{where} = -{value} F_z",
    splits="the temperature of the hub; its speed against that of the wheel on the other side",
    listed=False,
)


def _at_side(side: float) -> Effect:
    """Drag of the air at the left (1) or right (-1) side of a unit."""
    def values(packed: Packed, place: Place, amount: float) -> Values:
        unit = f"unit.{place.body}."
        force = -0.5 * packed["world.air_density_kgpm3"] * amount
        return {unit + "probe_fx_vv_ns2pm2": force,
                unit + "probe_mz_vv_ns2pm": -side * force * _half_width_m(packed, place)}

    where = "left" if side > 0.0 else "right"
    return replace(
        EFFECT, name="corner_drag", places=each_unit, values=values,
        amount=Amount("drag_area_m2", "m^2", step=1.0, low=0.0, high=30.0, material=0.16,
                      source="as of the air: a head wind of 1 m/s at 25 m/s is 8 % (1 sigma)"),
        sentence=f"Something on the {where} side of the {{where}} drags in the air, by "
                 "{value} m^2, as a torn tarpaulin or an open door would have it.",
        equation=f"F_x = -0.5 rho {{value}} m^2 v^2 at the {where} side",
        splits="a look at that side; the pull of the hand wheel on a straight road",
        drags=True, grows_with=drag_area_m2, variant=side < 0.0)


def _half_width_m(packed: Packed, place: Place) -> float:
    """From the middle of a unit to its outermost wheels."""
    vehicle = packed.vehicle
    return max(abs(packed[f"hub.{hub}.y_m"]) for hub in vehicle.hubs
               if vehicle.spec.axles[vehicle.axle_of_hub(hub)].unit == place.body)


LEFT, RIGHT = _at_side(1.0), _at_side(-1.0)
