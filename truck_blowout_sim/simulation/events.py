"""What bursts at which step or on which condition: from a scenario to the loop's tables."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.recordings import Blowout
from truck_blowout_sim.simulation.driver import watch_row
from truck_blowout_sim.simulation.loop import WATCH
from truck_blowout_sim.simulation.scenario import Scenario
from truck_blowout_sim.vehicle import Vehicle

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Events:
    """Tables of the loop.

    Attributes:
        steps: step of each blowout, -1: waits for its condition; ``tires``: numbers of the tires.
        conditions: row of ``watch`` each waits for; ``delays``: steps after it.
        watch: [n, len(WATCH)] conditions.
        reaction: row of ``watch`` that the driver reacts to; -1: the first burst.
    """

    steps: Integers
    tires: Integers
    conditions: Integers
    delays: Integers
    watch: Floats
    reaction: int


def events_of(scenario: Scenario, vehicle: Vehicle, timed: Sequence[Blowout], step_s: float
              ) -> Events:
    """Tables of a scenario's blowouts.

    Args:
        timed: those at an instant; the ones on a condition are the scenario's.
    """
    rows: list[tuple[int, int, int, int]] = []
    watch: list[Floats] = []
    for event in timed:
        step = max(round((event.time_s - scenario.spec.start_s) / step_s), 0)
        rows += [(step, vehicle.tires.index(tire), 0, 0) for tire in event.tires]
    for name, found in scenario.spec.blowouts.items():
        if found.when is None:
            continue
        delay, condition = round(found.delay_s / step_s), len(watch)
        watch.append(watch_row(found.when))
        rows += [(-1, vehicle.tires.index(tire), condition, delay)
                 for tire in scenario.tires_of(name, vehicle)]
    reaction, when = -1, scenario.spec.reaction.when if scenario.spec.reaction else None
    if when is not None:
        reaction = len(watch)
        watch.append(watch_row(when))
    table = np.array(rows, dtype=np.int64).reshape(-1, 4)
    steps, tires, conditions, delays = (table[:, k].copy() for k in range(4))
    return Events(steps, tires, conditions, delays, np.array(watch).reshape(-1, len(WATCH)),
                  reaction)
