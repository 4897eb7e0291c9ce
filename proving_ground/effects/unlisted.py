"""Effects that no list of names holds: a diagnosis must say that it does not know them."""

from __future__ import annotations

import numpy as np

from proving_ground.effects.base import (
    Active,
    EffectKind,
    Place,
    Strength,
    at_axle,
    at_hub,
    hub_index,
)


def _wake(s: float, place: Place, sign: float, when: float) -> Active:
    """The trailer's wake swings from side to side at its Strouhal frequency."""
    return Active({"wake": 0.8 * s}, Strength("side-force coefficient", 0.8 * s, "1"))


def _slosh(s: float, place: Place, sign: float, when: float) -> Active:
    """A tank of liquid swings across the trailer."""
    return Active({"slosh": np.array([5500.0 * s, 3.4, 0.06])},
                  Strength("swinging mass", 5500.0 * s, "kg"))


def _flap(s: float, place: Place, sign: float, when: float) -> Active:
    """A loose tread beats the road once a turn."""
    return Active({"flap_hub": hub_index(place), "flap_n": 16.0e3 * s},
                  Strength("blow", 16.0e3 * s, "N"))


def _shuffle(s: float, place: Place, sign: float, when: float) -> Active:
    """Engine torque swings, with a beat."""
    return Active({"shuffle_n": 9000.0 * s, "shuffle_hz": 1.7},
                  Strength("drive force amplitude", 9000.0 * s, "N"))


def _chute(s: float, place: Place, sign: float, when: float) -> Active:
    """A torn tarpaulin or chain trails from a rear corner."""
    return Active({"chute_area": 7.0 * s, "chute_y_m": 1.25 * sign},
                  Strength("drag area", 7.0 * s, "m2"))


def _rut(s: float, place: Place, sign: float, when: float) -> Active:
    """Worn tracks guide the tires."""
    return Active({"rut": 0.035 * s, "rut_wave_m": 0.8},
                  Strength("guidance force over load", 0.035 * s, "N/N"))


def _bearing(s: float, place: Place, sign: float, when: float) -> Active:
    """A bearing that seizes and frees again drags one hub."""
    return Active({"bearing_hub": hub_index(place), "bearing_nm": 3500.0 * s},
                  Strength("drag moment", 3500.0 * s, "N m"))


def _leak(s: float, place: Place, sign: float, when: float) -> Active:
    """Air springs on one side have lost pressure; the tractor leans."""
    return Active({"leak_n": 9000.0 * s}, Strength("lost spring load", 9000.0 * s, "N"))


UNLISTED: dict[str, EffectKind] = {kind.name: kind for kind in (
    EffectKind("wake_oscillation", _wake, (Place("trailer"),), "any", guess=13.0),
    EffectKind("sloshing_load", _slosh, (Place("trailer"),), "quick steer", guess=22.0),
    EffectKind("tread_flap", _flap, tuple(at_hub(h) for h in (
        "steer_left", "drive_1_right", "trailer_1_left")), "any", guess=300.0),
    EffectKind("torque_oscillation", _shuffle, (at_axle("drive"),), "any", guess=115.0),
    EffectKind("corner_drag", _chute, (Place("trailer"),), "any", signed=True, guess=47.0),
    EffectKind("rut_guidance", _rut, (Place(),), "quick steer", guess=94.0),
    EffectKind("seizing_bearing", _bearing, tuple(at_hub(h) for h in (
        "drive_2_left", "trailer_1_right", "trailer_2_left")), "any", guess=316.0),
    EffectKind("air_spring_leak", _leak, (at_axle("drive"),), "any", guess=22.0),
)}
