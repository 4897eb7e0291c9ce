"""What a finding says to a person: sentence, equation, and the run that would decide.

Validated with: test/diagnosis/test_sensors_words.py.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from truck_blowout_sim.diagnosis.algebra.quantiles import NINETY
from truck_blowout_sim.diagnosis.sensors.distortions import Convention, Distortion

_EQUATIONS = {
    "channel_sign": "measured = -true",
    "channel_swap": "first_measured = second, second_measured = first",
    "gravity_convention": "a_measured = a_stated +- g along the axis",
    "yaw_rate_bias": "r_measured = r + bias",
    "yaw_rate_scale": "r_measured = (1 + scale_error) r",
    "lateral_accel_scale": "ay_measured = (1 + scale_error) ay",
    "lateral_accel_roll": "ay_measured = ay + roll_leak g sin(roll)",
    "speed_scale": "vx_measured = (1 + scale_error) vx",
    "steering_angle_offset": "wheel_measured = wheel + offset",
    "channel_delay": "measured(t) = true(t - delay)",
    "lever_arm": "v_measured = v + w x l;  a_measured = a + dw/dt x l + w x (w x l);  x = x + R l",
}

_TESTS = {
    "channel_sign": "turn left slowly by hand: which channels go up tells which are inverted",
    "channel_swap": "tilt or turn the instrument about one axis at a time, standing; for hub "
    "speeds, turn one wheel by hand, off the ground",
    "gravity_convention": "stand still on a slope: an accelerometer that reads gravity shows it",
    "yaw_rate_bias": "stand still or drive straight for 20 s: a bias stays, a gain error vanishes",
    "yaw_rate_scale": "turn a known angle (full circle): the integrated yaw rate shows the gain",
    "lateral_accel_scale": "steady circle at two speeds with roll angle recorded",
    "lateral_accel_roll": "stand on a cross slope of known angle, or circle slowly: roll without "
    "lateral acceleration",
    "speed_scale": "drive a measured distance straight, with positions or free-rolling hub speeds",
    "steering_angle_offset": "drive straight in both directions of the same road, hands still",
    "channel_delay": "fast sine sweep of the hand wheel (0.5-1.3 Hz): a lag grows with frequency",
    "lever_arm": "lane change or sine sweep (yaw acceleration without speed change) and a steady "
    "circle with positions recorded",
}

_PAIR_TESTS = {
    frozenset(("yaw_rate_scale", "yaw_rate_bias")): _TESTS["yaw_rate_bias"],
    frozenset(("yaw_rate_scale", "speed_scale")): "record positions or headings in a steady circle",
    frozenset(("lateral_accel_scale", "lateral_accel_roll")): _TESTS["lateral_accel_roll"],
    frozenset(("lateral_accel_scale", "speed_scale")): _TESTS["speed_scale"],
    frozenset(("lever_arm", "channel_delay")): "sine sweeps at two amplitudes and speeds: a lever "
    "arm's error follows yaw acceleration, a delay's follows the rate of every signal",
    frozenset(("lever_arm", "lateral_accel_scale")): "steady circle: without yaw acceleration only "
    "the gain shows",
}


def equation(name: str) -> str:
    """The fault as a formula."""
    return _EQUATIONS[name]


def next_test(name: str, aliases: Sequence[str]) -> str:
    """The run that would split a fault from its aliases, or confirm it if it has none."""
    for other in aliases:
        if other != name:
            return _PAIR_TESTS.get(frozenset((name, other)), f"{_TESTS[name]}; {_TESTS[other]}")
    return _TESTS[name]


def sentence(
    distortion: Distortion, amounts: Sequence[float], sigmas: Sequence[float],
    shown_parameters: Sequence[int] | None = None,
) -> str:  # fmt: skip
    """One sentence with the amount in units a person reads."""
    where = distortion.instrument or "instrument"
    kept = range(len(amounts)) if shown_parameters is None else shown_parameters
    names = distortion.parameters
    if isinstance(distortion, Convention):
        return f"{_SAYINGS[distortion.name].format(where=where)}."
    shown = [f"{names[k][0]} {_shown(amounts[k], sigmas[k], names[k][1])}" for k in kept]
    return f"{_SAYINGS[distortion.name].format(where=where)}: {', '.join(shown)}."


_SAYINGS = {
    "channel_sign": "The {where} is recorded with the opposite sign",
    "channel_swap": "The channels {where} are exchanged",
    "gravity_convention": "The {where} do not treat gravity as the recording says",
    "yaw_rate_bias": "The {where} reads off by a constant",
    "yaw_rate_scale": "The {where} has a wrong gain",
    "lateral_accel_scale": "The {where} has a wrong gain",
    "lateral_accel_roll": "Body roll leaks gravity into {where}",
    "speed_scale": "The {where} has a wrong gain",
    "steering_angle_offset": "The {where} zero is off",
    "channel_delay": "The {where} arrives late",
    "lever_arm": "The {where} does not sit where it is said to sit",
}


def _shown(value: float, sigma: float, unit: str) -> str:
    factor, name = {
        "rad/s": (float(np.degrees(1.0)), "deg/s"), "rad": (float(np.degrees(1.0)), "deg"),
        "1": (100.0, "%"), "s": (1000.0, "ms"), "m": (1.0, "m"),
    }[unit]  # fmt: skip
    return f"{factor * value:.3g} {name} (90 %: +-{NINETY * factor * sigma:.2g})"
