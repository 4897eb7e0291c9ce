"""Drive one truck through one manoeuvre and keep what happened, 100 samples a second."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import mujoco
import numpy as np

from proving_ground.advance import compiled_loop, empty_sample
from proving_ground.driver import SAMPLE_S, Driver
from proving_ground.individual import Individual
from proving_ground.layout import Commands, FloatArray, State, new_state, truck, views
from proving_ground.multibody import Multibody, build
from proving_ground.sheet import TIRES
from proving_ground.switches import Switches
from proving_ground.task import Manoeuvre

STEP_S = 0.0008333333333333334
STEPS_A_SAMPLE = 12
SETTLE_S = 2.0
LOWEST_SPEED_MPS = 3.0


@dataclass(frozen=True)
class Truth:
    """A run as it happened, before any instrument: rows of `samples` are 10 ms apart."""

    manoeuvre: Manoeuvre
    time_s: FloatArray
    commands: FloatArray           # rows of Commands
    samples: FloatArray
    lead_in: FloatArray            # commands of the two seconds before
    truck: Individual


class Operator(Protocol):
    """Whoever gives the commands."""

    def act(self, time_s: float, x: float, y: float, heading: float, yaw_rate: float,
            speed: float) -> Commands:
        """Commands for the next sample."""


class Replay:
    """Commands of an earlier run, replayed."""

    def __init__(self, truth: Truth) -> None:
        self._rows = np.vstack([truth.lead_in, truth.commands])
        self._next = 1

    def act(self, time_s: float, x: float, y: float, heading: float, yaw_rate: float,
            speed: float) -> Commands:
        """The next row; the last one is held."""
        row = self._rows[min(self._next, len(self._rows) - 1)]
        self._next += 1
        return Commands(*map(float, row))


class Rig:
    """One MuJoCo truck, ready to be driven repeatedly."""

    def __init__(self, individual: Individual) -> None:
        self.individual = individual
        self.body: Multibody = build(individual.sheet, STEP_S, individual.laws)
        self._constants = truck(individual, self.body)
        self._loop: Callable[..., None] = compiled_loop()

    def drive(self, manoeuvre: Manoeuvre, switches: Switches, operator: Operator) -> Truth:
        """Settle for two seconds, then record until the end or until slower than 3 m/s."""
        model, data = self.body.model, mujoco.MjData(self.body.model)
        state = new_state(self.individual)
        self._start(data, manoeuvre.speed_mps)
        state.time[0] = -SETTLE_S
        window = views(model, data)
        settle, keep = round(SETTLE_S / SAMPLE_S), round(manoeuvre.duration_s / SAMPLE_S) + 1
        commands: FloatArray = np.zeros((settle + keep, 5))
        sample = empty_sample()
        rows: list[FloatArray] = []
        now = Commands(0.0, 0.3, 0.0, 0.0, 0.0)
        blown = False
        for k in range(settle + keep):
            time_s = (k - settle) * SAMPLE_S
            if not blown and time_s >= manoeuvre.blowout_s - 1.0e-9:
                blown = True
                _blow(state, manoeuvre.blown, self.individual.laws.hole_m2)
            if k > 0:
                now = _command(operator, time_s, sample)
            commands[k] = now
            self._loop(model._address, data._address, window, self._constants, state, switches,
                       now, STEPS_A_SAMPLE, STEP_S, sample)
            rows.append(sample.copy())
            if k > settle and sample[7] < LOWEST_SPEED_MPS:
                break
        samples: FloatArray = np.stack(rows)
        # MuJoCo restarts a run that went astray and only counts a warning.
        if any(item.number for item in data.warning) or not np.all(np.isfinite(samples)):
            raise FloatingPointError(f"run {manoeuvre.kind}: the truck's state is not finite")
        count = len(samples) - settle
        return Truth(manoeuvre, np.linspace(0.0, SAMPLE_S * (count - 1), count),
                     commands[settle:settle + count], samples[settle:], commands[:settle],
                     self.individual)

    def _start(self, data: mujoco.MjData, speed: float) -> None:
        """Rolling straight ahead at the manoeuvre's speed."""
        data.qvel[0] = speed
        heights = self.body.wheel_height_m
        free = self.individual.sheet["tire"]["free_radius_m"]
        for hub in range(10):
            rolling = free - 0.333 * (free - heights[hub // 2])
            data.qvel[self.body.wheel_dofs[hub]] = speed / rolling


def _blow(state: State, tires: tuple[str, ...], hole_m2: float) -> None:
    for name in tires:
        index = TIRES.index(name)
        state.hole[index] = hole_m2
        state.blown_at[index] = state.time[0]


def drive(rig: Rig, manoeuvre: Manoeuvre, switches: Switches, seed: int) -> Truth:
    """A run with the closed-loop driver."""
    return rig.drive(manoeuvre, switches, Driver(manoeuvre, seed))


def _command(operator: Operator, time_s: float, sample: FloatArray) -> Commands:
    w, x, y, z = sample[3:7].tolist()
    heading = math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
    return operator.act(time_s, float(sample[0]), float(sample[1]), heading, float(sample[12]),
                        float(sample[7]))


def replay(rig: Rig, truth: Truth, switches: Switches) -> Truth:
    """The same commands and the same blowout with other effects at work."""
    return rig.drive(truth.manoeuvre, switches, Replay(truth))
