"""Many trucks over the same compiled function, in parallel.

Each truck is stepped by exactly the code that steps a single one, in a thread of its own: compiled
code lets go of the interpreter, so threads run side by side and every result has the same bits as
a run alone.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from os import PathLike

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.simulation.drive import Drive, run_drive
from truck_blowout_sim.simulation.run import simulate
from truck_blowout_sim.simulation.scenario import Scenario, load_scenario
from truck_blowout_sim.vehicle import Packed, Vehicle, pack

Floats = NDArray[np.float64]


def run_batch(trucks: Sequence[Packed], drive: Drive | Sequence[Drive], *,
              workers: int | None = None) -> list[Floats]:
    """Run prepared drives of many trucks.

    Args:
        trucks: differing in parameters, or in anything else.
        drive: one for all, or one for each.
        workers: threads; one for each core if not given.

    Returns:
        Outputs [n_rows, n_outputs] of each truck, in order; rows after a failure are NaN.
    """
    drives = [drive] * len(trucks) if isinstance(drive, Drive) else list(drive)
    with ThreadPoolExecutor(workers or os.cpu_count() or 1) as pool:
        return list(pool.map(run_drive, trucks, drives))


def simulate_batch(vehicle: Vehicle | Packed, scenario: Scenario | str | PathLike[str],
                   variants: Sequence[Mapping[str, float]], *, step_s: float = 0.001,
                   rate_hz: float = 100.0, workers: int | None = None) -> list[Recording]:
    """Run one scenario with many settings of named parameters.

    Args:
        variants: values by packed name, such as ``{"hub.trailer_2_left.brake_gain": 0.35}``.

    Returns:
        One recording for each variant, bit for bit what `simulate` gives.

    Raises:
        InputError: see `simulate`.
        KeyError: no parameter of a name.
    """
    packed = vehicle if isinstance(vehicle, Packed) else pack(vehicle)
    loaded = scenario if isinstance(scenario, Scenario) else load_scenario(scenario)
    trucks = [packed.with_values(values) for values in variants]
    with ThreadPoolExecutor(workers or os.cpu_count() or 1) as pool:
        runs = pool.map(lambda truck: simulate(truck, loaded, step_s=step_s, rate_hz=rate_hz),
                        trucks)
        return list(runs)
