"""Which distortions are asked about: normal imperfections and candidate faults.

Every instrument has small errors; their usual size is the prior here, so that a mounting error
never becomes a fault. A fault is the same distortion without that prior.

References: sizes are judgements on a good test instrument that was zeroed at rest: what is left of
its zero (gyro 0.006 deg/s, accelerometer 0.006 m/s2) and of its mounting (0.05 deg), each twice on
the trailer; gain, timing and position of a good installation (0.1-0.5 %, 3 ms, 2 to 3 cm). Noise
and zero of a gyro go with its grade: data sheets of automotive gyros give a zero that drifts with
temperature by the rms noise or more, so noise beyond that of a good instrument is added to the
normal zero.
Validated with: test/diagnosis/test_sensors_gate.py.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from truck_blowout_sim.diagnosis.sensors.distortions import (
    Bias,
    Clock,
    Delay,
    Distortion,
    LevelAxes,
    LeverArm,
    RollLeak,
    Scale,
    Turn,
)
from truck_blowout_sim.diagnosis.sensors.identities import ARTICULATION, channel_names
from truck_blowout_sim.diagnosis.sensors.towed import ROLL
from truck_blowout_sim.recordings.gravity import AT_REST_MPS2

_GYRO_RADPS = float(np.radians(0.006))
_ACCELEROMETER_MPS2 = 0.006
_ANGLE_RAD = float(np.radians(0.05))
_GYRO_SCALE, _ACCELEROMETER_SCALE, _SPEED_SCALE = 0.002, 0.005, 0.001
# Where the angle was not recorded, gravity enters in proportion to the acceleration itself.
_UNKNOWN_TILT_SCALE = 0.3
# A roll reckoned from gyros misses what the frame twists: part of that is left.
_RECKONED_TILT_SCALE = 0.02
_DELAY_S = 0.003  # a good part of a sample, and unequal filters
# Loggers without a common clock: an uncompensated crystal and its software gain up to this.
_CLOCK = 1e-3
_POSITION_M, _HITCH_M = 0.02, 0.03
# Bodies that twist move like instruments half a metre higher or lower.
_HEIGHT_M = 0.5
_HUB_DELAY_S = 0.02  # wheels follow the road with the tire's own lag
_ARTICULATION_DELAY_S = 0.02  # judgement: the potentiometer has a filter and an input of its own
_ROLL_LEAK = 0.02
_LEVEL = 1.0  # logs seldom say whether a velocity is along level axes or the body's
_RADIUS_KNOWN, _RADIUS_UNKNOWN = 0.0015, 0.05
# A turning potentiometer at the kingpin: its zero is set by eye, its gain by its maker.
_ARTICULATION_ZERO_RAD, _ARTICULATION_SCALE = float(np.radians(0.5)), 0.01
_UNITS = ("tractor", "trailer")
_TRAILER_FACTOR = 2.0


@dataclass(frozen=True)
class Imperfection:
    """A distortion and how large it normally is (1 sigma of each parameter)."""

    distortion: Distortion
    usual: tuple[float, ...]


def imperfections(
    present: set[str], excess: Mapping[str, float], *, radius_known: bool, gravity_read: bool = True
) -> tuple[Imperfection, ...]:
    """Normal errors of the instruments whose channels were recorded.

    Args:
        present: channels recorded anywhere in the case.
        excess: of a channel's noise beyond a good instrument's, see ``noise.excess_noise``.
        radius_known: rolling radii come from baseline recordings of the same truck.
        gravity_read: accelerometers read gravity, so a tilt that was not recorded matters.
    """
    found: list[Imperfection] = []
    for unit in _UNITS:
        found += _unit_imperfections(unit, present, excess, gravity_read=gravity_read)
        hubs = tuple(sorted(c for c in present if c.startswith("hub_speed_")
                            and _hub_belongs(c, unit)))  # fmt: skip
        radius = _RADIUS_KNOWN if radius_known else _RADIUS_UNKNOWN
        found.append(Imperfection(Scale("rolling_radius", unit, f"{unit} hubs", hubs), (radius,)))
    bend = (ARTICULATION,)
    found += [
        Imperfection(Bias("angle_bias", "", "articulation", bend, "bias", "rad"),
                     (_ARTICULATION_ZERO_RAD,)),
        Imperfection(Scale("articulation_scale", "", "articulation", bend), (_ARTICULATION_SCALE,)),
        Imperfection(Delay("channel_delay", "", "articulation", bend), (_ARTICULATION_DELAY_S,)),
    ]  # fmt: skip
    hubs = tuple(sorted(c for c in present if c.startswith("hub_speed_")))
    found.append(Imperfection(Delay("channel_delay", "", "hub speeds", hubs), (_HUB_DELAY_S,)))
    found.append(Imperfection(_own_clock("trailer"), (_CLOCK,)))
    kept = [(i, _recorded(i.distortion, present)) for i in found]
    return tuple(Imperfection(d, i.usual) for i, d in kept if d is not None)


def candidates(present: set[str]) -> tuple[Distortion, ...]:
    """Faults worth asking about, for the channels that were recorded."""
    found: list[Distortion] = []
    for unit in _UNITS:
        found += _unit_candidates(unit)
    hubs = tuple(sorted(c for c in present if c.startswith("hub_speed_")))
    found.append(Delay("channel_delay", "", "hub speeds", hubs))
    kept: list[Distortion] = []
    seen: set[tuple[str, tuple[str, ...]]] = set()
    for wanted in found:
        distortion = _recorded(wanted, present)
        if distortion is None or (type(distortion).__name__, distortion.channels) in seen:
            continue
        roll = channel_names(distortion.unit or "tractor")["roll"]
        if isinstance(distortion, RollLeak) and roll not in present:
            continue
        seen.add((type(distortion).__name__, distortion.channels))
        kept.append(distortion)
    return tuple(kept)


def _unit_imperfections(unit: str, present: set[str], excess: Mapping[str, float], *,
                        gravity_read: bool) -> list[Imperfection]:
    n = channel_names(unit)
    k = _TRAILER_FACTOR if unit == "trailer" else 1.0
    accel = k * float(np.hypot(_ACCELEROMETER_MPS2, AT_REST_MPS2 * _ANGLE_RAD))

    def bias(name: str, key: str, si_unit: str) -> Bias:
        return Bias(name, unit, f"{unit} {key}", (n[key],), "bias", si_unit)

    def tilted(angle: str) -> float:
        reckoned = ROLL in present and n["vy"] not in present and unit == "trailer"
        if angle in present or not gravity_read:
            return _ACCELEROMETER_SCALE
        return _RECKONED_TILT_SCALE if reckoned and angle == n["roll"] else _UNKNOWN_TILT_SCALE

    found = [Imperfection(bias("yaw_rate_bias" if key == "r" else "gyro_bias", key, "rad/s"),
                          (float(np.hypot(k * _GYRO_RADPS, excess.get(n[key], 0.0))),))
             for key in ("p", "q", "r")]  # fmt: skip
    found += [Imperfection(bias("accelerometer_bias", key, "m/s2"), (accel,))
              for key in ("ax", "ay")]  # fmt: skip
    found += [Imperfection(bias("angle_bias", key, "rad"), (k * _ANGLE_RAD,))
              for key in ("roll", "pitch", "yaw")]  # fmt: skip
    turn = Turn("velocity_mounting", unit, f"{unit} velocity", (n["vx"], n["vy"]))
    level = LevelAxes("level_axes", unit, f"{unit} velocity", (n["vy"],))
    found += [Imperfection(turn, (k * _ANGLE_RAD,)), Imperfection(level, (_LEVEL,))]
    found += [
        Imperfection(_scale("yaw_rate_scale", unit, "r"), (_GYRO_SCALE,)),
        Imperfection(_scale("longitudinal_accel_scale", unit, "ax"), (tilted(n["pitch"]),)),
        Imperfection(_scale("lateral_accel_scale", unit, "ay"), (tilted(n["roll"]),)),
        Imperfection(_scale("speed_scale", unit, "vx"), (_SPEED_SCALE,)),
        Imperfection(RollLeak("lateral_accel_roll", unit, f"{unit} ay", (n["ay"],)), (_ROLL_LEAK,)),
    ]
    for label, keys in _delay_groups()[:5]:
        channels = tuple(n[key] for key in keys)
        delay = Delay("channel_delay", unit, f"{unit} {label}", channels)
        found.append(Imperfection(delay, (_DELAY_S,)))
    for label, keys, usual in (("accelerometer", ("ax", "ay", "az"), _POSITION_M),
                               ("velocity", ("vx", "vy"), _POSITION_M),
                               ("position", ("x", "y"), _HITCH_M)):  # fmt: skip
        channels = tuple(n[key] for key in keys)
        arm = LeverArm("lever_arm", unit, f"{unit} {label}", channels, ("forward", "left", "up"))
        found.append(Imperfection(arm, (usual, usual, _HEIGHT_M)))
    return found


def _unit_candidates(unit: str) -> list[Distortion]:
    n = channel_names(unit)
    found: list[Distortion] = [
        Bias("yaw_rate_bias", unit, f"{unit} yaw rate", (n["r"],), "bias", "rad/s"),
        _scale("yaw_rate_scale", unit, "r"),
        _scale("lateral_accel_scale", unit, "ay"),
        RollLeak("lateral_accel_roll", unit, f"{unit} ay", (n["ay"],)),
        _scale("speed_scale", unit, "vx"),
        Scale("speed_scale", unit, f"{unit} velocity", (n["vx"], n["vy"])),
    ]
    for label, keys in _delay_groups():
        channels = tuple(n[key] for key in keys)
        found.append(Delay("channel_delay", unit, f"{unit} {label}", channels))
    for label, keys in _lever_groups():
        channels = tuple(n[key] for key in keys)
        found.append(LeverArm("lever_arm", unit, f"{unit} {label}", channels))
    return found


def _delay_groups() -> tuple[tuple[str, tuple[str, ...]], ...]:
    """Instruments first, then what hangs on one box together, then single channels."""
    gyro, accelerometer, velocity = ("p", "q", "r"), ("ax", "ay", "az"), ("vx", "vy")
    position, attitude = ("x", "y"), ("roll", "pitch", "yaw")
    together = gyro + accelerometer + velocity + position + attitude
    singles = tuple((key, (key,)) for key in together)
    return (
        ("gyros", gyro), ("accelerometer", accelerometer), ("velocity", velocity),
        ("position", position), ("attitude", attitude),
        ("inertial unit (rates and accelerations)", gyro + accelerometer),
        ("satellite receiver (position and velocity)", position + velocity),
        ("odometry (position, velocity, attitude)", position + velocity + attitude),
        ("tilt angles", ("roll", "pitch")),
        ("whole instrument", together),
        *singles,
    )  # fmt: skip


def _lever_groups() -> tuple[tuple[str, tuple[str, ...]], ...]:
    accelerometer, velocity, position = ("ax", "ay", "az"), ("vx", "vy"), ("x", "y")
    return (
        ("accelerometer", accelerometer), ("velocity", velocity), ("position", position),
        ("velocity and accelerometer", velocity + accelerometer),
        ("position and velocity", position + velocity),
        ("whole instrument", position + velocity + accelerometer),
    )  # fmt: skip


def _own_clock(unit: str) -> Clock:
    """Of all instruments of one unit, against those of the other."""
    n = channel_names(unit)
    channels = tuple(n[key] for _, keys in _delay_groups() if len(keys) == 1 for key in keys)
    return Clock("clock", unit, f"{unit} clock", channels)


def _scale(name: str, unit: str, key: str) -> Scale:
    words = {"r": "yaw rate", "ay": "lateral acceleration", "ax": "longitudinal acceleration",
             "vx": "forward speed"}  # fmt: skip
    return Scale(name, unit, f"{unit} {words[key]}", (channel_names(unit)[key],))


def _recorded(distortion: Distortion, present: set[str]) -> Distortion | None:
    """The distortion restricted to recorded channels; ``None`` if nothing is left."""
    channels = tuple(c for c in distortion.channels if c in present)
    if not channels:
        return None
    values = {**distortion.__dict__, "channels": channels}
    return type(distortion)(**values)


def _hub_belongs(channel: str, unit: str) -> bool:
    return channel.startswith("hub_speed_trailer") == (unit == "trailer")
