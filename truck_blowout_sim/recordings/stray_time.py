"""Rows on the wrong side of a leap in time, as a receiver writes them before its first fix.

Known limits: one leap, the largest. Logs of several drives leap, too, by less.
Validated with: test/recordings/test_stray_time.py.
"""

from __future__ import annotations

import numpy as np

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings.recording import Recording

# a leap of so many times all other time in the log is no pause
_NO_PAUSE = 100.0
# at steps of 1 ms the inputs of a day take 3.5 GB of memory
LONGEST_S = 86_400.0


def leap(recording: Recording) -> tuple[float, float] | None:
    """Instants before and after a leap beside which the rest of the log is nothing, or None."""
    longest = max((series.time_s for series in recording.channels.values()), key=len, default=None)
    if longest is None or len(longest) < 3:
        return None
    steps = np.diff(longest)
    k = int(np.argmax(steps))
    rest_s = float(longest[-1] - longest[0] - steps[k])
    return (float(longest[k]), float(longest[k + 1])) if steps[k] > _NO_PAUSE * rest_s else None


def stray_times(recording: Recording) -> tuple[str, ...]:
    """A note on a leap in time."""
    found = leap(recording)
    return () if found is None else (
        f"the time leaps from {found[0]:.10g} s to {found[1]:.10g} s; rows without a valid time "
        "should be left out",)


def require_span(recording: Recording) -> None:
    """Refuse a recording over whose span no truck can be simulated or drawn.

    Raises:
        InputError: it lasts longer than a day.
    """
    span_s = recording.end_s - recording.start_s
    if span_s <= LONGEST_S:
        return
    found = leap(recording)
    where = f", with a leap from {found[0]:.10g} s to {found[1]:.10g} s" if found else ""
    raise InputError(f"lasts {span_s:.10g} s{where}", file=recording.name,
                     expected="a day at most; leave out rows without a valid time")
