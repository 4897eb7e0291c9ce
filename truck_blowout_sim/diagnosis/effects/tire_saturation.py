"""Lateral force falls below linear at large slip or load.

How early a curve bends is a matter of the model's form, too. A brush tire of equal slope and peak
bends earlier than the Magic Formula: over slips that use 30, 60 and 80 % of the peak it looks like
one whose peak is 0.5, 0.26 and 0.16 lower, 0.7 times what is left to the limit.

References: Pacejka 2012, ch. 3 (brush) and 4 (Magic Formula).
Validated with: test/diagnosis/test_effects.py (the two curves fitted to each other).
"""

from __future__ import annotations

from collections.abc import Sequence

from truck_blowout_sim.diagnosis.effects.base import (
    TIRE_FORMS_DIFFER,
    Amount,
    Effect,
    Values,
    axles_at,
    each_axle,
    each_circuit,
    scaled,
    whole_truck,
)
from truck_blowout_sim.diagnosis.effects.tire_saturation_linear import is_linear
from truck_blowout_sim.diagnosis.result.parts import Place
from truck_blowout_sim.vehicle import Packed, Vehicle


def _formula_axles(vehicle: Vehicle) -> Sequence[Place]:
    """Axles whose tires level off in the model already: alone, in groups, and all together.

    All where they run on tires of one type: what is wrong of a type is wrong of each.
    """
    single = [p for p in each_axle(vehicle) if p.axle and not is_linear(vehicle, p.axle)]
    groups = [p for p in each_circuit(vehicle) if len(axles_at(vehicle, p)) > 1
              and not any(is_linear(vehicle, axle) for axle in axles_at(vehicle, p))]
    alike = len(vehicle.axles) > 1 and len(single) == len(vehicle.axles) and (
        len({vehicle.tire_files[tire] for tire in vehicle.tires}) == 1)
    return (*single, *groups, *(whole_truck(vehicle) if alike else ()))


def _less_peak(packed: Packed, place: Place, amount: float) -> Values:
    """The lateral peak of all axles of the place, scaled."""
    names = [f"axle.{axle}.peak_scale" for axle in axles_at(packed.vehicle, place)]
    return scaled(packed, names, amount)


_SLIPPERY = -0.95  # as on wet ice, 0.05 instead of 0.9: no rubber holds less

EFFECT = Effect(
    name="tire_saturation",
    amount=Amount("peak_factor", "1", step=-0.1, low=_SLIPPERY, high=0.0, material=0.08,
                  source="peak friction of tires of one type: 4 % (1 sigma)",
                  report=lambda a: 1.0 + a, grid=(-0.2, -0.4, -0.7)),
    places=_formula_axles,
    values=_less_peak,
    sentence="The tires of {axles} give out earlier: their lateral force levels off at "
             "{value} times the modelled peak.",
    equation="F_y = D' sin(C atan(B alpha)),  D' = {value} * D, B C D' unchanged",
    splits="a maneuver at high lateral acceleration",
    of_file=True,
    far_from_limit=TIRE_FORMS_DIFFER,
    cuts_grip=True,
)
