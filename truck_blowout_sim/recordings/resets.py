"""Where a truck was put back to its start in the middle of a recording.

A simulator's `reset` sets the truck somewhere else, on whole tires, while the clock goes on. What
comes after is another run.

Known limits: seen in the tractor's position only, where it was recorded.
Validated with: test/comparison/test_resets.py, test/recordings/test_csv_format.py.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Mapping, Sequence

import numpy as np

from truck_blowout_sim.recordings.recording import Series

# A position may jump by noise and by what the fastest truck covers between two samples.
_FASTEST_MPS = 60.0
_LEAST_JUMP_M = 3.0


def reset_times_s(channels: Mapping[str, Series]) -> tuple[float, ...]:
    """Instants at which the tractor is suddenly elsewhere: the first sample after each jump."""
    found: set[float] = set()
    for axis in "xy":
        series = channels.get(f"tractor_{axis}_m")
        if series is None or len(series) < 2:
            continue
        reach = _LEAST_JUMP_M + _FASTEST_MPS * np.diff(series.time_s)
        at = np.flatnonzero(np.abs(np.diff(series.value)) > reach)
        found |= {float(series.time_s[k + 1]) for k in at}
    return tuple(sorted(found))


def run_at(time_s: float, resets_s: Sequence[float]) -> int:
    """Which run of a recording an instant belongs to, from 0; each reset begins another."""
    return bisect_right(resets_s, time_s)
