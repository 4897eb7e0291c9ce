"""The load moves at some instant: all of a unit's, or one of its blocks."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from truck_blowout_sim.diagnosis.effects.base import Amount, Effect, Values
from truck_blowout_sim.diagnosis.result.parts import Place
from truck_blowout_sim.vehicle import Packed, Vehicle, movable_load

_MOVES_FOR_S = 0.6  # at first; how long is fitted


def _laden(blocks: int) -> Callable[[Vehicle], Sequence[Place]]:
    """Units with at least so many blocks of load."""
    return lambda vehicle: tuple(Place(body=name) for name, unit in vehicle.unit_specs.items()
                                 if len(unit.payload) >= blocks)


def _shifted(block: int | None) -> Callable[[Packed, Place, float], Values]:
    """Parameters of one block's shift, counted from the front; None for the whole load."""
    def values(packed: Packed, place: Place, amount: float) -> Values:
        if amount == 0.0:
            return {}
        unit = packed.vehicle.unit_specs[place.body or ""]
        names = sorted(unit.payload, key=lambda name: unit.payload[name].x_m)
        load = movable_load(unit, None if block is None else [names[block]])
        return {f"unit.{place.body}.{name}": value
                for name, value in (*load.items(), ("shift_y_m", amount))}
    return values


def _shift_of(block: int | None, what: str) -> Effect:
    """The effect for one part of the load."""
    return Effect(
        name="payload_shift",
        amount=Amount("shift_left_m", "m", step=0.15, low=-1.5, high=1.5, material=0.03,
                  source="judgement: a lashed load settles by 15 mm (1 sigma)"),
        places=_laden(1 if block is None else 2),
        values=_shifted(block),
        onset_form_s=0.15,
        met=True,
        pushes_back=True,
        variant=block is not None,
        timing="ramp",
        ramp_s=_MOVES_FOR_S,
        timed=lambda packed, place, start, end: {
            f"unit.{place.body}.shift_start_s": start,
            f"unit.{place.body}.shift_duration_s": end - start},
        sentence=what + " on the {where} moved {value} m to the left at {onset} (negative: to the "
                        "right).",
        equation="M_x = -m_load g * {value} m from t = {onset}, and F_y = -m_load y'' as it moves",
        splits="roll and articulation after the instant, and the axle loads",
    )


EFFECT = _shift_of(None, "The load")
FOREMOST = _shift_of(0, "The foremost block of the load")
REARMOST = _shift_of(-1, "The rearmost block of the load")
