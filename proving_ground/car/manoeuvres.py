"""What the driver of the car sets out to do; every manoeuvre is drawn from a seed."""

from __future__ import annotations

import math

import numpy as np

from proving_ground.car.forces import PA_PER_MPS2
from proving_ground.driver import Driver
from proving_ground.layout import Commands
from proving_ground.manoeuvres.shapes import FROM_THERE, eased, one_sine, sign_of, through, waves
from proving_ground.task import Braking, Manoeuvre

GEOMETRY_M = 16.0 * 2.58           # hand wheel over curvature at low speed
BOTH = ("steer", "drive")
KINDS: dict[str, tuple[str, ...]] = {
    "steer": ("lane_change", "slalom", "sweep", "ramp_hold", "bends", "weave"),
    "hard": ("hard_lane_change", "hard_ramp", "hard_slalom"),
    "brake": ("braking", "braking_stairs", "braking_dabs", "braking_in_turn"),
    "coast": ("coast_down", "coast_late", "throttle_steps"),
    "any": ("lane_change", "straight", "coast_down", "braking", "bends"),
    "straight": ("straight", "coast_down", "braking", "throttle_steps"),
}


def _speed(rng: np.random.Generator, low: float, high: float) -> float:
    return float(rng.uniform(low, high))


def _hand(lateral_mps2: float, speed: float) -> float:
    """Hand-wheel angle of a lateral acceleration."""
    return GEOMETRY_M * lateral_mps2 / speed**2


def make(kind: str, seed: int) -> Manoeuvre:
    """A manoeuvre of a kind, its details drawn from a seed.

    Raises:
        ValueError: no kind of that name.
    """
    rng = np.random.default_rng([seed, 131])
    speed, sign = _speed(rng, 16.0, 30.0), sign_of(rng)
    if kind in ("lane_change", "hard_lane_change"):
        size = float(rng.uniform(5.5, 7.5) if kind.startswith("hard") else rng.uniform(1.5, 3.5))
        period = float(rng.uniform(2.0, 2.8))
        return Manoeuvre(kind, "single lane change", speed, 11.0,
                         one_sine(2.5, period, sign * _hand(size, speed)), (2.4, 3.5 + period),
                         sign * 3.0)
    if kind in ("slalom", "hard_slalom"):
        size = float(rng.uniform(5.0, 7.0) if kind.startswith("hard") else rng.uniform(1.5, 3.5))
        period = float(rng.uniform(2.2, 3.2))
        return Manoeuvre(kind, "waves of the hand wheel", speed, 13.0,
                         waves(2.0, period, 3.0, sign * _hand(size, speed)),
                         (1.9, 2.5 + 3.0 * period))
    if kind == "sweep":
        return _sweep(rng, speed)
    if kind in ("ramp_hold", "hard_ramp"):
        size = float(rng.uniform(6.0, 8.0) if kind.startswith("hard") else rng.uniform(2.0, 4.0))
        ramp = float(rng.uniform(1.0, 2.5))
        return Manoeuvre(kind, "ramp-and-hold steer", speed, 10.0,
                         through((2.0, 2.0 + ramp), (0.0, sign * _hand(size, speed))),
                         (1.9, FROM_THERE))
    if kind == "bends":
        size = sign * _hand(float(rng.uniform(1.5, 3.0)), speed)
        return Manoeuvre(kind, "two bends", speed, 13.0,
                         eased((1.5, 3.5, 6.0, 8.0, 11.0), (0.0, size, size, -size, 0.0)),
                         (1.4, FROM_THERE))
    if kind == "weave":
        return Manoeuvre(kind, "small waves of the hand wheel", speed, 13.0,
                         waves(1.5, 4.0, 2.7, sign * _hand(0.7, speed)), (1.4, 12.5))
    return _along(kind, rng, speed, sign)


