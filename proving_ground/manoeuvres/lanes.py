"""From one lane to another and back: single and repeated evasions."""

from __future__ import annotations

import numpy as np

from proving_ground.manoeuvres.shapes import (
    FROM_THERE,
    eased,
    mph,
    one_sine,
    sign_of,
    through,
    waves,
)
from proving_ground.task import Manoeuvre


def lane_change(rng: np.random.Generator) -> Manoeuvre:
    """One sine of hand wheel, then the new lane is held."""
    speed, sign = mph(rng, 42, 54), float(rng.choice([-1.0, 1.0]))
    period = float(rng.uniform(2.4, 3.0))
    amplitude = sign * float(rng.uniform(0.9, 1.2)) * (22.0 / speed) ** 2
    return Manoeuvre("lane_change", "single lane change", speed, 13.0,
                     one_sine(2.5, period, amplitude), (2.4, 2.5 + period + 1.0), sign * 2.3)


def double_lane_change(rng: np.random.Generator) -> Manoeuvre:
    """Out and back again, harder."""
    speed, sign = mph(rng, 42, 52), float(rng.choice([-1.0, 1.0]))
    period = float(rng.uniform(2.3, 2.8))
    amplitude = sign * float(rng.uniform(1.2, 1.6)) * (22.0 / speed) ** 2
    first = one_sine(2.5, period, amplitude)
    second = one_sine(2.5 + period + 0.8, period, -amplitude)
    return Manoeuvre("double_lane_change", "double lane change", speed, 14.0,
                     lambda t: first(t) + second(t), (2.4, 2.5 + 2.0 * period + 1.8))


def hard_double(rng: np.random.Generator) -> Manoeuvre:
    """Out and back, as hard as an evasion."""
    speed, sign = mph(rng, 44, 52), float(rng.choice([-1.0, 1.0]))
    period = float(rng.uniform(2.6, 3.0))
    amplitude = sign * float(rng.uniform(2.0, 2.3)) * (22.0 / speed) ** 2
    first = one_sine(2.5, period, amplitude)
    second = one_sine(2.5 + period + 0.8, period, -amplitude)
    return Manoeuvre("hard_double", "double lane change", speed, 14.0,
                     lambda t: first(t) + second(t), (2.4, 2.5 + 2.0 * period + 1.8))


def _swerve(kind: str, speed: float, angle: float, pause_s: float) -> Manoeuvre:
    """Quickly to one side, straight for a while, quickly back."""
    one = (2.5, 2.9, 3.5, 4.3, 4.9, 5.3)
    two = tuple(2.8 + pause_s + time for time in one)
    shape = (0.0, angle, angle, -angle, -angle, 0.0)
    return Manoeuvre(kind, "swerved to one side and back after a while", speed, two[-1] + 3.0,
                     through((*one, *two), (*shape, *(-x for x in shape))),
                     (2.4, two[-1] + 0.5))


def swerve_and_return(rng: np.random.Generator) -> Manoeuvre:
    """Round something on the road, and back into the lane."""
    speed = mph(rng, 40, 50)
    angle = sign_of(rng) * float(rng.uniform(0.8, 1.1)) * (22.0 / speed) ** 2
    return _swerve("swerve_and_return", speed, angle, float(rng.uniform(0.6, 1.4)))


def hard_swerve(rng: np.random.Generator) -> Manoeuvre:
    """The same as hard as an evasion."""
    speed = mph(rng, 42, 50)
    angle = sign_of(rng) * float(rng.uniform(1.55, 1.8)) * (22.0 / speed) ** 2
    return _swerve("hard_swerve", speed, angle, float(rng.uniform(0.6, 1.4)))


def sine_dwell(rng: np.random.Generator) -> Manoeuvre:
    """One sine of the hand wheel whose second peak is held for a while."""
    speed, period = mph(rng, 40, 50), float(rng.uniform(2.2, 2.6))
    amplitude = sign_of(rng) * float(rng.uniform(1.0, 1.3)) * (22.0 / speed) ** 2
    dwell = float(rng.uniform(0.6, 0.9))

    def program(time_s: float) -> float:
        s = (time_s - 2.5) / period
        if s > 0.75:
            s = max(0.75, s - dwell / period)
        return amplitude * float(np.sin(2.0 * np.pi * s)) if 0.0 <= s <= 1.0 else 0.0

    return Manoeuvre("sine_dwell", "sine with dwell", speed, 12.5, program,
                     (2.4, 3.0 + period + dwell))


def slalom(rng: np.random.Generator) -> Manoeuvre:
    """Three waves of the hand wheel."""
    speed, period = mph(rng, 40, 50), float(rng.uniform(2.6, 3.4))
    amplitude = sign_of(rng) * float(rng.uniform(0.95, 1.3)) * (22.0 / speed) ** 2
    return Manoeuvre("slalom", "three waves of the hand wheel", speed, 14.0,
                     waves(2.0, period, 3.0, amplitude), (1.9, 2.5 + 3.0 * period))


def hard_slalom(rng: np.random.Generator) -> Manoeuvre:
    """Two waves of the hand wheel, as hard as an evasion."""
    speed, period = mph(rng, 42, 50), float(rng.uniform(2.8, 3.2))
    amplitude = sign_of(rng) * float(rng.uniform(1.8, 2.05)) * (22.0 / speed) ** 2
    return Manoeuvre("hard_slalom", "two waves of the hand wheel", speed, 12.5,
                     waves(2.5, period, 2.0, amplitude), (2.4, 3.0 + 2.0 * period))


def slow_drift(rng: np.random.Generator) -> Manoeuvre:
    """Drifting over the lane and back with a hand wheel that hardly moves."""
    speed = mph(rng, 40, 56)
    size = sign_of(rng) * float(rng.uniform(0.22, 0.34)) * (22.0 / speed)
    return Manoeuvre("slow_drift", "drifting over the lane and back", speed, 14.0,
                     eased((1.6, 2.8, 4.2, 6.0, 8.7, 10.5, 11.9),
                            (0.0, size, size, -size, -size, size, 0.0)), (1.5, FROM_THERE))
