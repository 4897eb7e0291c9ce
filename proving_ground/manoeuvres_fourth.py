"""What a driver sets out to do in the present test set: kinds that nobody developed against."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from proving_ground.manoeuvres_more import ALL, mph, sign_of, through
from proving_ground.task import Braking, Manoeuvre, Program

FROM_THERE = 1.0e9


def _eased(times_s: tuple[float, ...], angles_rad: tuple[float, ...]) -> Program:
    """From one angle to the next as half a cosine, without a corner."""
    def program(time_s: float) -> float:
        k = int(np.clip(np.searchsorted(times_s, time_s) - 1, 0, len(times_s) - 2))
        share = float(np.clip((time_s - times_s[k]) / (times_s[k + 1] - times_s[k]), 0.0, 1.0))
        return angles_rad[k] + (angles_rad[k + 1] - angles_rad[k]) * 0.5 * (
            1.0 - float(np.cos(np.pi * share)))

    return program


def _tightening(kind: str, speed: float, angle: float) -> Manoeuvre:
    """Into a turn without a corner, and after some seconds further into it."""
    return Manoeuvre(kind, "into a turn that tightens", speed, 13.0,
                     _eased((1.6, 4.0, 6.6, 9.0), (0.0, 0.6 * angle, 0.6 * angle, angle)),
                     (1.5, FROM_THERE))


def _swerve(kind: str, speed: float, angle: float, pause_s: float) -> Manoeuvre:
    """Quickly to one side, straight for a while, quickly back."""
    one = (2.5, 2.9, 3.5, 4.3, 4.9, 5.3)
    two = tuple(2.8 + pause_s + time for time in one)
    shape = (0.0, angle, angle, -angle, -angle, 0.0)
    return Manoeuvre(kind, "swerved to one side and back after a while", speed, two[-1] + 3.0,
                     through((*one, *two), (*shape, *(-x for x in shape))),
                     (2.4, two[-1] + 0.5))


def tightening_turn(rng: np.random.Generator) -> Manoeuvre:
    """Gently into a turn, then further into it."""
    speed = mph(rng, 27, 37)
    return _tightening("tightening_turn", speed,
                       sign_of(rng) * float(rng.uniform(1.8, 2.4)) * (13.0 / speed) ** 2)


def hard_tightening(rng: np.random.Generator) -> Manoeuvre:
    """The same until the truck corners hard."""
    speed = mph(rng, 29, 35)
    return _tightening("hard_tightening", speed,
                       sign_of(rng) * float(rng.uniform(3.5, 4.0)) * (13.0 / speed) ** 2)


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


def lift_in_turn(rng: np.random.Generator) -> Manoeuvre:
    """A steady turn in the middle of which the throttle is released."""
    speed = mph(rng, 32, 42)
    angle = sign_of(rng) * float(rng.uniform(1.4, 1.9)) * (16.0 / speed) ** 2
    return Manoeuvre("lift_in_turn", "steady turn, throttle released in it", speed, 13.0,
                     _eased((1.6, 3.0), (0.0, angle)), (1.5, FROM_THERE),
                     release_s=float(rng.uniform(6.0, 7.0)))


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


def slow_drift(rng: np.random.Generator) -> Manoeuvre:
    """Drifting over the lane and back with a hand wheel that hardly moves."""
    speed = mph(rng, 40, 56)
    size = sign_of(rng) * float(rng.uniform(0.22, 0.34)) * (22.0 / speed)
    return Manoeuvre("slow_drift", "drifting over the lane and back", speed, 14.0,
                     _eased((1.6, 2.8, 4.2, 6.0, 8.7, 10.5, 11.9),
                            (0.0, size, size, -size, -size, size, 0.0)), (1.5, FROM_THERE))


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
    over = _eased((at + 5.0, at + 5.8, at + 7.2, at + 8.0), (0.0, size, -size, 0.0))
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