def _sweep(rng: np.random.Generator, speed: float) -> Manoeuvre:
    amplitude, span = _hand(float(rng.uniform(1.0, 2.0)), speed), 10.0

    def program(time_s: float) -> float:
        t = min(max(time_s - 1.5, 0.0), span)
        phase = 2.0 * math.pi * (0.2 * t + 0.5 * (2.0 - 0.2) / span * t * t)
        return amplitude * math.sin(phase) * min(1.0, t / 0.5, (span - t) / 0.5)

    return Manoeuvre("sweep", "sine sweep of the hand wheel, 0.2-2 Hz", speed, 13.0, program,
                     (1.4, 12.0))


def _along(kind: str, rng: np.random.Generator, speed: float, sign: float) -> Manoeuvre:
    """Straight runs and braking."""
    pressure = PA_PER_MPS2 * float(rng.uniform(2.0, 4.5))
    if kind == "straight":
        return Manoeuvre(kind, "straight, speed held", speed, 12.0)
    if kind == "coast_down":
        return Manoeuvre(kind, "straight, throttle released", speed + 4.0, 13.0, release_s=2.0)
    if kind == "coast_late":
        return Manoeuvre(kind, "straight, throttle released late", speed, 13.0, release_s=7.0)
    if kind == "throttle_steps":
        dab = Braking(6.0, 7.0, 0.3 * pressure, BOTH)
        return Manoeuvre(kind, "straight, throttle released, a dab of the brakes", speed, 12.0,
                         release_s=2.5, brakings=(dab,))
    if kind == "braking":
        return Manoeuvre(kind, "straight-line braking", speed, 10.0, release_s=2.0,
                         brakings=(Braking(2.5, FROM_THERE, pressure, BOTH),))
    if kind == "braking_stairs":
        stairs = tuple(Braking(2.5 + 1.2 * k, FROM_THERE, 0.3 * pressure, BOTH) for k in range(3))
        return Manoeuvre(kind, "straight-line braking in stairs", speed + 3.0, 10.0, release_s=2.0,
                         brakings=stairs)
    if kind == "braking_dabs":
        dabs = tuple(Braking(at, at + 1.0, 0.8 * pressure, BOTH) for at in (2.5, 5.0, 7.5))
        return Manoeuvre(kind, "straight-line braking in pulses", speed + 4.0, 11.0, release_s=2.0,
                         brakings=dabs)
    if kind == "braking_in_turn":
        return Manoeuvre(kind, "steady turn, braked", speed, 10.0,
                         through((1.5, 3.0), (0.0, sign * _hand(2.0, speed))), (1.4, FROM_THERE),
                         release_s=5.0, brakings=(Braking(5.2, FROM_THERE, 0.5 * pressure, BOTH),))
    raise ValueError(f"no manoeuvre of the car is called {kind!r}")


class CarDriver(Driver):
    """The same driver in a car: other gains of hand wheel and throttle."""

    def act(self, time_s: float, x: float, y: float, heading: float, yaw_rate: float,
            speed: float) -> Commands:
        """Commands for the next sample; the third brake circuit is not there."""
        given = super().act(time_s, x, y, heading, yaw_rate, speed)
        return given._replace(trailer_pa=0.0)

    def _throttle(self, time_s: float, speed: float) -> float:
        if time_s >= self._manoeuvre.release_s:
            return 0.0
        gap = self._manoeuvre.speed_mps - speed
        resist = 0.4 * speed * speed
        return min(1.0, max(0.0, (resist + 700.0 * gap) * max(speed, 3.0) / 110.0e3))

    def _see(self, y: float, heading: float, yaw_rate: float, speed: float,
             attention: float) -> float:
        ahead = y + 1.3 * speed * (heading + 0.65 * yaw_rate)
        curvature = 2.0 * (self._lane - ahead) / (speed * 1.3) ** 2
        self._seen.append(attention * GEOMETRY_M * curvature)
        return self._seen[0]
