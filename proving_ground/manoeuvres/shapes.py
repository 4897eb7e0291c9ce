"""What several manoeuvres are put together from: speeds, signs, hand-wheel programs."""

from __future__ import annotations

import math

import numpy as np

from proving_ground.task import Program

MPH_MPS = 0.44704
ALL = ("steer", "drive", "trailer")
FROM_THERE = 1.0e9


def mph(rng: np.random.Generator, low: float, high: float) -> float:
    """A speed between two, given in miles an hour, in m/s."""
    return float(rng.uniform(low, high)) * MPH_MPS


def sign_of(rng: np.random.Generator) -> float:
    """To the left or to the right."""
    return float(rng.choice([-1.0, 1.0]))


def through(times_s: tuple[float, ...], angles_rad: tuple[float, ...]) -> Program:
    """Straight from one angle to the next."""
    return lambda time_s: float(np.interp(time_s, times_s, angles_rad))


def eased(times_s: tuple[float, ...], angles_rad: tuple[float, ...]) -> Program:
    """From one angle to the next as half a cosine, without a corner."""
    def program(time_s: float) -> float:
        k = int(np.clip(np.searchsorted(times_s, time_s) - 1, 0, len(times_s) - 2))
        share = float(np.clip((time_s - times_s[k]) / (times_s[k + 1] - times_s[k]), 0.0, 1.0))
        return angles_rad[k] + (angles_rad[k + 1] - angles_rad[k]) * 0.5 * (
            1.0 - float(np.cos(np.pi * share)))

    return program


def one_sine(start: float, period: float, amplitude: float) -> Program:
    """One sine of an angle, nothing before and after."""
    def program(time_s: float) -> float:
        s = (time_s - start) / period
        return amplitude * math.sin(2.0 * math.pi * s) if 0.0 <= s <= 1.0 else 0.0

    return program


def waves(start_s: float, period_s: float, count: float, amplitude_rad: float) -> Program:
    """So many whole sines, the first and last one rising and falling over half a second."""
    end_s = start_s + count * period_s

    def program(time_s: float) -> float:
        fade = float(np.clip(min(time_s - start_s, end_s - time_s) / 0.5, 0.0, 1.0))
        return amplitude_rad * fade * float(np.sin(2.0 * np.pi * (time_s - start_s) / period_s))

    return program


def bumps(at_s: tuple[float, ...], width_s: float, amplitudes_rad: tuple[float, ...]) -> Program:
    """Half sines of the hand wheel, one after the other."""
    def program(time_s: float) -> float:
        return sum(size * float(np.sin(np.pi * (time_s - at) / width_s))
                   for at, size in zip(at_s, amplitudes_rad, strict=True)
                   if 0.0 <= time_s - at <= width_s)

    return program
