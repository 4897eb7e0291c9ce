"""Effects of air and road."""

from __future__ import annotations

from proving_ground.effects.base import Active, EffectKind, Place, Strength, only

BODIES = (Place("tractor"), Place("trailer"))


def _wind(s: float, place: Place, sign: float, when: float) -> Active:
    """A 1-cos gust; the force follows the true angle and speed of the air."""
    speed = sign * 16.0 * s
    tractor = place.body == "tractor"
    return Active({"gust_mps": speed, "gust_s": when, "gust_length_s": 3.0,
                   "gust_body": 0 if tractor else 1, "gust_x_m": 1.2 if tractor else 6.5},
                  Strength("peak wind", speed, "m/s"), when)


def _drag(s: float, place: Place, sign: float, when: float) -> Active:
    """Drag that grows a little faster than speed squared."""
    area = sign * s * (6.0 if sign > 0.0 else 3.0)
    unit = 0 if place.body == "tractor" else 1
    return Active({"drag_area": only(2, unit, area)}, Strength("extra drag area", area, "m2"))


def _grade(s: float, place: Place, sign: float, when: float) -> Active:
    """A slope entered over 50 m."""
    slope = sign * 0.03 * s
    return Active({"grade": slope, "slope_x_m": when, "slope_length_m": 50.0},
                  Strength("grade, uphill", slope, "rad"), onset_x_m=when)


def _bank(s: float, place: Place, sign: float, when: float) -> Active:
    """A cross slope entered over 50 m."""
    slope = sign * 0.03 * s
    return Active({"bank": slope, "slope_x_m": when, "slope_length_m": 50.0},
                  Strength("cross slope, left side up", slope, "rad"), onset_x_m=when)


def _lasting_wind(s: float, place: Place, sign: float, when: float) -> Active:
    """A cross wind that sets in, lasts four seconds and goes."""
    speed = sign * 14.0 * s
    tractor = place.body == "tractor"
    return Active({"gust_mps": speed, "gust_s": when, "gust_length_s": 4.0, "gust_steady": True,
                   "gust_body": 0 if tractor else 1, "gust_x_m": 1.2 if tractor else 6.5},
                  Strength("peak wind", speed, "m/s"), when)


def _short_grade(s: float, place: Place, sign: float, when: float) -> Active:
    """A slope with a short bend of the road before it."""
    slope = sign * 0.04 * s
    return Active({"grade": slope, "slope_x_m": when, "slope_length_m": 10.0},
                  Strength("grade, uphill", slope, "rad"), onset_x_m=when)


def _short_bank(s: float, place: Place, sign: float, when: float) -> Active:
    """A cross slope with a short twist of the road before it."""
    slope = sign * 0.03 * s
    return Active({"bank": slope, "slope_x_m": when, "slope_length_m": 20.0},
                  Strength("cross slope, left side up", slope, "rad"), onset_x_m=when)


OUTSIDE = (
    EffectKind("crosswind", _wind, BODIES, "any", signed=True, event=True, guess=13.0,
               others=(_lasting_wind,), end=2.0),
    EffectKind("aerodynamic_drag", _drag, BODIES, "coast", signed=True, guess=50.0),
    EffectKind("road_grade", _grade, (Place(),), "straight", signed=True, event=True, guess=170.0,
               others=(_short_grade,), end=2.0),
    EffectKind("road_bank", _bank, (Place(),), "straight", signed=True, event=True, guess=104.0,
               others=(_short_bank,), end=2.0),
)
