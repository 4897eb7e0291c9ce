"""Effects in steering, axles, driveline and coupling."""

from __future__ import annotations

import numpy as np

from proving_ground.effects.base import (
    Active,
    EffectKind,
    Place,
    Strength,
    at_axle,
    axle_index,
    only,
)

DEG = float(np.pi / 180.0)
STEER = (at_axle("steer"),)
ALL_AXLES = tuple(at_axle(name) for name in
                  ("steer", "drive_1", "drive_2", "trailer_1", "trailer_2"))


def _compliance(s: float, place: Place, sign: float, when: float) -> Active:
    """A linkage that is soft at first and hardens as it winds up."""
    soft = float(np.clip(0.85 * s, 0.0, 0.95))
    return Active({"linkage_soft": soft, "linkage_harden": 18.0},
                  Strength("stiffness lost at small moments", soft, "1"))


def _lash(s: float, place: Place, sign: float, when: float) -> Active:
    """More play, with dry friction inside it."""
    half = 8.0 * s * DEG
    return Active({"lash_half_rad": half / 22.0, "lash_friction": 18.0 * min(s, 1.0)},
                  Strength("extra play at the hand wheel", 2.0 * half, "rad"))


def _roll_steer(s: float, place: Place, sign: float, when: float) -> Active:
    """Steer that grows faster than roll."""
    size = sign * 0.35 * s
    return Active({"roll_steer": only(5, axle_index(place), size)},
                  Strength("roll steer", size, "rad/rad"))


def _misalign(s: float, place: Place, sign: float, when: float) -> Active:
    """A thrust line turned for good."""
    angle = sign * 0.8 * DEG * s
    return Active({"misalign": only(5, axle_index(place), angle)},
                  Strength("thrust angle", angle, "rad"))


def _driveline(s: float, place: Place, sign: float, when: float) -> Active:
    """A hydraulic retarder: fills in a third of a second, fades out at low speed."""
    force = 9000.0 * s
    return Active({"retarder_n": force}, Strength("retarding force at 22 m/s", 0.955 * force, "N"))


def _fifth_wheel(s: float, place: Place, sign: float, when: float) -> Active:
    """A dry plate: sticks harder than it slides."""
    moment = 25.0e3 * s
    return Active({"hitch_friction": moment}, Strength("sliding moment", moment, "N m"))


def _payload(s: float, place: Place, sign: float, when: float) -> Active:
    """The rear block slides aside: hastens, then brakes against its chains."""
    shift = sign * 0.6 * s
    return Active({"shift_m": shift, "shift_s": when, "shift_length_s": 0.7},
                  Strength("lateral shift of 5967 kg", shift, "m"), when)


def _linear_compliance(s: float, place: Place, sign: float, when: float) -> Active:
    """A linkage that is softer by one factor."""
    soft = float(np.clip(0.75 * s, 0.0, 0.9))
    return Active({"linkage_soft": soft, "linkage_harden": 0.0},
                  Strength("stiffness lost", soft, "1"))


def _loose_lash(s: float, place: Place, sign: float, when: float) -> Active:
    """More play, nothing in it."""
    half = 8.0 * s * DEG
    return Active({"lash_half_rad": half / 22.0},
                  Strength("extra play at the hand wheel", 2.0 * half, "rad"))


def _engine_drag(s: float, place: Place, sign: float, when: float) -> Active:
    """An engine brake: the same force at every speed."""
    force = 9000.0 * s
    return Active({"retarder_n": force, "retarder_at_mps": 0.0},
                  Strength("retarding force at 22 m/s", force, "N"))


def _greased_plate(s: float, place: Place, sign: float, when: float) -> Active:
    """A plate that slides as hard as it sticks."""
    moment = 25.0e3 * s
    return Active({"hitch_friction": moment, "hitch_sticking": 0.0},
                  Strength("sliding moment", moment, "N m"))


def _slow_shift(s: float, place: Place, sign: float, when: float) -> Active:
    """The rear block creeps aside."""
    shift = sign * 0.6 * s
    return Active({"shift_m": shift, "shift_s": when, "shift_length_s": 2.5},
                  Strength("lateral shift of 5967 kg", shift, "m"), when)


def _steering_lag(s: float, place: Place, sign: float, when: float) -> Active:
    """An actuator that follows the hand wheel as one first-order lag."""
    late = max(0.5 * s, 0.005)
    return Active({"steer_lag_s": late, "steer_lag_stages": 1}, Strength("lag", late, "s"))


def _steering_lag_twice(s: float, place: Place, sign: float, when: float) -> Active:
    """A column and a hydraulic gear in series: two first-order lags."""
    late = max(0.5 * s, 0.005)
    return Active({"steer_lag_s": late, "steer_lag_stages": 2}, Strength("lag", late, "s"))


def _steering_ratio(s: float, place: Place, sign: float, when: float) -> Active:
    """A gear of another ratio: the road wheels turn more or less."""
    more = sign * 0.30 * s
    return Active({"ratio_error": more}, Strength("road wheels turn more by", more, "1"))


def _steering_bend(s: float, place: Place, sign: float, when: float) -> Active:
    """A gear whose ratio changes away from straight ahead."""
    more = sign * 0.40 * s
    return Active({"ratio_bend": more}, Strength("road wheels turn more, far out, by", more, "1"))


RUNNING_GEAR = (
    EffectKind("steering_compliance", _compliance, STEER, "kingpin", guess=55.0,
               others=(_linear_compliance,), end=1.1),
    EffectKind("steering_lash", _lash, STEER, "small steer", guess=100.0, others=(_loose_lash,)),
    EffectKind("roll_steer", _roll_steer, ALL_AXLES[:3], "hard steer", signed=True, guess=25.0),
    EffectKind("axle_misalignment", _misalign, ALL_AXLES, "any", signed=True, guess=60.0),
    EffectKind("driveline_drag", _driveline, (Place("tractor", "drive"),), "coast", guess=190.0,
               others=(_engine_drag,), end=2.0),
    EffectKind("fifth_wheel_friction", _fifth_wheel, (Place(),), "steer", guess=220.0,
               others=(_greased_plate,), end=1.0),
    EffectKind("payload_shift", _payload, (Place("trailer"),), "any", signed=True, event=True,
               guess=55.0, others=(_slow_shift,), end=1.5),
)
GEAR = (
    EffectKind("steering_lag", _steering_lag, STEER, "quick steer", guess=200.0,
               others=(_steering_lag_twice,), end=1.0),
    EffectKind("steering_ratio", _steering_ratio, STEER, "steer", signed=True, guess=100.0,
               others=(_steering_bend,), end=1.0),
)
