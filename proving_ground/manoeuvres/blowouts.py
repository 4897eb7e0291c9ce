"""A tire blown on a straight, and what the driver does then."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from proving_ground.manoeuvres.shapes import eased, mph
from proving_ground.task import Braking, Manoeuvre


def blowout(rng: np.random.Generator, tires: tuple[str, ...] = ("steer_left",)) -> Manoeuvre:
    """A tire blown on a straight; the driver corrects, releases, and brakes the trailer."""
    at = round(float(rng.uniform(3.0, 4.0)), 2)
    brake = Braking(at + 5.0, 1.0e9, float(rng.uniform(180.0e3, 240.0e3)))
    return Manoeuvre("blowout", "straight, tire blown, driver corrects, then brakes",
                     mph(rng, 47, 55), 13.0, release_s=at + 3.2, brakings=(brake,),
                     blowout_s=at, blown=tires, reaction_s=float(rng.uniform(0.55, 0.8)))


def blowout_free(rng: np.random.Generator, tires: tuple[str, ...] = ("steer_left",)) -> Manoeuvre:
    """A tire blown on a straight; the hand wheel is held still."""
    at = round(float(rng.uniform(3.0, 4.0)), 2)
    return Manoeuvre("blowout_free", "straight, tire blown, hand wheel held", mph(rng, 45, 54),
                     at + 3.5, blowout_s=at, blown=tires, corrects=False)


def blowout_brake(rng: np.random.Generator,
                  tires: tuple[str, ...] = ("steer_left",)) -> Manoeuvre:
    """A tire blown on a straight; the driver lifts off at once and brakes all axles gently."""
    at = round(float(rng.uniform(3.0, 4.0)), 2)
    groups = ("steer", "drive", "trailer")
    brake = Braking(at + 3.5, 1.0e9, float(rng.uniform(110.0e3, 150.0e3)), groups)
    return Manoeuvre("blowout_brake", "straight, tire blown, driver corrects, then brakes",
                     mph(rng, 40, 52), 12.0, release_s=at + 1.2, brakings=(brake,),
                     blowout_s=at, blown=tires, reaction_s=float(rng.uniform(0.55, 0.8)))


def blowout_hold(rng: np.random.Generator, tires: tuple[str, ...] = ("steer_left",)) -> Manoeuvre:
    """A tire blown on a straight; the driver corrects and keeps the speed."""
    at = round(float(rng.uniform(3.0, 4.0)), 2)
    return Manoeuvre("blowout_hold", "straight, tire blown, driver corrects, speed held",
                     mph(rng, 42, 54), 12.0, blowout_s=at, blown=tires,
                     reaction_s=float(rng.uniform(0.55, 0.8)))


def blowout_coast(rng: np.random.Generator, tires: tuple[str, ...] = ("steer_left",)) -> Manoeuvre:
    """A tire blown on a straight; the driver corrects, lifts off and lets the truck roll."""
    at = round(float(rng.uniform(3.0, 4.0)), 2)
    return Manoeuvre("blowout_coast", "straight, tire blown, driver corrects and lets it roll",
                     mph(rng, 45, 55), 13.0, release_s=at + float(rng.uniform(0.8, 1.6)),
                     blowout_s=at, blown=tires, reaction_s=float(rng.uniform(0.55, 0.8)))


def blowout_slow_hands(rng: np.random.Generator,
                       tires: tuple[str, ...] = ("steer_left",)) -> Manoeuvre:
    """A tire blown on a straight; the driver needs a second and more, and lifts off late."""
    at = round(float(rng.uniform(3.0, 4.0)), 2)
    return Manoeuvre("blowout_slow_hands", "straight, tire blown, driver corrects late",
                     mph(rng, 42, 52), 13.0, release_s=at + float(rng.uniform(4.0, 5.5)),
                     blowout_s=at, blown=tires, reaction_s=float(rng.uniform(0.95, 1.15)))


def blowout_dab(rng: np.random.Generator, tires: tuple[str, ...] = ("steer_left",)) -> Manoeuvre:
    """A tire blown on a straight; the driver corrects, lifts off and dabs the trailer brakes."""
    at = round(float(rng.uniform(3.0, 4.0)), 2)
    dab = Braking(at + 3.8, at + 5.6, float(rng.uniform(130.0e3, 190.0e3)))
    return Manoeuvre("blowout_dab", "straight, tire blown, driver corrects, a dab of the brakes",
                     mph(rng, 45, 55), 12.5, release_s=at + float(rng.uniform(1.5, 2.5)),
                     brakings=(dab,), blowout_s=at, blown=tires,
                     reaction_s=float(rng.uniform(0.55, 0.8)))


def _blowout(rng: np.random.Generator, tires: tuple[str, ...], reaction_s: tuple[float, float]
             ) -> Manoeuvre:
    at = round(float(rng.uniform(3.0, 4.0)), 2)
    return Manoeuvre("", "", mph(rng, 42, 54), at + 10.0, blowout_s=at, blown=tires,
                     reaction_s=float(rng.uniform(*reaction_s)))


def blowout_pull_over(rng: np.random.Generator,
                      tires: tuple[str, ...] = ("steer_left",)) -> Manoeuvre:
    """A tire blown on a straight; the driver corrects, lifts off and pulls over to the right."""
    task = _blowout(rng, tires, (0.55, 0.8))
    at, size = task.blowout_s, -float(rng.uniform(0.35, 0.5)) * (22.0 / task.speed_mps)
    over = eased((at + 5.0, at + 5.8, at + 7.2, at + 8.0), (0.0, size, -size, 0.0))
    return replace(task, kind="blowout_pull_over", release_s=at + float(rng.uniform(1.5, 2.5)),
                   words="straight, tire blown, driver corrects and pulls over", program=over,
                   open_loop=(at + 5.0, at + 8.0), lane_after_m=-1.2)


def blowout_quick_hands(rng: np.random.Generator,
                        tires: tuple[str, ...] = ("steer_left",)) -> Manoeuvre:
    """A tire blown on a straight; the driver corrects at once and soon brakes the trailer twice."""
    task = _blowout(rng, tires, (0.4, 0.5))
    at, pressure = task.blowout_s, float(rng.uniform(120.0e3, 180.0e3))
    return replace(task, kind="blowout_quick_hands", release_s=at + 1.0,
                   words="straight, tire blown, driver corrects at once, brakes twice",
                   brakings=(Braking(at + 2.5, at + 4.0, pressure),
                             Braking(at + 6.0, at + 8.0, pressure)))
