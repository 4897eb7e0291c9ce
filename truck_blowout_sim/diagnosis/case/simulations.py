"""Many simulations of a case at once: in threads, and eight abreast where there are many alike.

Whether a truck goes abreast follows from what is asked for in one call and from nothing else, and
abreast it gives the same bits whoever its neighbors are. An interrupted diagnosis therefore
continues to the same answer.

Known limits: what branches off a driven truck (`Run.course`) goes alone.
Validated with: test/diagnosis/test_simulations.py.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.case.fingerprints import simulation_key
from truck_blowout_sim.diagnosis.case.runs import Run
from truck_blowout_sim.simulation.abreast import execute_alike, parts_of
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]
Job = tuple[Run, Packed]
Alone = Callable[[Run, Packed], Floats]
Abreast = Callable[[Sequence[Job]], list[Floats]]
# Simulations in one call from which on they go abreast. No case has so many that compiling the
# step for eight, once for all cases, would pay within it; one of few would wait for nothing.
MANY_SIMULATIONS = 64


def simulated_abreast(jobs: Sequence[Job]) -> list[Floats]:
    """Bin means of up to eight alike trucks over their runs: `Run.simulated`, to rounding."""
    ran = execute_alike([truck for _, truck in jobs], [run.drive for run, _ in jobs],
                        [None] * len(jobs))
    return [run.bins_of(each.out) + run.correction
            for (run, _), each in zip(jobs, ran, strict=True)]


def known_or_abreast(jobs: Sequence[Job], known: Callable[[bytes], Floats | None],
                     keep: Callable[[bytes, Floats], None]) -> list[Floats]:
    """Bin means of up to eight: those that are known by their key, the others simulated and kept.

    Equal jobs are simulated once.
    """
    keys = [simulation_key(*job, abreast=True) for job in jobs]
    found = {key: bins for key in dict.fromkeys(keys) if (bins := known(key)) is not None}
    left = {key: job for key, job in zip(keys, jobs, strict=True) if key not in found}
    if left:
        for key, bins in zip(left, simulated_abreast(list(left.values())), strict=True):
            keep(key, bins)
            found[key] = bins
    return [found[key].copy() for key in keys]


def simulate_bins(jobs: Sequence[Job], workers: int, alone: Alone = Run.simulated,
                  abreast: Abreast = simulated_abreast,
                  tell: Callable[[float], None] | None = None) -> list[Floats]:
    """Bin means of each truck over its run, in order; the same bits for any number of threads.

    ``tell``: called with the share that is done.
    """
    eights, rest = _parts(jobs)

    def work(part: list[int]) -> list[Floats]:
        if len(part) > 1:
            return abreast([jobs[k] for k in part])
        return [alone(*jobs[k]) for k in part]

    parts, done = [*eights, *([k] for k in rest)], dict[int, Floats]()
    with ThreadPoolExecutor(workers) as pool:
        try:
            for part, bins in zip(parts, pool.map(work, parts), strict=True):
                done.update(zip(part, bins, strict=True))
                if tell:
                    tell(len(done) / len(jobs))
        except BaseException:
            pool.shutdown(cancel_futures=True)  # whoever interrupts does not wait for the rest
            raise
    return [done[k] for k in range(len(jobs))]


def _parts(jobs: Sequence[Job]) -> tuple[list[list[int]], list[int]]:
    """Numbers of the jobs that go abreast, up to eight a part, and of those that go alone."""
    whole = [k for k, (run, _) in enumerate(jobs) if run.course is None]
    if len(whole) < MANY_SIMULATIONS:
        return [], list(range(len(jobs)))
    eights, _ = parts_of([jobs[k][1] for k in whole], [jobs[k][0].drive for k in whole],
                         [None] * len(whole))
    parts = [[whole[k] for k in part] for part in eights]
    placed = {k for part in parts for k in part}
    return parts, [k for k in range(len(jobs)) if k not in placed]
