"""Lateral force falls below linear at large slip or load."""

from __future__ import annotations

from collections.abc import Sequence

from truck_blowout_sim.diagnosis.effects.base import (
    Amount,
    Effect,
    each_axle,
    scaled,
)
from truck_blowout_sim.diagnosis.effects.tire_saturation_linear import is_linear
from truck_blowout_sim.diagnosis.result_parts import Place
from truck_blowout_sim.vehicle import Vehicle


def _formula_axles(vehicle: Vehicle) -> Sequence[Place]:
    """Axles whose tires level off in the model already."""
    return tuple(p for p in each_axle(vehicle) if p.axle and not is_linear(vehicle, p.axle))


EFFECT = Effect(
    name="tire_saturation",
    amount=Amount("peak_factor", "1", step=-0.1, low=-0.8, high=0.5, material=0.08,
                  report=lambda a: 1.0 + a, grid=(-0.2, -0.4)),
    places=_formula_axles,
    values=lambda packed, place, a: scaled(packed, [f"axle.{place.axle}.peak_scale"], a),
    sentence="The tires of axle {where} give out earlier: their lateral force levels off at "
             "{value} times the modelled peak.",
    equation="F_y = D' sin(C atan(B alpha)),  D' = {value} * D, B C D' unchanged",
    splits="a manoeuvre at high lateral acceleration",
)
