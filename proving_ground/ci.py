"""The set `ci`: 24 small cases of every group, cheap enough to be diagnosed in every check.

One training, one baseline and one holdout run each, on manoeuvres of the development set, every
effect well visible. A guard against getting worse, no proof: it is seen all the time.
"""

from __future__ import annotations

from proving_ground.cases import CaseSpec, EffectSpec, FaultSpec, check

SIGMA = 40.0
FIRST_SEED = 20_001          # between those of the development set and those of the test set

# Baseline, training, holdout.
_SWEEP = ("lane_change", "sine_sweep", "ramp_hold")
_STEER = ("sine_sweep", "lane_change", "ramp_hold")
_HARD = ("lane_change", "hard_ramp", "sine_sweep")
_BRAKE = ("coast_down", "braking_all", "braking_trailer")
_COAST = ("braking_all", "coast_down", "braking_trailer")
_STRAIGHT = ("lane_change", "straight", "coast_down")
_BLOWOUT = ("lane_change", "blowout", "blowout")


def _effect(name: str, place: int = 0, sign: float = 1.0) -> EffectSpec:
    return EffectSpec(name, place, sign, SIGMA)


def _fault(name: str, place: int = 0, sign: float = 1.0) -> FaultSpec:
    return FaultSpec(name, place, sign, SIGMA)


Row = tuple[str, tuple[str, str, str], tuple[EffectSpec | FaultSpec, ...]]
ROWS: tuple[Row, ...] = (
    ("null", _SWEEP, ()),
    ("null", _STEER, ()),
    ("null", _BRAKE, ()),
    ("null", _COAST, ()),
    ("null", _STRAIGHT, ()),
    ("null", _BLOWOUT, ()),
    ("single", _SWEEP, (_effect("steering_lash"),)),
    ("single", _STEER, (_effect("fifth_wheel_friction"),)),
    ("single", _HARD, (_effect("tire_saturation", 2),)),
    ("single", _SWEEP, (_effect("axle_misalignment", 3, -1.0),)),
    ("single", _STRAIGHT, (_effect("payload_shift"),)),
    ("single", _STRAIGHT, (_effect("road_grade", 0, -1.0),)),
    ("single", _COAST, (_effect("driveline_drag"),)),
    ("single", _BRAKE, (_effect("brake_imbalance", 8, -1.0),)),
    ("single", _BRAKE, (_effect("brake_lag", 2),)),
    ("single", _BLOWOUT, (_effect("slow_deflation", 1),)),
    ("pair", _BRAKE, (_effect("brake_imbalance", 2), _effect("driveline_drag"))),
    ("pair", _STEER, (_effect("fifth_wheel_friction"), _fault("speed_scale"))),
    ("sensor", _SWEEP, (_fault("yaw_rate_scale"),)),
    ("sensor", _STEER, (_fault("lateral_accel_scale", 1, -1.0),)),
    ("sensor", _STRAIGHT, (_fault("speed_scale", 0, -1.0),)),
    ("sensor", _STEER, (_fault("channel_delay", 1),)),
    ("unknown", _STRAIGHT, (_effect("wake_oscillation"),)),
    ("unknown", _SWEEP, (_effect("rut_guidance"),)),
)


def ci_cases() -> list[CaseSpec]:
    """All cases of the set."""
    return [_case(FIRST_SEED + k, *row) for k, row in enumerate(ROWS)]


def _case(seed: int, group: str, kinds: tuple[str, str, str],
          causes: tuple[EffectSpec | FaultSpec, ...]) -> CaseSpec:
    baseline, train, holdout = kinds
    return check(CaseSpec(
        f"ci-{seed}", group, seed, (baseline,), (train,), (holdout,),
        tuple(cause for cause in causes if isinstance(cause, EffectSpec)),
        tuple(cause for cause in causes if isinstance(cause, FaultSpec))))
