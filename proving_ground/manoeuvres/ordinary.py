"""Ten minutes of ordinary driving: nobody tests anything."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from proving_ground.manoeuvres.shapes import ALL, mph
from proving_ground.task import Braking, Manoeuvre, Program

DURATION_S = 600.0
LANE_M = 3.5


def _eased_steps(times_s: list[float], values: list[float], length_s: float) -> Program:
    """Values held and eased into one another over a time, beginning at each instant."""
    def program(time_s: float) -> float:
        k = int(np.searchsorted(times_s, time_s, side="right")) - 1
        if k <= 0:
            return values[0]
        share = min(1.0, (time_s - times_s[k]) / length_s)
        return values[k - 1] + (values[k] - values[k - 1]) * 0.5 * (
            1.0 - float(np.cos(np.pi * share)))

    return program


def ordinary_drive(rng: np.random.Generator) -> Manoeuvre:
    """Long bends, a change of lane now and then, other speeds, light brakes."""
    speed = mph(rng, 48, 58)
    lanes = [0.0, *np.cumsum(rng.uniform(18.0, 50.0, 20)).tolist()]
    side = [0.0, *(LANE_M * rng.integers(0, 2, 20)).tolist()]
    lane = _eased_steps(lanes, side, 5.0)
    paces = [0.0, *np.cumsum(rng.uniform(25.0, 60.0, 15)).tolist()]
    pace = _eased_steps(paces, [1.0, *rng.uniform(0.7, 1.05, 15).tolist()], 8.0)
    bend_m, bend_s = float(rng.uniform(10.0, 30.0)), float(rng.uniform(45.0, 80.0))

    def place(time_s: float) -> float:
        return lane(time_s) + bend_m * (1.0 - float(np.cos(2.0 * np.pi * time_s / bend_s)))

    stops = np.sort(rng.uniform(20.0, DURATION_S - 20.0, 6)).tolist()
    brakes = tuple(Braking(at, at + float(rng.uniform(1.5, 3.0)),
                           float(rng.uniform(60.0e3, 130.0e3)), ALL)
                   for at, after in pairwise([*stops, DURATION_S]) if after - at > 4.0)
    return Manoeuvre("ordinary_drive", "ten minutes of ordinary driving", speed, DURATION_S,
                     brakings=brakes, lane=place, pace=pace)
