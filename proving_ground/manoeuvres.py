"""What the driver sets out to do: speed, hand-wheel program, throttle, brakes, blowout.

Every manoeuvre is drawn from a seed: amplitudes, speeds and instants vary a little.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from proving_ground import manoeuvres_fourth as fourth
from proving_ground import manoeuvres_fresh as fresh
from proving_ground import manoeuvres_more as more
from proving_ground.task import Braking, Manoeuvre, Program

MPH_MPS = 0.44704


Maker = Callable[[np.random.Generator], Manoeuvre]


def _mph(rng: np.random.Generator, low: float, high: float) -> float:
    return float(rng.uniform(low, high)) * MPH_MPS


def straight(rng: np.random.Generator) -> Manoeuvre:
    """Holding lane and speed at 35 to 60 mph."""
    return Manoeuvre("straight", "straight, speed held", _mph(rng, 35, 60), 12.0)


def _sine(start: float, period: float, amplitude: float) -> Program:
    def program(time_s: float) -> float:
        s = (time_s - start) / period
        return amplitude * math.sin(2.0 * math.pi * s) if 0.0 <= s <= 1.0 else 0.0

    return program


def lane_change(rng: np.random.Generator) -> Manoeuvre:
    """One sine of hand wheel, then the new lane is held."""
    speed, sign = _mph(rng, 42, 54), float(rng.choice([-1.0, 1.0]))
    period = float(rng.uniform(2.4, 3.0))
    amplitude = sign * float(rng.uniform(0.9, 1.2)) * (22.0 / speed) ** 2
    return Manoeuvre("lane_change", "single lane change", speed, 13.0,
                     _sine(2.5, period, amplitude), (2.4, 2.5 + period + 1.0), sign * 2.3)


def double_lane_change(rng: np.random.Generator) -> Manoeuvre:
    """Out and back again, harder."""
    speed, sign = _mph(rng, 42, 52), float(rng.choice([-1.0, 1.0]))
    period = float(rng.uniform(2.3, 2.8))
    amplitude = sign * float(rng.uniform(1.2, 1.6)) * (22.0 / speed) ** 2
    first = _sine(2.5, period, amplitude)
    second = _sine(2.5 + period + 0.8, period, -amplitude)
    return Manoeuvre("double_lane_change", "double lane change", speed, 14.0,
                     lambda t: first(t) + second(t), (2.4, 2.5 + 2.0 * period + 1.8))


def sine_sweep(rng: np.random.Generator) -> Manoeuvre:
    """Hand-wheel sweep from 0.15 to 1.3 Hz."""
    speed = _mph(rng, 38, 52)
    amplitude = float(rng.uniform(0.35, 0.6)) * (22.0 / speed)
    span = 11.0

    def program(time_s: float) -> float:
        t = min(max(time_s - 1.5, 0.0), span)
        phase = 2.0 * math.pi * (0.15 * t + 0.5 * (1.3 - 0.15) / span * t * t)
        fade = min(1.0, t / 0.5, (span - t) / 0.5)
        return amplitude * math.sin(phase) * fade

    return Manoeuvre("sine_sweep", "sine sweep of the hand wheel, 0.15-1.3 Hz", speed, 14.0,
                     program, (1.4, 13.0))


def ramp_hold(rng: np.random.Generator) -> Manoeuvre:
    """Hand wheel ramped to an angle and held, 24 to 34 mph."""
    speed, sign = _mph(rng, 24, 34), float(rng.choice([-1.0, 1.0]))
    angle = sign * float(rng.uniform(1.5, 2.4)) * (13.0 / speed) ** 2
    return Manoeuvre("ramp_hold", "ramp-and-hold steer", speed, 12.0,
                     lambda t: angle * min(1.0, max(0.0, (t - 2.0) / 1.2)), (1.9, 1.0e9))


def hard_ramp(rng: np.random.Generator) -> Manoeuvre:
    """Hand wheel ramped to an angle that takes the truck to about a third of a g."""
    speed, sign = _mph(rng, 28, 34), float(rng.choice([-1.0, 1.0]))
    angle = sign * float(rng.uniform(2.9, 3.4)) * (13.0 / speed) ** 2
    return Manoeuvre("hard_ramp", "ramp-and-hold steer", speed, 12.0,
                     lambda t: angle * min(1.0, max(0.0, (t - 2.0) / 1.6)), (1.9, 1.0e9))


def hard_slow_ramp(rng: np.random.Generator) -> Manoeuvre:
    """Hand wheel turned slowly until the truck corners hard."""
    speed, sign = _mph(rng, 30, 38), float(rng.choice([-1.0, 1.0]))
    rate = sign * float(rng.uniform(0.25, 0.29)) * (15.0 / speed) ** 2
    return Manoeuvre("hard_slow_ramp", "slow ramp into a turn", speed, 13.0,
                     lambda t: rate * max(0.0, t - 1.5), (1.4, 1.0e9))


def hard_double(rng: np.random.Generator) -> Manoeuvre:
    """Out and back, as hard as an evasion."""
    speed, sign = _mph(rng, 44, 52), float(rng.choice([-1.0, 1.0]))
    period = float(rng.uniform(2.6, 3.0))
    amplitude = sign * float(rng.uniform(2.0, 2.3)) * (22.0 / speed) ** 2
    first = _sine(2.5, period, amplitude)
    second = _sine(2.5 + period + 0.8, period, -amplitude)
    return Manoeuvre("hard_double", "double lane change", speed, 14.0,
                     lambda t: first(t) + second(t), (2.4, 2.5 + 2.0 * period + 1.8))


def slow_ramp(rng: np.random.Generator) -> Manoeuvre:
    """Hand wheel turned slowly into a turn."""
    speed, sign = _mph(rng, 30, 42), float(rng.choice([-1.0, 1.0]))
    rate = sign * float(rng.uniform(0.14, 0.20)) * (16.0 / speed) ** 2
    return Manoeuvre("slow_ramp", "slow ramp into a turn", speed, 13.0,
                     lambda t: rate * max(0.0, t - 1.5), (1.4, 1.0e9))


def coast_down(rng: np.random.Generator) -> Manoeuvre:
    """Throttle released on a straight."""
    return Manoeuvre("coast_down", "straight, throttle released", _mph(rng, 50, 60), 15.0,
                     release_s=float(rng.uniform(1.5, 2.5)))


def coast_slow(rng: np.random.Generator) -> Manoeuvre:
    """Throttle released on a straight, at lower speed."""
    return Manoeuvre("coast_slow", "straight, throttle released", _mph(rng, 30, 40), 15.0,
                     release_s=float(rng.uniform(1.5, 2.5)))


def braking_trailer(rng: np.random.Generator) -> Manoeuvre:
    """Trailer brakes only, held to the end."""
    pressure = float(rng.uniform(150.0e3, 240.0e3))
    return Manoeuvre("braking_trailer", "straight-line braking", _mph(rng, 42, 56), 12.0,
                     release_s=2.0, brakings=(Braking(3.0, 1.0e9, pressure),))


def braking_all(rng: np.random.Generator) -> Manoeuvre:
    """All axles braked, held to the end."""
    pressure = float(rng.uniform(140.0e3, 210.0e3))
    groups = ("steer", "drive", "trailer")
    return Manoeuvre("braking_all", "straight-line braking", _mph(rng, 45, 58), 12.0,
                     release_s=2.0, brakings=(Braking(3.0, 1.0e9, pressure, groups),))


def braking_steps(rng: np.random.Generator) -> Manoeuvre:
    """All axles for two seconds, then the trailer alone."""
    first = Braking(3.0, 5.0, float(rng.uniform(140.0e3, 210.0e3)), ("steer", "drive", "trailer"))
    second = Braking(7.5, 10.0, float(rng.uniform(170.0e3, 260.0e3)))
    return Manoeuvre("braking_steps", "straight-line braking", _mph(rng, 48, 58), 13.0,
                     release_s=2.0, brakings=(first, second))


def blowout(rng: np.random.Generator, tires: tuple[str, ...] = ("steer_left",)) -> Manoeuvre:
    """A tire blown on a straight; the driver corrects, releases, and brakes the trailer."""
    at = round(float(rng.uniform(3.0, 4.0)), 2)
    brake = Braking(at + 5.0, 1.0e9, float(rng.uniform(180.0e3, 240.0e3)))
    return Manoeuvre("blowout", "straight, tire blown, driver corrects, then brakes",
                     _mph(rng, 47, 55), 13.0, release_s=at + 3.2, brakings=(brake,),
                     blowout_s=at, blown=tires, reaction_s=float(rng.uniform(0.55, 0.8)))


def blowout_free(rng: np.random.Generator, tires: tuple[str, ...] = ("steer_left",)) -> Manoeuvre:
    """A tire blown on a straight; the hand wheel is held still."""
    at = round(float(rng.uniform(3.0, 4.0)), 2)
    return Manoeuvre("blowout_free", "straight, tire blown, hand wheel held", _mph(rng, 45, 54),
                     at + 3.5, blowout_s=at, blown=tires, corrects=False)


def blowout_brake(rng: np.random.Generator,
                  tires: tuple[str, ...] = ("steer_left",)) -> Manoeuvre:
    """A tire blown on a straight; the driver lifts off at once and brakes all axles gently."""
    at = round(float(rng.uniform(3.0, 4.0)), 2)
    groups = ("steer", "drive", "trailer")
    brake = Braking(at + 3.5, 1.0e9, float(rng.uniform(110.0e3, 150.0e3)), groups)
    return Manoeuvre("blowout_brake", "straight, tire blown, driver corrects, then brakes",
                     _mph(rng, 40, 52), 12.0, release_s=at + 1.2, brakings=(brake,),
                     blowout_s=at, blown=tires, reaction_s=float(rng.uniform(0.55, 0.8)))


def random_steer(rng: np.random.Generator) -> Manoeuvre:
    """Several sines of hand wheel at once, 0.1 to 1 Hz."""
    speed = _mph(rng, 36, 54)
    hertz = rng.uniform([0.10, 0.25, 0.45, 0.75], [0.20, 0.40, 0.70, 1.0])
    phase = rng.uniform(0.0, 2.0 * np.pi, 4)
    parts = np.array([0.30, 0.30, 0.25, 0.2]) * (22.0 / speed)

    def program(time_s: float) -> float:
        fade = float(np.clip(min(time_s - 1.5, 12.5 - time_s), 0.0, 1.0))
        return fade * float(parts @ np.sin(2.0 * np.pi * hertz * time_s + phase))

    return Manoeuvre("random_steer", "hand wheel in several sines at once", speed, 13.5,
                     program, (1.4, 12.6))


def speed_step(rng: np.random.Generator) -> Manoeuvre:
    """Speed held, then throttle released in the middle of the run."""
    return Manoeuvre("speed_step", "straight, speed held, then throttle released",
                     _mph(rng, 38, 58), 14.0, release_s=float(rng.uniform(6.0, 7.5)))


def braking_ramp(rng: np.random.Generator) -> Manoeuvre:
    """All axles, pressure raised in four stairs."""
    top = float(rng.uniform(180.0e3, 240.0e3))
    groups = ("steer", "drive", "trailer")
    stairs = tuple(Braking(2.5 + 1.5 * k, 1.0e9, 0.25 * top, groups) for k in range(4))
    return Manoeuvre("braking_ramp", "straight-line braking", _mph(rng, 48, 58), 12.0,
                     release_s=1.8, brakings=stairs)


MANOEUVRES: dict[str, Maker] = {maker.__name__: maker for maker in (
    straight, lane_change, double_lane_change, sine_sweep, ramp_hold, slow_ramp, coast_down,
    coast_slow, braking_trailer, braking_all, braking_steps, blowout, blowout_free, blowout_brake,
    random_steer, hard_ramp, hard_slow_ramp, hard_double, speed_step, braking_ramp,
    more.j_turn, more.slalom, more.sine_dwell, more.there_and_back, more.weave, more.hard_slalom,
    more.hard_there_and_back, more.coast_then_brake, more.late_release, more.braking_pulses,
    more.braking_release, more.blowout_hold, more.blowout_coast, fresh.fishhook,
    fresh.hard_fishhook, fresh.s_bend, fresh.hard_s_bend, fresh.stairs_steer, fresh.pulse_steer,
    fresh.small_pulses, fresh.roll_out, fresh.dab_and_roll, fresh.braking_swap,
    fresh.braking_growing, fresh.blowout_slow_hands, fresh.blowout_dab, fourth.tightening_turn,
    fourth.hard_tightening, fourth.swerve_and_return, fourth.hard_swerve, fourth.lift_in_turn,
    fourth.growing_triangles, fourth.slow_drift, fourth.dragging_brake, fourth.roll_and_dabs,
    fourth.braking_taper, fourth.braking_added, fourth.blowout_pull_over,
    fourth.blowout_quick_hands)}
_WITH_BLOWOUT = {maker.__name__: maker for maker in (
    blowout, blowout_free, blowout_brake, more.blowout_hold, more.blowout_coast,
    fresh.blowout_slow_hands, fresh.blowout_dab, fourth.blowout_pull_over,
    fourth.blowout_quick_hands)}


def make(kind: str, seed: int, tires: tuple[str, ...] = ("steer_left",)) -> Manoeuvre:
    """A manoeuvre of a kind, its details drawn from a seed."""
    rng = np.random.default_rng([seed, 37])
    if kind in _WITH_BLOWOUT:
        return _WITH_BLOWOUT[kind](rng, tires)
    return MANOEUVRES[kind](rng)
