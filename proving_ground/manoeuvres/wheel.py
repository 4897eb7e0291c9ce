"""The hand wheel moved for its own sake: sweeps, waves, triangles, pulses, stairs."""

from __future__ import annotations

import math

import numpy as np

from proving_ground.manoeuvres.shapes import bumps, mph, sign_of, through, waves
from proving_ground.task import Manoeuvre


def sine_sweep(rng: np.random.Generator) -> Manoeuvre:
    """Hand-wheel sweep from 0.15 to 1.3 Hz."""
    speed = mph(rng, 38, 52)
    amplitude = float(rng.uniform(0.35, 0.6)) * (22.0 / speed)
    span = 11.0

    def program(time_s: float) -> float:
        t = min(max(time_s - 1.5, 0.0), span)
        phase = 2.0 * math.pi * (0.15 * t + 0.5 * (1.3 - 0.15) / span * t * t)
        fade = min(1.0, t / 0.5, (span - t) / 0.5)
        return amplitude * math.sin(phase) * fade

    return Manoeuvre("sine_sweep", "sine sweep of the hand wheel, 0.15-1.3 Hz", speed, 14.0,
                     program, (1.4, 13.0))


def random_steer(rng: np.random.Generator) -> Manoeuvre:
    """Several sines of hand wheel at once, 0.1 to 1 Hz."""
    speed = mph(rng, 36, 54)
    hertz = rng.uniform([0.10, 0.25, 0.45, 0.75], [0.20, 0.40, 0.70, 1.0])
    phase = rng.uniform(0.0, 2.0 * np.pi, 4)
    parts = np.array([0.30, 0.30, 0.25, 0.2]) * (22.0 / speed)

    def program(time_s: float) -> float:
        fade = float(np.clip(min(time_s - 1.5, 12.5 - time_s), 0.0, 1.0))
        return fade * float(parts @ np.sin(2.0 * np.pi * hertz * time_s + phase))

    return Manoeuvre("random_steer", "hand wheel in several sines at once", speed, 13.5,
                     program, (1.4, 12.6))


def weave(rng: np.random.Generator) -> Manoeuvre:
    """Small slow waves about straight ahead."""
    speed, period = mph(rng, 38, 54), float(rng.uniform(3.2, 4.8))
    amplitude = sign_of(rng) * float(rng.uniform(0.25, 0.4)) * (22.0 / speed)
    return Manoeuvre("weave", "small waves of the hand wheel", speed, 14.0,
                     waves(1.5, period, 11.0 / period, amplitude), (1.4, 12.7))


def growing_triangles(rng: np.random.Generator) -> Manoeuvre:
    """Triangles of the hand wheel to both sides, each one larger."""
    speed = mph(rng, 38, 52)
    size = sign_of(rng) * float(rng.uniform(0.8, 1.1)) * (22.0 / speed)
    times, angles = [2.0], [0.0]
    for k in range(5):
        times += [times[-1] + 0.9, times[-1] + 1.8]
        angles += [(-1.0) ** k * size * (k + 1) / 5.0, 0.0]
    return Manoeuvre("growing_triangles", "triangles of the hand wheel, each one larger", speed,
                     14.0, through(tuple(times), tuple(angles)), (1.9, 11.8))


def stairs_steer(rng: np.random.Generator) -> Manoeuvre:
    """The hand wheel turned in three stairs."""
    speed = mph(rng, 26, 36)
    angle = sign_of(rng) * float(rng.uniform(1.6, 2.3)) * (13.0 / speed) ** 2
    return Manoeuvre("stairs_steer", "hand wheel turned in three stairs", speed, 13.0,
                     through((2.0, 2.5, 5.0, 5.5, 8.0, 8.5),
                             (0.0, angle / 3, angle / 3, 2 * angle / 3, 2 * angle / 3, angle)),
                     (1.9, 1.0e9))


def pulse_steer(rng: np.random.Generator) -> Manoeuvre:
    """One pulse of the hand wheel to each side, some seconds apart."""
    speed, width = mph(rng, 40, 50), float(rng.uniform(1.0, 1.5))
    size = sign_of(rng) * float(rng.uniform(1.1, 1.5)) * (22.0 / speed) ** 2
    return Manoeuvre("pulse_steer", "a pulse of the hand wheel to each side", speed, 12.5,
                     bumps((2.5, 7.0), width, (size, -size)), (2.4, 10.5))


def small_pulses(rng: np.random.Generator) -> Manoeuvre:
    """Small pulses of the hand wheel about straight ahead."""
    speed = mph(rng, 38, 54)
    size = sign_of(rng) * float(rng.uniform(0.35, 0.55)) * (22.0 / speed)
    return Manoeuvre("small_pulses", "small pulses of the hand wheel", speed, 14.0,
                     bumps((2.0, 4.2, 7.0, 9.2), float(rng.uniform(0.9, 1.3)),
                            (size, -size, -size, size)), (1.9, 12.0))
