"""Many simulations of a case at once: in threads, and eight abreast where there are many alike.

Whether a truck goes abreast, and from which instant on, follows from what is asked for in one call
and from nothing else. From that instant on it gives the same bits whoever its neighbors are. An
interrupted diagnosis therefore continues to the same answer.

Known limits: what branches off driven trucks (`Run.course`) goes from the earliest of eight on.
Validated with: test/diagnosis/test_simulations.py.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.case.fingerprints import simulation_key
from truck_blowout_sim.diagnosis.case.runs import Run
from truck_blowout_sim.simulation.abreast import execute_alike, parts_of
from truck_blowout_sim.simulation.alike import in_eights
from truck_blowout_sim.simulation.course import left_abreast
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]
Job = tuple[Run, Packed]
Alone = Callable[[Run, Packed], Floats]
Abreast = Callable[[Sequence[Job]], list[Floats]]
# Simulations in one call from which on they go abreast: fewer are done sooner in two threads. Every
# diagnosis somewhere has many, so that compiling the step for eight is never in vain.
MANY_SIMULATIONS = 8


def simulated_abreast(jobs: Sequence[Job]) -> list[Floats]:
    """Bin means of up to eight alike trucks over their runs: `Run.simulated`, to rounding."""
    runs, trucks = zip(*jobs, strict=True)
    courses = [run.course for run in runs if run.course]
    outs = (left_abreast(courses, trucks, runs[0].since_s) if courses else
            [each.out for each in execute_alike(trucks, [run.drive for run in runs],
                                                [None] * len(jobs))])
    return [run.bins_of(out) + run.correction for run, out in zip(runs, outs, strict=True)]


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
    jobs = _left_together(jobs, eights)

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
    if len(jobs) < MANY_SIMULATIONS:
        return [], list(range(len(jobs)))
    whole = [k for k, (run, _) in enumerate(jobs) if run.course is None]
    late = sorted((k for k, (run, _) in enumerate(jobs) if run.course),
                  key=lambda k: jobs[k][0].since_s)
    eights, _ = parts_of([jobs[k][1] for k in whole], [jobs[k][0].drive for k in whole],
                         [None] * len(whole))
    lates, _ = in_eights([run.course.kind_of(truck) for run, truck in (jobs[k] for k in late)
                          if run.course])
    parts = [[group[k] for k in part] for group, found in ((whole, eights), (late, lates))
             for part in found]
    placed = {k for part in parts for k in part}
    return parts, [k for k in range(len(jobs)) if k not in placed]


def _left_together(jobs: Sequence[Job], parts: Sequence[Sequence[int]]) -> list[Job]:
    """The jobs; those of one part leave their driven trucks at the earliest instant of all.

    What never begins leaves where the shortest of the runs ends.
    """
    placed = list(jobs)
    for part in parts:
        since_s = min(min(jobs[k][0].since_s, float(jobs[k][0].edges_s[-1])) for k in part)
        for k in part:
            run, truck = jobs[k]
            placed[k] = (replace(run, since_s=since_s), truck) if run.course else (run, truck)
    return placed
