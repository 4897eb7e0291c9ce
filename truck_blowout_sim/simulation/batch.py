"""Many prepared drives over the same compiled function, in parallel."""

from __future__ import annotations

import os
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.simulation.drive import Drive, run_drive
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]


def run_batch(trucks: Sequence[Packed], drive: Drive | Sequence[Drive], *,
              workers: int | None = None) -> list[Floats]:
    """Run prepared drives of many trucks, each with the same bits as alone.

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
