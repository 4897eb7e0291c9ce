"""The clocks of a test's files: which are absolute, and how one is laid on another.

Validated with: test/recordings/test_mapping.py, test/recordings/test_logs_binary.py.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from truck_blowout_sim.recordings.bag_writer import ORIGIN_KEY
from truck_blowout_sim.recordings.logs.bag_log import HEADER, RECEIVE, BagLog
from truck_blowout_sim.recordings.logs.mdf_log import MdfLog

if TYPE_CHECKING:
    from truck_blowout_sim.recordings.logs import Log
    from truck_blowout_sim.recordings.mapping.opened import Opened
    from truck_blowout_sim.recordings.mapping.rules import Rules

CLOCK_START = "clock_start_s"
# Seconds since 1970 are more than this (three years), seconds since midnight are less.
_EPOCH_S = 1e8
_SAME_DAY_S = 1e5
_ZONE_STEP_S = 900.0  # the clocks of two time zones differ by quarters of an hour


def set_clock(opened: Opened, rules: Rules) -> None:
    """Find where a file's own time 0 lies, on the file's columns and on an absolute clock."""
    if opened.native:
        _set_native_clock(opened)
        return
    first_s = _first_absolute_s(opened, rules)
    if first_s is not None:
        opened.zero_s, opened.origin_s = first_s, -first_s
    elif isinstance(opened.log, MdfLog):
        opened.zero_s = opened.log.start_s


def lay_on(opened: Opened, main: Opened) -> None:
    """Move a further file onto the clock of the log itself, or say why it is not moved."""
    if opened.zero_s is None and main.zero_s is None:
        return
    reason = _why_apart(opened, main)
    if reason:
        opened.notes.append(f"{reason}: its time is taken to begin with that of {main.path.name};"
                            " shift_s moves it")  # fmt: skip
        return
    assert opened.zero_s is not None
    assert main.zero_s is not None
    later_s = _without_noise_s(opened.zero_s - main.zero_s)
    opened.origin_s = _without_noise_s(opened.origin_s + opened.zero_s - main.zero_s)
    if abs(later_s) >= _ZONE_STEP_S:
        opened.notes.append(f"{opened.path.name} begins {later_s:g} s after {main.path.name} by"
                            " their clocks, which may be of two time zones: shift_s moves it")
    if opened.native:
        opened.native = opened.native.shifted(later_s)
    elif isinstance(opened.log, MdfLog) and later_s:
        opened.notes.append(f"{opened.path.name} starts {later_s:g} s after {main.path.name}, as"
                            " both say of themselves: moved by that")  # fmt: skip


def wanted(log: Log, rules: Rules) -> list[str]:
    """Columns of a log that the rules take."""
    found = (log.find(source.column) for source in rules.channels.values())
    return [name for name in dict.fromkeys(found) if name]


def _set_native_clock(opened: Opened) -> None:
    assert opened.native is not None
    opened.zero_s = _number(opened.native.metadata.get(CLOCK_START))
    if isinstance(opened.log, BagLog):  # stamps are absolute, or lie beside the stated origin
        stated_s = _number(opened.log.metadata.get(ORIGIN_KEY))
        opened.origin_s = -(opened.zero_s or 0.0) if stated_s is None else stated_s


def _why_apart(opened: Opened, main: Opened) -> str:
    """Why two clocks cannot be compared; empty if they can."""
    name, other = opened.path.name, main.path.name
    if opened.zero_s is None or main.zero_s is None:
        return f"{name} has a clock of its own"
    dated = [file.path.name for file in (opened, main) if (file.zero_s or 0.0) > _EPOCH_S]
    if len(dated) == 1:
        return f"the clocks of {name} and {other} cannot be compared, only {dated[0]} has a date"
    apart_s = opened.zero_s - main.zero_s
    return f"{name} begins {apart_s:g} s from {other}" if abs(apart_s) >= _SAME_DAY_S else ""


def _first_absolute_s(opened: Opened, rules: Rules) -> float | None:
    """First instant of columns that tell a date or time of day; None if they count from 0."""
    if opened.rows is not None:
        told = opened.rows.time_s[np.isfinite(opened.rows.time_s)]
        return float(told[0]) if opened.rows.absolute and told.size else None
    firsts = []
    for name in wanted(opened.log, rules):
        column = opened.log.column(name)
        if column.values.size:
            chosen = column.times.get(rules.time.column) if rules.time.column else None
            base = next(iter(column.times.values())) if chosen is None else chosen
            alone = HEADER not in column.times and RECEIVE in column.times
            firsts.append(float(base[0]) - opened.other_clock_s * alone)
    first_s = min(firsts, default=0.0)
    return first_s if first_s > _EPOCH_S else None


def _without_noise_s(moved_s: float) -> float:
    """A difference of seconds since 1970, which carry a quarter of a microsecond of noise."""
    return moved_s if abs(moved_s) > _EPOCH_S else round(moved_s, 6)


def _number(text: str | None) -> float | None:
    try:
        value = float(text or "")
    except ValueError:
        return None
    return value if math.isfinite(value) else None
