"""A truck that was put back to its start in the middle of a recording.

A simulator's `reset` sets the truck somewhere else while the clock goes on. What comes after is
another run, which inputs from the first one cannot drive.

Known limits: seen in the tractor's position only, where it was recorded.
Validated with: test/comparison/test_resets.py.
"""

from __future__ import annotations

import numpy as np

from truck_blowout_sim.recordings import Recording

# A position may jump by noise and by what the fastest truck covers between two samples.
_FASTEST_MPS = 60.0
_LEAST_JUMP_M = 3.0


def reset_times_s(recording: Recording) -> tuple[float, ...]:
    """Instants at which the tractor is suddenly elsewhere: the first sample after each jump."""
    found: set[float] = set()
    for axis in "xy":
        series = recording.channels.get(f"tractor_{axis}_m")
        if series is None or len(series) < 2:
            continue
        reach = _LEAST_JUMP_M + _FASTEST_MPS * np.diff(series.time_s)
        at = np.flatnonzero(np.abs(np.diff(series.value)) > reach)
        found |= {float(series.time_s[k + 1]) for k in at}
    return tuple(sorted(found))


def longest_run(recording: Recording) -> Recording:
    """The longest stretch between two resets, with a note; the recording itself without any."""
    times = reset_times_s(recording)
    if not times:
        return recording
    edges = [recording.start_s, *times, np.nextafter(recording.end_s, np.inf)]
    k = int(np.argmax(np.diff(edges)))
    start, end = edges[k], float(np.nextafter(edges[k + 1], -np.inf))
    cut = recording.between(start, end)
    what = "truck was reset at " + ", ".join(f"{time:.2f} s" for time in times)
    note = f"the {what}; compared from {start:.2f} s to {end:.2f} s, the longest run"
    return Recording(cut.name, cut.channels, cut.blowouts, cut.metadata, (*cut.notes, note))
