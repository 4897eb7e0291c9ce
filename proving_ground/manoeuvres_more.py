"""More of what a driver can set out to do: a test set needs kinds no one developed against."""

from __future__ import annotations

import numpy as np

from proving_ground.task import Braking, Manoeuvre, Program

MPH_MPS = 0.44704
ALL = ("steer", "drive", "trailer")


def mph(rng: np.random.Generator, low: float, high: float) -> float:
    """A speed between two, given in miles an hour, in m/s."""
    return float(rng.uniform(low, high)) * MPH_MPS


def sign_of(rng: np.random.Generator) -> float:
    """To the left or to the right."""
    return float(rng.choice([-1.0, 1.0]))


def through(times_s: tuple[float, ...], angles_rad: tuple[float, ...]) -> Program:
    """Straight from one angle to the next."""
    return lambda time_s: float(np.interp(time_s, times_s, angles_rad))


def _waves(start_s: float, period_s: float, count: float, amplitude_rad: float) -> Program:
    """So many whole sines, the first and last one rising and falling over half a second."""
    end_s = start_s + count * period_s

    def program(time_s: float) -> float:
        fade = float(np.clip(min(time_s - start_s, end_s - time_s) / 0.5, 0.0, 1.0))
        return amplitude_rad * fade * float(np.sin(2.0 * np.pi * (time_s - start_s) / period_s))

    return program


def j_turn(rng: np.random.Generator) -> Manoeuvre:
    """A quick step of the hand wheel, held for some seconds, and back."""
    speed = mph(rng, 26, 34)
    angle = sign_of(rng) * float(rng.uniform(1.5, 2.2)) * (13.0 / speed) ** 2
    back = float(rng.uniform(6.5, 7.5))
    return Manoeuvre("j_turn", "step steer, held, taken back", speed, 12.5,
                     through((2.5, 3.0, back, back + 0.8), (0.0, angle, angle, 0.0)),
                     (2.4, 1.0e9))


def slalom(rng: np.random.Generator) -> Manoeuvre:
    """Three waves of the hand wheel."""
    speed, period = mph(rng, 40, 50), float(rng.uniform(2.6, 3.4))
    amplitude = sign_of(rng) * float(rng.uniform(0.95, 1.3)) * (22.0 / speed) ** 2
    return Manoeuvre("slalom", "three waves of the hand wheel", speed, 14.0,
                     _waves(2.0, period, 3.0, amplitude), (1.9, 2.5 + 3.0 * period))


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


def there_and_back(rng: np.random.Generator) -> Manoeuvre:
    """Slowly into a turn and slowly out of it."""
    speed, top = mph(rng, 32, 42), float(rng.uniform(6.5, 7.5))
    angle = sign_of(rng) * float(rng.uniform(1.5, 2.0)) * (16.0 / speed) ** 2
    return Manoeuvre("there_and_back", "slowly into a turn and out again", speed, 13.5,
                     through((1.5, top, 12.5), (0.0, angle, 0.0)), (1.4, 1.0e9))


def weave(rng: np.random.Generator) -> Manoeuvre:
    """Small slow waves about straight ahead."""
    speed, period = mph(rng, 38, 54), float(rng.uniform(3.2, 4.8))
    amplitude = sign_of(rng) * float(rng.uniform(0.25, 0.4)) * (22.0 / speed)
    return Manoeuvre("weave", "small waves of the hand wheel", speed, 14.0,
                     _waves(1.5, period, 11.0 / period, amplitude), (1.4, 12.7))


def hard_slalom(rng: np.random.Generator) -> Manoeuvre:
    """Two waves of the hand wheel, as hard as an evasion."""
    speed, period = mph(rng, 42, 50), float(rng.uniform(2.8, 3.2))
    amplitude = sign_of(rng) * float(rng.uniform(1.8, 2.05)) * (22.0 / speed) ** 2
    return Manoeuvre("hard_slalom", "two waves of the hand wheel", speed, 12.5,
                     _waves(2.5, period, 2.0, amplitude), (2.4, 3.0 + 2.0 * period))


def hard_there_and_back(rng: np.random.Generator) -> Manoeuvre:
    """Into a turn until the truck corners hard, and out again."""
    speed, top = mph(rng, 30, 36), float(rng.uniform(6.0, 7.0))
    angle = sign_of(rng) * float(rng.uniform(3.4, 3.8)) * (13.0 / speed) ** 2
    return Manoeuvre("hard_there_and_back", "into a turn and out again", speed, 12.5,
                     through((1.5, top, top + 1.5, 11.5), (0.0, angle, angle, 0.0)), (1.4, 1.0e9))


def coast_then_brake(rng: np.random.Generator) -> Manoeuvre:
    """Throttle released, then the trailer braked lightly."""
    pressure = float(rng.uniform(90.0e3, 130.0e3))
    return Manoeuvre("coast_then_brake", "straight, throttle released, then a light brake",
                     mph(rng, 40, 52), 14.0, release_s=float(rng.uniform(1.5, 2.5)),
                     brakings=(Braking(9.5, 1.0e9, pressure),))


def late_release(rng: np.random.Generator) -> Manoeuvre:
    """Speed held for most of the run, the throttle released late."""
    return Manoeuvre("late_release", "straight, speed held, throttle released late",
                     mph(rng, 34, 60), 14.0, release_s=float(rng.uniform(9.0, 10.5)))


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
