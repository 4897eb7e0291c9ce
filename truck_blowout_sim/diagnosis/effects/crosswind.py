"""A side force on tractor or trailer for an interval, at the place of the sheet or another.

Where the wind takes hold is known of no vehicle on the road: the centre of pressure of cars lies
between the middle of the wheelbase and 0.3 wheelbases ahead of it, and a gust takes hold of one end
first. So a wind is asked for at three places. Its place between them, its height, and how far it
pushes back are fitted with it.

References: Hucho 1998, ch. 5 (side force and yawing moment of road vehicles). How much the numbers
of the law may stray is engineering judgment.
"""

from __future__ import annotations

from dataclasses import replace

from truck_blowout_sim.diagnosis.effects.base import (
    Amount,
    Effect,
    FormNumber,
    Values,
    each_unit,
    length_m,
)
from truck_blowout_sim.diagnosis.result.parts import Place
from truck_blowout_sim.vehicle import Packed

_APART = 0.15  # of the unit's length, half of what the centres of pressure of cars span
_SIDE_FORCE = 0.3  # engineering judgment: files have it from the silhouette
_LAW = (
    FormNumber("unit.{unit}.gust_ahead_m",
               lambda packed, place: 0.5 * _APART * length_m(packed, place.body or ""),
               "half the distance of the places tried"),
    FormNumber("unit.{unit}.gust_up_m",
               lambda packed, place: 0.03 * length_m(packed, place.body or ""),
               "engineering judgment: a car's to 0.1 m, a trailer's to 0.4 m"),
    FormNumber("unit.{unit}.gust_drag_share", lambda packed, place: 0.2,
               "engineering judgment: the axial force changes with the air angle, either way"),
)


def _wind(packed: Packed, place: Place, amount: float, ahead: float) -> Values:
    unit = place.body or ""
    return {f"unit.{unit}.gust_mps": amount,
            f"unit.{unit}.gust_ahead_m": ahead * length_m(packed, unit) if amount else 0.0}


EFFECT = Effect(
    name="crosswind",
    amount=Amount("wind_speed_mps", "m/s", step=3.0, low=-50.0, high=50.0, material=4.4,
                  file_share=_SIDE_FORCE,
                  source="turbulence of a fifth of a fresh breeze, 11 m/s: 2.2 m/s (1 sigma)"),
    places=each_unit,
    values=lambda packed, place, a: _wind(packed, place, a, 0.0),
    onset_form_s=0.3,
    met=True,
    form_numbers=_LAW,
    timing="pulse",
    timed=lambda packed, place, start, end: {
        f"unit.{place.body}.gust_start_s": start, f"unit.{place.body}.gust_end_s": end,
        f"unit.{place.body}.gust_ramp_s": 0.4},
    sentence="A side wind of {value} m/s blows on the {where} from {onset}, towards its left if "
             "positive.",
    equation="F_y = 0.5 rho A_s |v_air| (w_y - v_y),  w_y = {value} m/s from t = {onset}",
    splits="the line of action, and a run with the same steering in still air",
)

AHEAD = replace(
    EFFECT, variant=True, values=lambda packed, place, a: _wind(packed, place, a, _APART),
    sentence="A side wind of {value} m/s blows on the front of the {where} from {onset}, towards "
             "its left if positive.",
    equation=f"{EFFECT.equation}, {_APART} lengths ahead of the sheet's centre of pressure")

BEHIND = replace(
    EFFECT, variant=True, values=lambda packed, place, a: _wind(packed, place, a, -_APART),
    sentence="A side wind of {value} m/s blows on the rear of the {where} from {onset}, towards "
             "its left if positive.",
    equation=f"{EFFECT.equation}, {_APART} lengths behind the sheet's centre of pressure")
