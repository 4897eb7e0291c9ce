"""A study of many runs: wall time and memory. `python -m benchmarks.studies [RUNS]`.

Every run lasts 10 s, at a speed, a load, a tire, and an instant of the blowout of its own, so that
none is settled or packed from what another left. Three channels at 20 Hz are streamed to Parquet.
"""

from __future__ import annotations

import os
import sys
import tempfile
from pathlib import Path
from time import perf_counter, process_time

import psutil

from truck_blowout_sim.simulation import simulate_batch
from truck_blowout_sim.simulation.studies import parse_axis, sample

VEHICLE, SCENARIO = "international_9400i_trailmobile", "fishhook"
RUNS = 10_000
AXES = ("start.speed_mph=22:32", "units.trailer.payload.*.mass_kg=0.5x:1.5x",
        "blowouts.failure.time_s=2:6", "blowouts.failure.tires=trailer_1_left,drive_1_left,none")
CHANNELS = ("tractor_yaw_rate_radps", "trailer_roll_rad", "articulation_rad")
RATE_HZ = 20.0


def main(runs: int = RUNS) -> None:
    """Print wall time, simulated time a wall second, and memory on the way."""
    variants = sample([parse_axis(word) for word in AXES], runs, seed=1)
    simulate_batch(VEHICLE, SCENARIO, variants[:2])  # loads compiled code
    process, memory = psutil.Process(), {}
    start, busy = perf_counter(), process_time()

    def note(share: float) -> None:
        tenth = int(10.0 * share)
        if tenth not in memory:
            memory[tenth] = process.memory_info().rss / 1e6
            print(f"  {share:4.0%} after {perf_counter() - start:6.1f} s, {memory[tenth]:.0f} MB",
                  flush=True)

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "runs.parquet"
        batch = simulate_batch(VEHICLE, SCENARIO, variants, channels=CHANNELS, rate_hz=RATE_HZ,
                               output=path, progress=note)
        wall, busy = perf_counter() - start, process_time() - busy
        size = path.stat().st_size / 1e6
        status = batch.column("status")
    print(f"{runs} runs of 10 s on {os.cpu_count()} cores (load {os.getloadavg()[0]:.1f}): "
          f"{wall:.1f} s, {1e3 * wall / runs:.1f} ms a run, "
          f"{10.0 * runs / wall:.0f} simulated seconds a second")
    print(f"processor time {1e3 * busy / runs:.1f} ms a run: {RUNS} runs take "
          f"{RUNS * busy / runs / 2.0:.0f} s of two free cores")
    counts = {word: status.count(word) for word in dict.fromkeys(status)}
    print(f"table {size:.1f} MB; {', '.join(f'{n} {word}' for word, n in counts.items())}")
    late = [mb for tenth, mb in memory.items() if tenth >= 1]
    print(f"memory from a tenth of the way on: {min(late):.0f} to {max(late):.0f} MB")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else RUNS)
