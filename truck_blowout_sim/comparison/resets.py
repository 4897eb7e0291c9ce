"""Of a recording in which the truck was reset, the run that a model is compared with.

Inputs of one run cannot drive another.

Validated with: test/comparison/test_resets.py.
"""

from __future__ import annotations

import numpy as np

from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.recordings.resets import reset_times_s


def longest_run(recording: Recording) -> Recording:
    """The longest stretch between two resets, with a note; the recording itself without any."""
    times = reset_times_s(recording.channels)
    if not times:
        return recording
    edges = [recording.start_s, *times, np.nextafter(recording.end_s, np.inf)]
    k = int(np.argmax(np.diff(edges)))
    start, end = edges[k], float(np.nextafter(edges[k + 1], -np.inf))
    cut = recording.between(start, end)
    what = "truck was reset at " + ", ".join(f"{time:.2f} s" for time in times)
    note = f"the {what}; compared from {start:.2f} s to {end:.2f} s, the longest run"
    return Recording(cut.name, cut.channels, cut.blowouts, cut.metadata, (*cut.notes, note))
