"""Into a turn: ramps, steps, hooks and bends."""

from __future__ import annotations

import numpy as np

from proving_ground.manoeuvres.shapes import FROM_THERE, eased, mph, sign_of, through
from proving_ground.task import Manoeuvre


def ramp_hold(rng: np.random.Generator) -> Manoeuvre:
    """Hand wheel ramped to an angle and held, 24 to 34 mph."""
    speed, sign = mph(rng, 24, 34), float(rng.choice([-1.0, 1.0]))
    angle = sign * float(rng.uniform(1.5, 2.4)) * (13.0 / speed) ** 2
    return Manoeuvre("ramp_hold", "ramp-and-hold steer", speed, 12.0,
                     lambda t: angle * min(1.0, max(0.0, (t - 2.0) / 1.2)), (1.9, 1.0e9))


def hard_ramp(rng: np.random.Generator) -> Manoeuvre:
    """Hand wheel ramped to an angle that takes the truck to about a third of a g."""
    speed, sign = mph(rng, 28, 34), float(rng.choice([-1.0, 1.0]))
    angle = sign * float(rng.uniform(2.9, 3.4)) * (13.0 / speed) ** 2
    return Manoeuvre("hard_ramp", "ramp-and-hold steer", speed, 12.0,
                     lambda t: angle * min(1.0, max(0.0, (t - 2.0) / 1.6)), (1.9, 1.0e9))


def slow_ramp(rng: np.random.Generator) -> Manoeuvre:
    """Hand wheel turned slowly into a turn."""
    speed, sign = mph(rng, 30, 42), float(rng.choice([-1.0, 1.0]))
    rate = sign * float(rng.uniform(0.14, 0.20)) * (16.0 / speed) ** 2
    return Manoeuvre("slow_ramp", "slow ramp into a turn", speed, 13.0,
                     lambda t: rate * max(0.0, t - 1.5), (1.4, 1.0e9))


def hard_slow_ramp(rng: np.random.Generator) -> Manoeuvre:
    """Hand wheel turned slowly until the truck corners hard."""
    speed, sign = mph(rng, 30, 38), float(rng.choice([-1.0, 1.0]))
    rate = sign * float(rng.uniform(0.25, 0.29)) * (15.0 / speed) ** 2
    return Manoeuvre("hard_slow_ramp", "slow ramp into a turn", speed, 13.0,
                     lambda t: rate * max(0.0, t - 1.5), (1.4, 1.0e9))


def j_turn(rng: np.random.Generator) -> Manoeuvre:
    """A quick step of the hand wheel, held for some seconds, and back."""
    speed = mph(rng, 26, 34)
    angle = sign_of(rng) * float(rng.uniform(1.5, 2.2)) * (13.0 / speed) ** 2
    back = float(rng.uniform(6.5, 7.5))
    return Manoeuvre("j_turn", "step steer, held, taken back", speed, 12.5,
                     through((2.5, 3.0, back, back + 0.8), (0.0, angle, angle, 0.0)),
                     (2.4, 1.0e9))


def there_and_back(rng: np.random.Generator) -> Manoeuvre:
    """Slowly into a turn and slowly out of it."""
    speed, top = mph(rng, 32, 42), float(rng.uniform(6.5, 7.5))
    angle = sign_of(rng) * float(rng.uniform(1.5, 2.0)) * (16.0 / speed) ** 2
    return Manoeuvre("there_and_back", "slowly into a turn and out again", speed, 13.5,
                     through((1.5, top, 12.5), (0.0, angle, 0.0)), (1.4, 1.0e9))


def hard_there_and_back(rng: np.random.Generator) -> Manoeuvre:
    """Into a turn until the truck corners hard, and out again."""
    speed, top = mph(rng, 30, 36), float(rng.uniform(6.0, 7.0))
    angle = sign_of(rng) * float(rng.uniform(3.4, 3.8)) * (13.0 / speed) ** 2
    return Manoeuvre("hard_there_and_back", "into a turn and out again", speed, 12.5,
                     through((1.5, top, top + 1.5, 11.5), (0.0, angle, angle, 0.0)), (1.4, 1.0e9))


def _tightening(kind: str, speed: float, angle: float) -> Manoeuvre:
    """Into a turn without a corner, and after some seconds further into it."""
    return Manoeuvre(kind, "into a turn that tightens", speed, 13.0,
                     eased((1.6, 4.0, 6.6, 9.0), (0.0, 0.6 * angle, 0.6 * angle, angle)),
                     (1.5, FROM_THERE))


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


def lift_in_turn(rng: np.random.Generator) -> Manoeuvre:
    """A steady turn in the middle of which the throttle is released."""
    speed = mph(rng, 32, 42)
    angle = sign_of(rng) * float(rng.uniform(1.4, 1.9)) * (16.0 / speed) ** 2
    return Manoeuvre("lift_in_turn", "steady turn, throttle released in it", speed, 13.0,
                     eased((1.6, 3.0), (0.0, angle)), (1.5, FROM_THERE),
                     release_s=float(rng.uniform(6.0, 7.0)))


def _hook(kind: str, speed: float, times_s: tuple[float, ...], first: float, second: float
          ) -> Manoeuvre:
    """Steered to one side by the first angle, then to the other by the second, which is held."""
    return Manoeuvre(kind, "steered to one side, then to the other and held", speed, 12.0,
                     through(times_s, (0.0, first, first, -second)), (2.4, 1.0e9))


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


def _two_bends(kind: str, speed: float, angle: float, times_s: tuple[float, ...]) -> Manoeuvre:
    """Into one bend and through it, over into the other, and out."""
    return Manoeuvre(kind, "through two bends", speed, 13.0,
                     through(times_s, (0.0, angle, angle, -angle, -angle, 0.0)), (1.7, 1.0e9))


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
