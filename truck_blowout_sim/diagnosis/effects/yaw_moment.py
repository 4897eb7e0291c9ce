"""A yaw moment of unknown origin on one unit, while it corners.

No name is promised for it. A cause that no file here describes, as of a coupling or an axle, mostly
turns a unit; where such a moment explains more than any listed effect, the verdict is `unknown` and
says how it acts.
"""

from __future__ import annotations

from dataclasses import replace

from truck_blowout_sim.diagnosis.effects.base import (
    Amount,
    Effect,
    Values,
    each_unit,
    length_m,
)
from truck_blowout_sim.diagnosis.result.parts import Place
from truck_blowout_sim.vehicle import Packed

_ROLL_RAD = 0.05  # at which the amount of the second law is stated


def _leverage_nm(packed: Packed, place: Place) -> float:
    """Weight of a unit's body times half of its length."""
    unit = place.body or ""
    weight_n = packed[f"unit.{unit}.mass_kg"] * packed["world.gravity_mps2"]
    return 0.5 * weight_n * length_m(packed, unit)


def _cornering(packed: Packed, place: Place, amount: float) -> Values:
    return {f"unit.{place.body}.probe_mz_vr_kgm":
            amount * _leverage_nm(packed, place) / packed["world.gravity_mps2"]}


def _rolled(packed: Packed, place: Place, amount: float) -> Values:
    return {f"unit.{place.body}.probe_mz_roll_nmprad":
            amount * _leverage_nm(packed, place) / _ROLL_RAD}


EFFECT = Effect(
    name="yaw_moment",
    amount=Amount("leverage", "1", step=0.01, low=-1.0, high=1.0, material=0.2,
                  source="tires of another kind: a tenth more side force on one axle and a tenth "
                         "less on the other (1 sigma)"),
    places=each_unit,
    values=_cornering,
    sentence="In a turn, something unknown turns the {where} about its vertical axis: at 1 g like "
             "a side force of {percent} percent of its weight at half of its length (positive: "
             "further into the turn).",
    equation="M_z,{where} = {value} W (L/2) v r / g",
    splits="the turn at two speeds with the same lateral acceleration, and a look at coupling, "
           "steering linkage and axle locations",
    listed=False,
)

WITH_ROLL = replace(
    EFFECT, variant=True, values=_rolled,
    amount=Amount("leverage", "1", step=0.01, low=-1.0, high=1.0, material=0.04,
                  source="roll steer of 0.07 (1 sigma, Fancher et al. 1986) on one axle and its "
                         "opposite on the other, 6 per rad of side force over load"),
    sentence="As its body rolls, something unknown turns the {where} about its vertical axis: at "
             f"{_ROLL_RAD} rad of roll like a side force of {{percent}} percent of its weight at "
             "half of its length (positive: to the left as it rolls to the right).",
    equation=f"M_z,{{where}} = {{value}} W (L/2) phi / {_ROLL_RAD}")
