"""A side force on tractor or trailer for an interval."""

from __future__ import annotations

from truck_blowout_sim.diagnosis.effects.base import (
    Amount,
    Effect,
    each_unit,
)

EFFECT = Effect(
    name="crosswind",
    amount=Amount("wind_speed_mps", "m/s", step=3.0, low=-40.0, high=40.0, material=4.5),
    places=each_unit,
    values=lambda packed, place, a: {f"unit.{place.body}.gust_mps": a},
    onset_form_s=0.3,
    met=True,
    timing="pulse",
    timed=lambda packed, place, start, end: {
        f"unit.{place.body}.gust_start_s": start, f"unit.{place.body}.gust_end_s": end,
        f"unit.{place.body}.gust_ramp_s": 0.4},
    sentence="A side wind of {value} m/s blows on the {where} from {onset}, towards its left if "
             "positive.",
    equation="F_y = 0.5 rho A_s |v_air| (w_y - v_y),  w_y = {value} m/s from t = {onset}",
    splits="the line of action, and a run with the same steering in still air",
)
