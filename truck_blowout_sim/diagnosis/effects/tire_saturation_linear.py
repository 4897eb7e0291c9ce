"""A tire that the model has linear levels off: the same effect for another tire model."""

from __future__ import annotations

from collections.abc import Sequence

from truck_blowout_sim.diagnosis.effects.base import Amount, Effect, each_axle
from truck_blowout_sim.diagnosis.result.parts import Place
from truck_blowout_sim.vehicle import Vehicle


def linear_axles(vehicle: Vehicle) -> Sequence[Place]:
    """Axles whose tires are linear."""
    return tuple(p for p in each_axle(vehicle) if p.axle and is_linear(vehicle, p.axle))


def is_linear(vehicle: Vehicle, axle: str) -> bool:
    """Whether an axle's tires have a linear lateral force."""
    return all(vehicle.tire_specs[tire].model == "linear"
               for hub in vehicle.hubs if vehicle.axle_of_hub(hub) == axle
               for tire in vehicle.tires_of_hub(hub))


_SLIPPERY = 20.0  # a peak of 0.05, as on wet ice

EFFECT = Effect(
    name="tire_saturation",
    amount=Amount("inverse_peak_friction", "1", step=0.2, low=0.0, high=_SLIPPERY, material=0.1,
                  source="peak friction between 0.8 and 1.1: 5 % of its inverse (1 sigma)",
                  grid=(0.5, 0.8, 1.1, 3.0, 9.0)),
    places=linear_axles,
    values=lambda packed, place, a: {
        f"tire.{tire}.saturation": packed[f"tire.{tire}.saturation"] + a
        for hub in packed.vehicle.hubs if packed.vehicle.axle_of_hub(hub) == place.axle
        for tire in packed.vehicle.tires_of_hub(hub)},
    sentence="The tires of {axles} are not linear: their side force levels off with slip, at "
             "the load divided by {value}.",
    equation="F_y = (F_z / s) tanh(s C_alpha alpha / F_z),  s = {value}",
    splits="a corner at high lateral acceleration",
)
