"""Holding a lane, rolling, coasting."""

from __future__ import annotations

import numpy as np

from proving_ground.manoeuvres.shapes import ALL, mph
from proving_ground.task import Braking, Manoeuvre


def straight(rng: np.random.Generator) -> Manoeuvre:
    """Holding lane and speed at 35 to 60 mph."""
    return Manoeuvre("straight", "straight, speed held", mph(rng, 35, 60), 12.0)


def coast_down(rng: np.random.Generator) -> Manoeuvre:
    """Throttle released on a straight."""
    return Manoeuvre("coast_down", "straight, throttle released", mph(rng, 50, 60), 15.0,
                     release_s=float(rng.uniform(1.5, 2.5)))


def coast_slow(rng: np.random.Generator) -> Manoeuvre:
    """Throttle released on a straight, at lower speed."""
    return Manoeuvre("coast_slow", "straight, throttle released", mph(rng, 30, 40), 15.0,
                     release_s=float(rng.uniform(1.5, 2.5)))


def speed_step(rng: np.random.Generator) -> Manoeuvre:
    """Speed held, then throttle released in the middle of the run."""
    return Manoeuvre("speed_step", "straight, speed held, then throttle released",
                     mph(rng, 38, 58), 14.0, release_s=float(rng.uniform(6.0, 7.5)))


def late_release(rng: np.random.Generator) -> Manoeuvre:
    """Speed held for most of the run, the throttle released late."""
    return Manoeuvre("late_release", "straight, speed held, throttle released late",
                     mph(rng, 34, 60), 14.0, release_s=float(rng.uniform(9.0, 10.5)))


def coast_then_brake(rng: np.random.Generator) -> Manoeuvre:
    """Throttle released, then the trailer braked lightly."""
    pressure = float(rng.uniform(90.0e3, 130.0e3))
    return Manoeuvre("coast_then_brake", "straight, throttle released, then a light brake",
                     mph(rng, 40, 52), 14.0, release_s=float(rng.uniform(1.5, 2.5)),
                     brakings=(Braking(9.5, 1.0e9, pressure),))


def roll_out(rng: np.random.Generator) -> Manoeuvre:
    """Speed held for some seconds, then the throttle released for the rest."""
    return Manoeuvre("roll_out", "straight, throttle released", mph(rng, 41, 49), 14.0,
                     release_s=float(rng.uniform(3.5, 5.0)))


def dab_and_roll(rng: np.random.Generator) -> Manoeuvre:
    """A short light dab of all brakes, then rolling."""
    dab = Braking(2.5, 3.7, float(rng.uniform(100.0e3, 140.0e3)), ALL)
    return Manoeuvre("dab_and_roll", "straight, a dab of the brakes, then rolling",
                     mph(rng, 44, 60), 14.0, release_s=1.8, brakings=(dab,))


def dragging_brake(rng: np.random.Generator) -> Manoeuvre:
    """Speed held against trailer brakes that are lightly on for a while."""
    start = float(rng.uniform(4.0, 5.0))
    drag = Braking(start, start + 4.0, float(rng.uniform(60.0e3, 90.0e3)))
    return Manoeuvre("dragging_brake", "straight, speed held against a light brake",
                     mph(rng, 38, 56), 13.5, brakings=(drag,))


def roll_and_dabs(rng: np.random.Generator) -> Manoeuvre:
    """Rolling, with two short light dabs of all brakes."""
    pressure = float(rng.uniform(100.0e3, 140.0e3))
    return Manoeuvre("roll_and_dabs", "straight, rolling, two dabs of the brakes",
                     mph(rng, 46, 60), 14.5, release_s=float(rng.uniform(0.8, 1.4)),
                     brakings=(Braking(6.0, 6.9, pressure, ALL), Braking(9.5, 10.4, pressure, ALL)))
