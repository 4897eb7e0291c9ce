"""What of a log would be refused or left out once channels are taken from it.

Validated with: test/recordings/test_bring_your_own_log.py.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from truck_blowout_sim.errors import quoted
from truck_blowout_sim.recordings.mapping.opened import Opened


def oddities(opened: Opened) -> tuple[str, ...]:
    """Notes on the instants of a file's rows, and on cells that are no number."""
    return (*_of_time(opened), *_of_cells(opened))


def _of_time(opened: Opened) -> Iterator[str]:
    """Time that runs backwards, and rows that share an instant."""
    if opened.rows is None:
        return
    times = opened.rows.time_s[np.isfinite(opened.rows.time_s)]
    steps = np.diff(times)
    back = np.flatnonzero(steps < 0.0)
    if back.size:
        i = int(back[0])
        yield (f"{opened.path.name}: time runs backwards, first from {times[i]:.6g} s to"
               f" {times[i + 1]:.6g} s: no channel can be taken from such rows")
    if shared := int(np.count_nonzero(steps == 0.0)):
        yield (f"{opened.path.name}: {shared} rows share their time with a later one, which is"
               " taken")


def _of_cells(opened: Opened) -> Iterator[str]:
    """The first cell of each column that is no number, but for the column of time."""
    time = opened.rows.column if opened.rows else ""
    for name in opened.log.names:
        column = opened.log.column(name)
        if column.bad and name != time and name not in opened.native_columns:
            yield (f"column {quoted(name)}, {column.bad} is not a number: the column is refused"
                   " where a channel takes it")
