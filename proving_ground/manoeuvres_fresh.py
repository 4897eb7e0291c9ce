"""Still more of what a driver can set out to do: the kinds of the third lot."""

from __future__ import annotations

import numpy as np

from proving_ground.manoeuvres_more import ALL, mph, sign_of, through
from proving_ground.task import Braking, Manoeuvre, Program


def _bumps(at_s: tuple[float, ...], width_s: float, amplitudes_rad: tuple[float, ...]) -> Program:
    """Half sines of the hand wheel, one after the other."""
    def program(time_s: float) -> float:
        return sum(size * float(np.sin(np.pi * (time_s - at) / width_s))
                   for at, size in zip(at_s, amplitudes_rad, strict=True)
                   if 0.0 <= time_s - at <= width_s)

    return program


def _hook(kind: str, speed: float, times_s: tuple[float, ...], first: float, second: float
          ) -> Manoeuvre:
    """Steered to one side by the first angle, then to the other by the second, which is held."""
    return Manoeuvre(kind, "steered to one side, then to the other and held", speed, 12.0,
                     through(times_s, (0.0, first, first, -second)), (2.4, 1.0e9))


def _two_bends(kind: str, speed: float, angle: float, times_s: tuple[float, ...]) -> Manoeuvre:
    """Into one bend and through it, over into the other, and out."""
    return Manoeuvre(kind, "through two bends", speed, 13.0,
                     through(times_s, (0.0, angle, angle, -angle, -angle, 0.0)), (1.7, 1.0e9))


def fishhook(rng: np.random.Generator) -> Manoeuvre:
    """A quick steer to one side, then to the other, which is held."""
    speed, dwell = mph(rng, 28, 36), float(rng.uniform(0.6, 1.2))
    angle = sign_of(rng) * float(rng.uniform(1.3, 1.9)) * (14.0 / speed) ** 2
    turn = 3.1 + dwell
    return _hook("fishhook", speed, (2.5, 3.1, turn, turn + 1.2), angle, angle)


def hard_fishhook(rng: np.random.Generator) -> Manoeuvre:
    """The same until the truck corners hard."""
    speed = mph(rng, 29, 35)
    angle = sign_of(rng) * float(rng.uniform(3.6, 4.1)) * (13.0 / speed) ** 2
    return _hook("hard_fishhook", speed, (2.5, 3.4, 4.4, 6.4), 0.8 * angle, angle)


def s_bend(rng: np.random.Generator) -> Manoeuvre:
    """Through a bend to one side and one to the other."""
    speed = mph(rng, 34, 44)
    angle = sign_of(rng) * float(rng.uniform(1.2, 1.7)) * (16.0 / speed) ** 2
    return _two_bends("s_bend", speed, angle, (1.8, 3.2, 5.2, 8.0, 10.0, 11.4))


def hard_s_bend(rng: np.random.Generator) -> Manoeuvre:
    """Through two narrow bends, fast."""
    speed = mph(rng, 31, 37)
    angle = sign_of(rng) * float(rng.uniform(3.3, 3.7)) * (14.0 / speed) ** 2
    return _two_bends("hard_s_bend", speed, angle, (1.8, 3.6, 5.2, 8.4, 10.0, 11.6))


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
                     _bumps((2.5, 7.0), width, (size, -size)), (2.4, 10.5))


def small_pulses(rng: np.random.Generator) -> Manoeuvre:
    """Small pulses of the hand wheel about straight ahead."""
    speed = mph(rng, 38, 54)
    size = sign_of(rng) * float(rng.uniform(0.35, 0.55)) * (22.0 / speed)
    return Manoeuvre("small_pulses", "small pulses of the hand wheel", speed, 14.0,
                     _bumps((2.0, 4.2, 7.0, 9.2), float(rng.uniform(0.9, 1.3)),
                            (size, -size, -size, size)), (1.9, 12.0))


def roll_out(rng: np.random.Generator) -> Manoeuvre:
    """Speed held for some seconds, then the throttle released for the rest."""
    return Manoeuvre("roll_out", "straight, throttle released", mph(rng, 41, 49), 14.0,
                     release_s=float(rng.uniform(3.5, 5.0)))


def dab_and_roll(rng: np.random.Generator) -> Manoeuvre:
    """A short light dab of all brakes, then rolling."""
    dab = Braking(2.5, 3.7, float(rng.uniform(100.0e3, 140.0e3)), ALL)
    return Manoeuvre("dab_and_roll", "straight, a dab of the brakes, then rolling",
                     mph(rng, 44, 60), 14.0, release_s=1.8, brakings=(dab,))


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
