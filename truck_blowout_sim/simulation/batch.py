"""Many prepared drives over the same compiled function, in parallel."""

from __future__ import annotations

import os
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.simulation.abreast import MANY, execute_alike, parts_of
from truck_blowout_sim.simulation.drive import Drive, run_drive
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]


def run_batch(trucks: Sequence[Packed], drive: Drive | Sequence[Drive], *,
              workers: int | None = None) -> list[Floats]:
    """Run prepared drives of many trucks.

    Each gives the bits it gives alone; from 256 trucks on the same to rounding, because then eight
    go abreast, with a step that is compiled when it is first needed.

    Args:
        trucks: differing in parameters, or in anything else.
        drive: one for all, or one for each.
        workers: threads; one for each core if not given.

    Returns:
        Outputs [n_rows, n_outputs] of each truck, in order; rows after a failure are NaN.
    """
    drives = [drive] * len(trucks) if isinstance(drive, Drive) else list(drive)
    nothing = [None] * len(trucks)
    eights, alone = parts_of(trucks, drives, nothing) if len(trucks) >= MANY else (
        [], list(range(len(trucks))))
    parts = [*eights, *([k] for k in alone)]

    def work(part: list[int]) -> list[Floats]:
        if len(part) == 1:
            return [run_drive(trucks[part[0]], drives[part[0]])]
        ran = execute_alike([trucks[k] for k in part], [drives[k] for k in part],
                            nothing[:len(part)])
        return [each.out for each in ran]

    found: dict[int, Floats] = {}
    with ThreadPoolExecutor(workers or os.cpu_count() or 1) as pool:
        for part, outs in zip(parts, pool.map(work, parts), strict=True):
            found.update(zip(part, outs, strict=True))
    return [found[k] for k in range(len(trucks))]
