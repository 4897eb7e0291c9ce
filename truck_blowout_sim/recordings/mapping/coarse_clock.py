"""A clock coarser than the log: many rows share one instant, as ten that are all at 12:34:03.

Spreadsheets write whole seconds or tenths of a log that has hundredths. The rows of a tick are laid
evenly over it, those of the first, which may have begun before the log, at its end.

Known limits: a stamp is taken to be cut off, not rounded; rows lost within a tick are not noticed.
Validated with: test/recordings/test_coarse_clock.py.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.recordings.mapping.times import Times

FloatArray = NDArray[np.float64]
# the finer of the two that spreadsheets write; less is lost where rows share a finer stamp
_COARSE_S = 0.1
_SAME = 1e-6


def spread_rows(rows: Times) -> tuple[Times, tuple[str, ...]]:
    """A log's instants, spread where many rows share one, and what a person should know of it."""
    time_s, note = spread(rows.time_s)
    return replace(rows, time_s=time_s), (note,) if note else ()


def spread(time_s: FloatArray) -> tuple[FloatArray, str]:
    """Instants of rows that share ticks, laid evenly over these, and a note on it.

    As given, and no note, where time runs backwards, most ticks have one row, or ticks are fine.
    """
    told = np.isfinite(time_s)
    ticks, first, counts = np.unique(time_s[told], return_index=True, return_counts=True)
    if ticks.size < 3 or (np.diff(time_s[told]) < 0.0).any():
        return time_s, ""
    tick, usual = float(np.median(np.diff(ticks))), int(np.median(counts[1:-1]))
    if usual < 2 or tick < _COARSE_S * (1.0 - _SAME):
        return time_s, ""
    slots = np.maximum(counts, usual)
    place = np.arange(int(told.sum())) - np.repeat(first, counts)
    place[:counts[0]] += slots[0] - counts[0]
    spread_s = time_s.copy()
    spread_s[told] += tick * place / np.repeat(slots, counts)
    return spread_s, (f"{usual} rows share each {tick:g} s of the clock: they are laid evenly over"
                      " it")  # fmt: skip
