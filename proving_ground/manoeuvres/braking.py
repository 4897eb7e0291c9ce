"""Straight-line braking."""

from __future__ import annotations

import numpy as np

from proving_ground.manoeuvres.shapes import ALL, mph
from proving_ground.task import Braking, Manoeuvre


def braking_trailer(rng: np.random.Generator) -> Manoeuvre:
    """Trailer brakes only, held to the end."""
    pressure = float(rng.uniform(150.0e3, 240.0e3))
    return Manoeuvre("braking_trailer", "straight-line braking", mph(rng, 42, 56), 12.0,
                     release_s=2.0, brakings=(Braking(3.0, 1.0e9, pressure),))


def braking_all(rng: np.random.Generator) -> Manoeuvre:
    """All axles braked, held to the end."""
    pressure = float(rng.uniform(140.0e3, 210.0e3))
    groups = ("steer", "drive", "trailer")
    return Manoeuvre("braking_all", "straight-line braking", mph(rng, 45, 58), 12.0,
                     release_s=2.0, brakings=(Braking(3.0, 1.0e9, pressure, groups),))


def braking_steps(rng: np.random.Generator) -> Manoeuvre:
    """All axles for two seconds, then the trailer alone."""
    first = Braking(3.0, 5.0, float(rng.uniform(140.0e3, 210.0e3)), ("steer", "drive", "trailer"))
    second = Braking(7.5, 10.0, float(rng.uniform(170.0e3, 260.0e3)))
    return Manoeuvre("braking_steps", "straight-line braking", mph(rng, 48, 58), 13.0,
                     release_s=2.0, brakings=(first, second))


def braking_ramp(rng: np.random.Generator) -> Manoeuvre:
    """All axles, pressure raised in four stairs."""
    top = float(rng.uniform(180.0e3, 240.0e3))
    groups = ("steer", "drive", "trailer")
    stairs = tuple(Braking(2.5 + 1.5 * k, 1.0e9, 0.25 * top, groups) for k in range(4))
    return Manoeuvre("braking_ramp", "straight-line braking", mph(rng, 48, 58), 12.0,
                     release_s=1.8, brakings=stairs)


def braking_pulses(rng: np.random.Generator) -> Manoeuvre:
    """Three short applications of all brakes."""
    pressure = float(rng.uniform(170.0e3, 240.0e3))
    pulses = tuple(Braking(at, at + 1.4, pressure, ALL) for at in (3.0, 5.8, 8.6))
    return Manoeuvre("braking_pulses", "straight-line braking in pulses", mph(rng, 48, 58), 12.5,
                     release_s=2.0, brakings=pulses)


def braking_release(rng: np.random.Generator) -> Manoeuvre:
    """All brakes together for three seconds, then rolling, then the drive axles alone."""
    first = Braking(3.0, 6.0, float(rng.uniform(150.0e3, 220.0e3)), ALL)
    second = Braking(8.5, 11.0, float(rng.uniform(160.0e3, 220.0e3)), ("drive",))
    return Manoeuvre("braking_release", "straight-line braking, released, braked again",
                     mph(rng, 48, 58), 12.5, release_s=2.0, brakings=(first, second))


def braking_swap(rng: np.random.Generator) -> Manoeuvre:
    """The tractor's brakes, then those of the trailer, then both."""
    pressure, brakes = float(rng.uniform(150.0e3, 210.0e3)), []
    for start, end, groups in ((2.8, 5.0, ("steer", "drive")), (6.0, 8.2, ("trailer",)),
                               (9.2, 11.0, ALL)):
        brakes.append(Braking(start, end, pressure, groups))
    return Manoeuvre("braking_swap", "straight-line braking, axle by axle", mph(rng, 48, 58), 12.5,
                     release_s=1.9, brakings=tuple(brakes))


def braking_growing(rng: np.random.Generator) -> Manoeuvre:
    """All brakes three times, each time harder."""
    top = float(rng.uniform(190.0e3, 240.0e3))
    brakes = tuple(Braking(at, at + 1.8, share * top, ALL)
                   for at, share in ((2.8, 0.45), (5.6, 0.7), (8.4, 1.0)))
    return Manoeuvre("braking_growing", "straight-line braking, harder each time",
                     mph(rng, 50, 58), 12.0, release_s=1.9, brakings=brakes)


def braking_taper(rng: np.random.Generator) -> Manoeuvre:
    """All brakes, let go in three stairs."""
    top = float(rng.uniform(190.0e3, 240.0e3))
    stairs = tuple(Braking(2.6, end, share * top, ALL)
                   for end, share in ((4.6, 0.4), (6.8, 0.3), (9.4, 0.3)))
    return Manoeuvre("braking_taper", "straight-line braking, let go in stairs", mph(rng, 50, 58),
                     12.0, release_s=1.8, brakings=stairs)


def braking_added(rng: np.random.Generator) -> Manoeuvre:
    """The drive axles' brakes, then the steer axle's with them, then the trailer's too."""
    pressure = float(rng.uniform(150.0e3, 210.0e3))
    brakes = tuple(Braking(start, 9.6, pressure, (group,))
                   for start, group in ((2.8, "drive"), (4.8, "steer"), (6.8, "trailer")))
    return Manoeuvre("braking_added", "straight-line braking, axle added to axle",
                     mph(rng, 50, 58), 12.0, release_s=1.9, brakings=brakes)
