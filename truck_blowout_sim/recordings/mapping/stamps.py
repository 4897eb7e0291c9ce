"""The stamps of a column: which of a message's are taken, and how late these are.

Validated with: test/recordings/test_logs_bags.py, test/recordings/test_mapping.py.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings.logs.bag_log import HEADER, RECEIVE, lateness_s
from truck_blowout_sim.recordings.logs.log import Column
from truck_blowout_sim.recordings.mapping.opened import Opened
from truck_blowout_sim.recordings.mapping.rules import Rules

FloatArray = NDArray[np.float64]
_TOLD_LATENESS_S = 0.002
_EPOCH_S = 1e8


def times_on_one_clock(
    opened: Opened, rules: Rules, name: str, column: Column, notes: list[str]
) -> FloatArray:
    """Instants of a column's samples on the recording's clock.

    Args:
        opened: the file.
        rules: of the mapping file.
        name: of the column.
        column: its samples.
        notes: get what a person should know.

    Raises:
        InputError: the file has no time column, or one of another length.
    """
    topic = name.partition(":")[0]
    shift_s = opened.shift_s + sum(
        rules.shift_s[key] for key in dict.fromkeys((name, topic)) if key in rules.shift_s
    )
    clock = rules.time.column if rules.time.column in (HEADER, RECEIVE) else ""
    if clock and column.times and clock not in column.times:
        notes.append(f"{topic} has no {clock}: its {next(iter(column.times))} is taken")
    base = column.times.get(clock) if clock else None
    if base is None and column.times:
        base = next(iter(column.times.values()))
    if base is None:
        if opened.rows is None:
            raise InputError("has no time column", file=opened.path,
                             expected="time: {from: COLUMN, unit: s} in the mapping")  # fmt: skip
        base = opened.rows.time_s
        if base.size != column.values.size:
            raise InputError(f"{column.values.size} samples", file=opened.path, where=name,
                             expected=f"{base.size}, as {opened.rows.column} has")  # fmt: skip
    elif HEADER not in column.times and RECEIVE in column.times:
        base = base - opened.other_clock_s
        _tell(notes, _unstamped_note(topic, opened))
    _tell(notes, _lateness_note(topic, column, clock or HEADER))
    moved = base + opened.origin_s
    # seconds since 1970 as float64 carry a quarter of a microsecond of noise
    return (np.round(moved, 6) if abs(opened.origin_s) > _EPOCH_S else moved) + shift_s


def _tell(notes: list[str], note: str) -> None:
    if note and note not in notes:
        notes.append(note)


def _lateness_note(topic: str, column: Column, taken: str) -> str:
    """Words on how late a stamped topic was received, and on the stamp that is taken."""
    late = lateness_s(column)
    if late is None or abs(late[0]) < _TOLD_LATENESS_S:
        return ""
    return (f"{topic} is received {late[0]:.3f} s after its header stamp (median; {late[1]:.3f} s"
            f" between the 5th and 95th percentile): the {taken} is taken")  # fmt: skip


def _unstamped_note(topic: str, opened: Opened) -> str:
    """Words on a topic without header beside others that were received late."""
    if abs(opened.late_s) < _TOLD_LATENESS_S:
        return ""
    if opened.other_clock_s:
        return (f"{topic} has no header stamp: its receive stamps are moved by"
                f" {-opened.other_clock_s:.3f} s, the median of the other topics")  # fmt: skip
    return (f"{topic} has no header stamp: its receive stamps are taken, probably late by"
            f" {opened.late_s:.3f} s, the median of the other topics; shift_s moves it")
