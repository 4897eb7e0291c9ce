"""The load moves at some instant."""

from __future__ import annotations

from collections.abc import Sequence

from truck_blowout_sim.diagnosis.effects.base import Amount, Effect
from truck_blowout_sim.diagnosis.result_parts import Place
from truck_blowout_sim.vehicle import Vehicle


def _laden(vehicle: Vehicle) -> Sequence[Place]:
    """Units with a load that can move."""
    return tuple(Place(body=name) for name, unit in vehicle.unit_specs.items() if unit.payload)


EFFECT = Effect(
    name="payload_shift",
    amount=Amount("shift_left_m", "m", step=0.15, low=-1.5, high=1.5, material=0.03),
    places=_laden,
    values=lambda packed, place, a: {f"unit.{place.body}.shift_y_m": a},
    onset_form_s=0.15,
    met=True,
    timing="step",
    timed=lambda packed, place, start, end: {
        f"unit.{place.body}.shift_start_s": start, f"unit.{place.body}.shift_duration_s": 0.6},
    sentence="The load on the {where} moved {value} m to the left at {onset} (negative: to the "
             "right).",
    equation="M_x = m_load g * {value} m from t = {onset}",
    splits="roll and articulation after the instant, and the axle loads",
)
