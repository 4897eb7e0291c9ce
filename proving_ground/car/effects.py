"""Concealed effects of the car: through the foreign model's own numbers or beside it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from proving_ground.car.acts import Acts, still
from proving_ground.car.channels import WHEELS
from proving_ground.cases import EffectSpec
from proving_ground.effects.base import Active, EffectKind, Place, Setter, Strength

AXLES = (Place("tractor", "front"), Place("tractor", "rear"))
HUBS = tuple(Place("tractor", wheel.split("_", 1)[0], wheel) for wheel in WHEELS)
BODY, REAR, FRONT, ALL = (Place("tractor"),), (AXLES[1],), (AXLES[0],), (Place(),)


@dataclass(frozen=True)
class CarEffect(EffectSpec):
    """An effect of a case with the car."""

    @property
    def kind(self) -> EffectKind:
        """The family, listed or not."""
        return {**CAR_LISTED, **CAR_UNLISTED}[self.name]


def combine(actives: list[Active]) -> tuple[Acts, dict[str, float]]:
    """All that acts, and the factors on numbers of the tires."""
    base, tires = still(), {}
    values = base._asdict()
    for active in actives:
        for key, value in active.switches.items():
            if key == "tires":
                tires.update(value)
            elif key == "brake_gain":
                values[key] = values[key] * value
            elif isinstance(getattr(base, key), np.ndarray):
                values[key] = values[key] + value
            else:
                values[key] = value
    return Acts(**values), tires


def _end(place: Place, value: float) -> np.ndarray[Any, np.dtype[np.float64]]:
    return np.array([value, 0.0] if place.axle == "front" else [0.0, value])


def _saturation(s: float, place: Place, sign: float, when: float) -> Active:
    lost = float(np.clip(0.5 * s, 0.0, 0.7))
    return Active({"tires": {"p_dy1": 1.0 - lost}}, Strength("peak force lost", lost, "1"))


def _sharp(s: float, place: Place, sign: float, when: float) -> Active:
    """A curve that bends over early: another shape factor and peak, the slope kept."""
    lost = float(np.clip(0.4 * s, 0.0, 0.6))
    return Active({"tires": {"p_dy1": 1.0 - lost, "p_cy1": 1.0 + 0.3 * lost}},
                  Strength("peak force lost", lost, "1"))


def _friction(s: float, place: Place, sign: float, when: float) -> Active:
    lost = float(np.clip(0.75 * s, 0.0, 0.85))
    return Active({"slippery_x_m": when,
                   "tires": {"later_p_dy1": 1.0 - lost, "later_p_dx1": 1.0 - lost}},
                  Strength("friction lost", lost, "1"), onset_x_m=when)


def _drag(s: float, place: Place, sign: float, when: float) -> Active:
    area = sign * s * (2.0 if sign > 0.0 else 0.25)
    return Active({"drag_area": area}, Strength("extra drag area", area, "m2"))


def _slow_drag(s: float, place: Place, sign: float, when: float) -> Active:
    area = sign * s * (2.0 if sign > 0.0 else 0.25)
    return Active({"drag_area": area, "drag_exponent": 1.6},
                  Strength("extra drag area", area, "m2"))


def _slope(key: str, words: str, length_m: float, size: float) -> Setter:
    def setter(s: float, place: Place, sign: float, when: float) -> Active:
        slope = sign * size * s
        return Active({key: slope, "slope_x_m": when, "slope_length_m": length_m},
                      Strength(words, slope, "rad"), onset_x_m=when)

    return setter


def _wind(steady: bool) -> Setter:
    def setter(s: float, place: Place, sign: float, when: float) -> Active:
        speed = sign * 20.0 * s
        return Active({"gust_mps": speed, "gust_s": when, "gust_length_s": 2.5,
                       "gust_steady": steady}, Strength("peak wind", speed, "m/s"), when)

    return setter


def _retarder(at_mps: float) -> Setter:
    def setter(s: float, place: Place, sign: float, when: float) -> Active:
        return Active({"retarder_n": 2000.0 * s, "retarder_at_mps": at_mps},
                      Strength("retarding force", 2000.0 * s, "N"))

    return setter


def _imbalance(s: float, place: Place, sign: float, when: float) -> Active:
    gain = float(np.clip(1.0 + s * (0.8 if sign > 0.0 else -0.85), 0.0, 3.0))
    gains = np.ones(4)
    gains[WHEELS.index(place.hub or "")] = gain
    return Active({"brake_gain": gains}, Strength("torque ratio to a sound brake", gain, "1"))


def _lag(s: float, place: Place, sign: float, when: float) -> Active:
    late = max(0.5 * s, 0.004)
    return Active({"brake_lag_s": _end(place, late)}, Strength("extra lag", late, "s"))


def _fade(s: float, place: Place, sign: float, when: float) -> Active:
    lost = float(np.clip(0.85 * s, 0.0, 0.95))
    return Active({"fade": _end(place, lost)}, Strength("torque lost when hot", lost, "1"))


def _steering(stages: int) -> Setter:
    def setter(s: float, place: Place, sign: float, when: float) -> Active:
        late = max(0.4 * s, 0.004)
        return Active({"steer_lag_s": late, "steer_lag_stages": stages},
                      Strength("lag", late, "s"))

    return setter


def _ratio(key: str) -> Setter:
    def setter(s: float, place: Place, sign: float, when: float) -> Active:
        more, far = sign * 0.3 * s, ", far out," if key == "ratio_bend" else ""
        return Active({key: more}, Strength(f"road wheels turn more{far} by", more, "1"))

    return setter


def _one(key: str, size: float, words: str, unit: str) -> Setter:
    def setter(s: float, place: Place, sign: float, when: float) -> Active:
        return Active({key: size * s}, Strength(words, size * s, unit))

    return setter


def _bearing(s: float, place: Place, sign: float, when: float) -> Active:
    return Active({"drag_wheel": WHEELS.index(place.hub or ""), "drag_nm": 500.0 * s},
                  Strength("drag moment", 500.0 * s, "N m"))


def _kinds(*kinds: EffectKind) -> dict[str, EffectKind]:
    return {kind.name: kind for kind in kinds}


CAR_LISTED = _kinds(
    EffectKind("tire_saturation", _saturation, ALL, "hard", guess=100.0, others=(_sharp,)),
    EffectKind("friction_change", _friction, ALL, "hard", event=True, guess=60.0, end=1.1),
    EffectKind("aerodynamic_drag", _drag, BODY, "coast", signed=True, guess=60.0,
               others=(_slow_drag,), end=2.0),
    EffectKind("road_grade", _slope("grade", "grade, uphill", 20.0, 0.03), ALL, "straight",
               signed=True, event=True, guess=170.0, end=2.0,
               others=(_slope("grade", "grade, uphill", 4.0, 0.03),)),
    EffectKind("road_bank", _slope("bank", "cross slope, left side up", 20.0, 0.03), ALL,
               "straight", signed=True, event=True, guess=100.0, end=2.0,
               others=(_slope("bank", "cross slope, left side up", 6.0, 0.03),)),
    EffectKind("crosswind", _wind(False), BODY, "any", signed=True, event=True, guess=40.0,
               others=(_wind(True),), end=1.5),
    EffectKind("driveline_drag", _retarder(0.0), REAR, "coast", guess=200.0,
               others=(_retarder(14.0),), end=1.5),
    EffectKind("brake_imbalance", _imbalance, HUBS, "brake", signed=True, guess=200.0, end=1.18),
    EffectKind("brake_lag", _lag, AXLES, "brake", guess=300.0, end=1.0),
    EffectKind("brake_fade", _fade, AXLES, "brake", guess=80.0),
    EffectKind("steering_lag", _steering(1), FRONT, "steer", guess=400.0, others=(_steering(2),),
               end=0.8),
    EffectKind("steering_ratio", _ratio("ratio_error"), FRONT, "steer", signed=True, guess=200.0,
               others=(_ratio("ratio_bend"),)),
)
CAR_UNLISTED = _kinds(
    EffectKind("torque_oscillation", _one("shuffle_n", 1500.0, "drive force amplitude", "N"),
               REAR, "any", guess=60.0),
    EffectKind("corner_drag", _one("corner_n", 1200.0, "drag at 25 m/s", "N"), BODY, "any",
               guess=100.0),
    EffectKind("seizing_bearing", _bearing, HUBS, "any", guess=150.0, end=4.0),
    EffectKind("wake_oscillation", _one("wake_n", 900.0, "side force at 25 m/s", "N"), BODY,
               "any", guess=60.0),
)
