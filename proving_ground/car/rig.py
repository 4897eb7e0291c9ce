"""Drive the car through a manoeuvre: 1 ms Runge-Kutta steps, a sample every 10 ms."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np

from proving_ground.car.acts import Acts
from proving_ground.car.forces import STEP_S, engine, lines, outside, road_wheel, slope, wheels
from proving_ground.car.foreign import Compiled, Numbers, derivative, njit
from proving_ground.car.individual import CarIndividual
from proving_ground.layout import FloatArray
from proving_ground.run import Operator
from proving_ground.task import Manoeuvre

STEPS_A_SAMPLE, SAMPLE_S = 10, 0.01
STATES = 29
LOWEST_SPEED_MPS = 3.0


@dataclass(frozen=True)
class CarTruth:
    """A run as it happened: rows of `states`, `rates` (their derivatives) every 10 ms."""

    manoeuvre: Manoeuvre
    time_s: FloatArray
    commands: FloatArray           # hand wheel, throttle, front, rear, 0
    states: FloatArray
    rates: FloatArray
    slopes: FloatArray             # grade, bank
    pressures: FloatArray          # front, rear, at the wheels
    car: CarIndividual
    lead_in: FloatArray            # commands of the second before


@cache
def compiled_sample() -> Compiled:
    """One sample of steps; compiled once a process, as the foreign functions are."""
    foreign = derivative()

    @njit
    def rates(x: FloatArray, own: FloatArray, p: Numbers, acts: Acts, now: FloatArray,
              scale: FloatArray) -> FloatArray:
        """Derivatives of the foreign model with all that acts beside it."""
        f = np.array(foreign(x, [now[2], engine(x, p, now[1])], p))
        wheels(f, x, own, p, acts, now, scale)
        outside(f, x, own, p, acts, now)
        return f

    @njit
    def sample(x: FloatArray, own: FloatArray, p: Numbers, slippery: Numbers, acts: Acts,
               now: FloatArray, command: FloatArray, scale: FloatArray, zero: float,
               bump: float) -> None:
        """Ten steps in place. `now`: time, throttle, steering rate, grade, bank, drag area."""
        x[12] += bump
        now[1] = command[1]
        for k in range(STEPS_A_SAMPLE):
            slope(x, p, acts, now)
            wanted = road_wheel(own, acts, command[0])
            now[2] = (-(wanted + zero) - x[2]) / STEP_S
            lines(x, own, p, acts, command)
            held = slippery if x[0] + p.a > acts.slippery_x_m else p
            k1 = rates(x, own, held, acts, now, scale)
            k2 = rates(x + 0.5 * STEP_S * k1, own, held, acts, now, scale)
            k3 = rates(x + 0.5 * STEP_S * k2, own, held, acts, now, scale)
            k4 = rates(x + STEP_S * k3, own, held, acts, now, scale)
            x += STEP_S / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
            if k == 0:  # of the instant at which the sample is taken
                own[8:] = k1
            now[0] += STEP_S

    return sample


class CarRig:
    """One car, ready to be driven repeatedly."""

    def __init__(self, car: CarIndividual) -> None:
        self.car = car

    def drive(self, manoeuvre: Manoeuvre, acts: Acts, tires: dict[str, float], operator: Operator
              ) -> CarTruth:
        """Record until the end or until slower than 3 m/s; `tires`: factors on tire numbers.

        Factors whose name begins with `later_` hold from `acts.slippery_x_m` on.
        """
        from vehiclemodels.init_mb import init_mb

        p = self.car.parameters(**{k: v for k, v in tires.items() if not k.startswith("later_")})
        later = {k.removeprefix("later_"): v for k, v in tires.items() if k.startswith("later_")}
        slippery = self.car.parameters(**later) if later else p
        x = np.array(init_mb([0.0, 0.0, 0.0, manoeuvre.speed_mps, 0.0, 0.0, 0.0], p), dtype=float)
        own, now = np.zeros(8 + STATES), np.zeros(6)
        rng = np.random.default_rng([self.car.bumps_seed, 127])
        step, rows = compiled_sample(), []
        settle = 100
        now[0], now[5] = -settle * SAMPLE_S, self.car.drag_area_m2
        count = settle + round(manoeuvre.duration_s / SAMPLE_S) + 1
        command = np.zeros(5)
        for k in range(count):
            time_s = (k - settle) * SAMPLE_S
            command = np.array(operator.act(time_s, x[0], -x[1], -x[4], -x[5], x[3]))
            bump = 0.004 * rng.standard_normal() if self.car.bumps_seed else 0.0
            before, about = x.copy(), np.concatenate([now[3:5], own[2:4]])
            step(x, own, p, slippery, acts, now, command, self.car.brake, self.car.zero_rad, bump)
            rows.append(np.concatenate([[time_s], command, before, own[8:], about]))
            if k > settle and x[3] < LOWEST_SPEED_MPS:
                break
            if not np.all(np.isfinite(x)) or abs(x[6]) > 0.5:
                raise FloatingPointError(f"run {manoeuvre.kind}: the car turned over")
        before_it, table = np.array(rows)[:settle], np.array(rows)[settle:]
        n = 6 + STATES
        return CarTruth(manoeuvre, table[:, 0], table[:, 1:6], table[:, 6:n],
                        table[:, n:n + STATES], table[:, n + STATES:n + STATES + 2],
                        table[:, n + STATES + 2:], self.car, before_it[:, 1:6])
