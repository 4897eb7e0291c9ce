"""Effects in the tires, blown and sound."""

from __future__ import annotations

import numpy as np

from proving_ground.effects.base import (
    Active,
    EffectKind,
    Place,
    Strength,
    at_axle,
    at_tire,
    tire_index,
)
from proving_ground.laws import usual

STEER_TIRES = (at_tire("steer_left"), at_tire("steer_right"))
LATER_TIRES = tuple(at_tire(name) for name in (
    "steer_right", "drive_1_left_outer", "drive_2_right_outer", "trailer_1_left_outer",
    "trailer_2_right_outer"))

GROUP_AXLES = {"steer": [0], "drive": [1, 2], "trailer": [3, 4]}


def _drag(s: float, place: Place, sign: float, when: float) -> Active:
    """Rubbing that builds up over the first 12 m and grows with speed and, weakly, load."""
    extra = sign * s * (0.20 if sign > 0.0 else 0.12)
    return Active({"flat_drag": extra}, Strength("extra rolling resistance", extra, "N/N"), when)


def _cornering(s: float, place: Place, sign: float, when: float) -> Active:
    """The flat keeps more of its slope, and of its peak with it; it has hardly any to lose."""
    more = 0.80 * s
    kept = min(usual().flat_keeps + more, 1.0)
    return Active({"flat_cornering": more}, Strength("cornering kept by the flat", kept, "1"),
                  when)


def _slow(s: float, place: Place, sign: float, when: float) -> Active:
    """A smaller hole that tears open over a second."""
    scale = float(1.0 / (1.0 + 14.0 * s))
    return Active({"hole_scale": scale, "hole_growth_s": 1.0 * min(s, 1.0)},
                  Strength("hole area ratio", scale, "1"), when)


def _second(s: float, place: Place, sign: float, when: float) -> Active:
    """Another tire loses its air by itself, through a hole of another size."""
    hole = 0.0018 * s
    return Active({"second_tire": tire_index(place), "second_time_s": when,
                   "second_hole_m2": hole}, Strength("hole area", hole, "m2"), when)


def _relaxation(s: float, place: Place, sign: float, when: float) -> Active:
    """A longer relaxation length, more so under load."""
    return Active({"relaxation": 2.5 * s}, Strength("relaxation length ratio", 1 + 1.7 * s, "1"))


def _relaxation_even(s: float, place: Place, sign: float, when: float) -> Active:
    """A relaxation length that is longer by one factor at every load."""
    return Active({"relaxation": 2.0 * s, "relaxation_even": True},
                  Strength("relaxation length ratio", 1 + 2.0 * s, "1"))


def _even_drag(s: float, place: Place, sign: float, when: float) -> Active:
    """Another rolling resistance on the rim from the first turn on, whatever speed and load."""
    extra = sign * s * (0.20 if sign > 0.0 else 0.08)
    return Active({"flat_drag": extra, "flat_drag_even": True},
                  Strength("extra rolling resistance", extra, "N/N"), when)


def _small_hole(s: float, place: Place, sign: float, when: float) -> Active:
    """A smaller hole, as small from the first instant."""
    scale = float(1.0 / (1.0 + 14.0 * s))
    return Active({"hole_scale": scale}, Strength("hole area ratio", scale, "1"), when)


def _torn_open(s: float, place: Place, sign: float, when: float) -> Active:
    """A hole of the usual size that tears open slowly."""
    growth = 4.0 * s
    return Active({"hole_growth_s": growth}, Strength("time to tear open", growth, "s"), when)


def _sudden_friction(s: float, place: Place, sign: float, when: float) -> Active:
    """The road is slippery from one line on."""
    lost = float(np.clip(0.75 * s, 0.0, 0.85))
    return Active({"friction_drop": lost, "friction_x_m": when, "friction_length_m": 0.5},
                  Strength("friction lost", lost, "1"), onset_x_m=when)


def _saturation(s: float, place: Place, sign: float, when: float) -> Active:
    """The peak falls, and with it all but the first part of the curve."""
    lost = float(np.clip(0.65 * s, 0.0, 0.85))
    sizes = np.zeros(5)
    sizes[GROUP_AXLES[place.axle or ""]] = lost
    return Active({"saturation": sizes}, Strength("peak force lost", lost, "1"))


def _friction(s: float, place: Place, sign: float, when: float) -> Active:
    """The road turns slippery from some place on, over a few metres."""
    lost = float(np.clip(0.75 * s, 0.0, 0.85))
    return Active({"friction_drop": lost, "friction_x_m": when},
                  Strength("friction lost", lost, "1"), onset_x_m=when)


TIRES_EFFECTS = (
    EffectKind("blown_tire_drag", _drag, STEER_TIRES, "blowout", signed=True, guess=100.0,
               others=(_even_drag,), end=1.6),
    EffectKind("blown_tire_cornering", _cornering, STEER_TIRES, "blowout",
               guess=9.0),
    EffectKind("slow_deflation", _slow, STEER_TIRES, "blowout", lowest=0.004, guess=3200.0,
               others=(_small_hole, _torn_open), end=1.5),
    EffectKind("secondary_blowout", _second, LATER_TIRES, "any", event=True,
               lowest=0.15, guess=25.0),
    EffectKind("tire_relaxation", _relaxation, (Place(),), "quick steer", guess=95.0,
               others=(_relaxation_even,)),
    EffectKind("tire_saturation", _saturation,
               tuple(at_axle(group) for group in GROUP_AXLES), "hard steer", guess=50.0),
    EffectKind("friction_change", _friction, (Place(),), "limit", event=True, guess=40.0,
               others=(_sudden_friction,), end=1.1),
)
