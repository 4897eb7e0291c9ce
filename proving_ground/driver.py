"""A driver who holds speed and lane, wanders a little, and needs time to react."""

from __future__ import annotations

import math
from collections import deque

import numpy as np

from proving_ground.layout import Commands
from proving_ground.task import Manoeuvre

SAMPLE_S = 0.01
THINKING_SAMPLES = 18
PREVIEW_S = 1.3
HAND_RATE_RADPS = 3.5


class Driver:
    """Closed loop on lateral place, heading and speed; open loop where the manoeuvre says so."""

    def __init__(self, manoeuvre: Manoeuvre, seed: int) -> None:
        self._manoeuvre = manoeuvre
        rng = np.random.default_rng([seed, 41])
        wander_rad = np.radians(rng.uniform(0.3, 0.8, 3))
        wander_hz = rng.uniform([0.06, 0.15, 0.3], [0.14, 0.28, 0.5])
        phase = rng.uniform(0.0, 2.0 * np.pi, 3)
        self._waves = [tuple(map(float, row)) for row in
                       zip(wander_rad, 2.0 * np.pi * wander_hz, phase, strict=True)]
        self._seen: deque[float] = deque([0.0] * THINKING_SAMPLES, THINKING_SAMPLES)
        self._hand = 0.0
        self._trim = 0.0
        self._held: float | None = None
        self._lane = 0.0

    def act(self, time_s: float, x: float, y: float, heading: float, yaw_rate: float,
            speed: float) -> Commands:
        """Commands for the next sample from the truck's state (m, rad, m/s)."""
        task = self._manoeuvre
        groups = ("steer", "drive", "trailer")
        pressures = [sum((b.pressure(g, time_s) for b in task.brakings), 0.0) for g in groups]
        return Commands(self._steer(time_s, y, heading, yaw_rate, speed),
                        self._throttle(time_s, speed), *pressures)

    def _throttle(self, time_s: float, speed: float) -> float:
        if time_s >= self._manoeuvre.release_s:
            return 0.0
        pace = self._manoeuvre.pace
        wanted = self._manoeuvre.speed_mps * (1.0 if pace is None else pace(time_s))
        if any(b.start_s <= time_s < b.end_s + 1.0 for b in self._manoeuvre.brakings) and pace:
            return 0.0
        gap = wanted - speed
        resist = 1500.0 + 3.3 * speed * speed
        power = 300.0e3 / max(speed, 3.0)
        return min(1.0, max(0.0, (resist + 6000.0 * gap) / (power + 1500.0)))

    def _steer(self, time_s: float, y: float, heading: float, yaw_rate: float,
               speed: float) -> float:
        """Hand-wheel angle, rad: wander, program, and lane keeping after thinking time."""
        task = self._manoeuvre
        if task.lane is not None:
            self._lane = task.lane(time_s + PREVIEW_S)
        wander = sum(size * math.sin(turn * time_s + at) for size, turn, at in self._waves)
        if task.open_loop[0] <= time_s < task.open_loop[1]:
            self._lane = task.lane_after_m
            goal = self._trim + wander + task.program(time_s)
            self._see(y, heading, yaw_rate, speed, 0.0)
            return self._move(goal, 12.0)
        since = time_s - task.blowout_s
        wanted = self._see(y, heading, yaw_rate, speed, 1.0)
        if since >= 0.0 and (not task.corrects or since < task.reaction_s):
            self._held = self._hand if self._held is None else self._held
            return self._held
        if since >= task.reaction_s:
            ease = min(1.0, 0.45 + 0.2 * (since - task.reaction_s))
            self._trim += SAMPLE_S * 0.55 * wanted
            return self._move(self._trim + wander + ease * 1.6 * wanted, HAND_RATE_RADPS)
        self._trim += SAMPLE_S * 0.04 * wanted
        return self._move(self._trim + wander + 0.35 * wanted, HAND_RATE_RADPS)

    def _see(self, y: float, heading: float, yaw_rate: float, speed: float,
             attention: float) -> float:
        """Hand-wheel angle that would meet the lane at the preview distance, delayed."""
        ahead = y + PREVIEW_S * speed * (heading + 0.5 * PREVIEW_S * yaw_rate)
        curvature = 2.0 * (self._lane - ahead) / (speed * PREVIEW_S) ** 2
        gain = 22.0 * (6.0 + 0.006 * speed * speed)
        self._seen.append(attention * gain * curvature)
        return self._seen[0]

    def _move(self, goal: float, rate: float) -> float:
        step = min(rate * SAMPLE_S, max(-rate * SAMPLE_S, goal - self._hand))
        self._hand += step
        return self._hand
