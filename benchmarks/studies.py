"""A study of many runs: wall time and memory. `python -m benchmarks.studies [RUNS] [-o PAGE]`.

Every run lasts 10 s, at a speed, a load, a tire, and an instant of the blowout of its own, so that
none is settled or packed from what another left. Three channels at 20 Hz are streamed to Parquet.
"""

from __future__ import annotations

import math
import tempfile
from collections import Counter
from pathlib import Path
from time import perf_counter, process_time
from typing import Annotated

import psutil
import typer

from benchmarks.page import Page, Place, start_function
from truck_blowout_sim.simulation import simulate_batch
from truck_blowout_sim.simulation.abreast import MANY
from truck_blowout_sim.simulation.studies import parse_axis, sample

VEHICLE, SCENARIO = "international_9400i_trailmobile", "fishhook"
RUNS = 10_000
AXES = ("start.speed_mph=22:32", "units.trailer.payload.*.mass_kg=0.5x:1.5x",
        "blowouts.failure.time_s=2:6", "blowouts.failure.tires=trailer_1_left,drive_1_left,none")
CHANNELS = ("tractor_yaw_rate_radps", "trailer_roll_rad", "articulation_rad")
RATE_HZ = 20.0


class Progress:
    """Memory at each tenth of the way, printed."""

    def __init__(self) -> None:
        self._process, self._start = psutil.Process(), perf_counter()
        self._memory_mb: dict[int, float] = {}

    def __call__(self, share: float) -> None:
        """Note how far it is."""
        tenth = int(10.0 * share)
        if tenth not in self._memory_mb:
            memory_mb = self._memory_mb[tenth] = self._process.memory_info().rss / 1e6
            print(f"  {share:4.0%} after {perf_counter() - self._start:6.1f} s, "
                  f"{memory_mb:.0f} MB", flush=True)

    @property
    def most_mb(self) -> float:
        """Most memory seen."""
        return max(self._memory_mb.values())


def study(runs: int) -> str:
    """What the runs took, in two sentences."""
    variants = sample([parse_axis(word) for word in AXES], runs, seed=1)
    simulate_batch(VEHICLE, SCENARIO, variants[:MANY])  # compiles, for eight trucks as well
    progress, start, busy = Progress(), perf_counter(), process_time()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "runs.parquet"
        batch = simulate_batch(VEHICLE, SCENARIO, variants, channels=CHANNELS, rate_hz=RATE_HZ,
                               output=path, progress=progress)
        wall, busy = perf_counter() - start, process_time() - busy
        size_mb = path.stat().st_size / 1e6
        counts = Counter(map(str, batch.column("status")))
    ends = ", ".join(f"{count:,} {word}" for word, count in counts.most_common())
    return (f"{runs:,} runs of 10 s took {wall:.0f} s: {1e3 * wall / runs:.1f} ms a run, "
            f"{10.0 * runs / wall:,.0f} simulated seconds a second, {1e3 * busy / runs:.0f} ms of "
            f"processor time a run. Memory stayed below {math.ceil(progress.most_mb)} MB; the "
            f"table has {size_mb:.1f} MB ({ends}).")


def main(runs: Annotated[int, typer.Argument()] = RUNS, page: Page = None) -> None:
    """Wall time, simulated time a wall second, and memory on the way."""
    place = Place(page, "studies")
    said = study(runs)
    print(said)
    place.put(said)


if __name__ == "__main__":
    start_function(main)
