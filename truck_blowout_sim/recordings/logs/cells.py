"""Cells of a text log as numbers: decimal comma, clock times, dates, durations, empty cells."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from datetime import datetime, timezone
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.recordings.units import find_unit

FloatArray = NDArray[np.float64]

_NOTHING = frozenset({"", "-", "--", "nan", "na", "n/a", "null", "none", "#n/a",
                      "1.#qnan", "-1.#ind", "---"})  # fmt: skip
_CLOCK = re.compile(r"(?:(\d+):)?(\d{1,2}):(\d{1,2}(?:[.,:]\d+)?)\s*(am|pm)?", re.IGNORECASE)
_DURATION = re.compile(r"([-+]?\d+(?:[.,]\d+)?) ?(s|sec|min|hr)")  # as MATLAB writes them
_DATE = re.compile(r"(\d{1,4}[-/. ](?:\d{1,2}|[a-z]{3})[-/. ]\d{1,4})(?: +|t)"
                   r"(\d{1,2}:\d{2}(?::.*?)?)(?:z|([-+]\d{2}):?(\d{2}))?",
                   re.IGNORECASE)  # fmt: skip
_DAY_FORMS = ("%Y-%m-%d", "%d.%m.%Y", "%m/%d/%Y", "%d/%m/%Y", "%Y/%m/%d", "%d-%b-%Y", "%d-%m-%Y",
              "%d %b %Y")  # fmt: skip
_DAY_S = 86400.0


def is_number(cell: str, decimal: str) -> bool:
    """Whether a cell is a number, a clock time or a date."""
    return not math.isnan(number(cell, decimal)) or not math.isnan(seconds(cell))


def is_nothing(cell: str) -> bool:
    """Whether a cell says that nothing was measured."""
    return cell.strip().strip('"').lower() in _NOTHING


def number(cell: str, decimal: str = ".") -> float:
    """A cell's number, NaN if it is none."""
    text = cell.strip().strip('"')
    if decimal == ",":
        text = text.replace(",", ".")
    if "_" in text or not text:
        return math.nan
    try:
        value = float(text)
    except ValueError:
        return math.nan
    return value if math.isfinite(value) else math.nan


def seconds(cell: str) -> float:
    """Seconds since midnight of a clock time, since 1970 of a date; of a duration; else NaN."""
    text = cell.strip().strip('"')
    if match := _DURATION.fullmatch(text):
        unit = find_unit(match[2])
        return float(match[1].replace(",", ".")) * unit.factor if unit else math.nan
    if match := _DATE.fullmatch(text):
        day, clock, zone_h, zone_min = match.groups()
        ahead_s = 60.0 * (60 * int(zone_h) + int(f"{zone_h[0]}{zone_min}")) if zone_h else 0.0
        whole = clock if clock.count(":") > 1 else f"{clock}:00"
        return _midnight(day) + _time_of_day(whole) - ahead_s
    return _time_of_day(text)


def _time_of_day(text: str) -> float:
    match = _CLOCK.fullmatch(text)
    if not match:
        return math.nan
    hours, minutes, rest, half = match.groups()
    whole = int(hours or 0) % 12 + 12 * (half.lower() == "pm") if half else int(hours or 0)
    # a colon before the fraction: hh:mm:ss:mmm
    return 3600.0 * whole + 60.0 * int(minutes) + float(re.sub("[,:]", ".", rest))


@lru_cache(maxsize=64)
def _midnight(day: str) -> float:
    """Seconds from 1970 to a day; where day and month can be taken for each other, month first."""
    for form in _DAY_FORMS:
        try:
            return datetime.strptime(day, form).replace(tzinfo=timezone.utc).timestamp()
        except ValueError:
            continue
    return math.nan


def column_of(cells: Sequence[str], decimal: str) -> tuple[FloatArray, str, int | None]:
    """A column's numbers.

    Returns:
        Values (NaN where the cell says nothing or is no number); ``clock`` if the cells are times
        of day or dates, else empty; the row of the first cell that is no number.
    """
    try:
        plain = cells if decimal == "." else [cell.replace(",", ".") for cell in cells]
        values = np.fromiter(map(float, plain), dtype=np.float64, count=len(cells))
        if not any("_" in cell for cell in cells):
            return np.where(np.isfinite(values), values, np.nan), "", _infinite(values)
    except ValueError:
        pass
    values = np.array([number(cell, decimal) for cell in cells])
    told = np.array([not is_nothing(cell) for cell in cells], dtype=np.bool_)
    wrong = told & np.isnan(values)
    if wrong.sum() > 0.5 * max(told.sum(), 1):
        times = np.array([seconds(cell) for cell in cells])
        if np.isfinite(times).sum() > 0.5 * max(told.sum(), 1):
            wrong = told & np.isnan(times)
            return past_midnight(times), "clock", _first(wrong)
    return values, "", _first(wrong)


def past_midnight(times: FloatArray) -> FloatArray:
    """Times of day [s] that go on counting after midnight; nothing was measured where NaN."""
    there = np.flatnonzero(np.isfinite(times))
    steps = np.diff(times[there])
    days = np.concatenate(([0], np.cumsum(steps < -0.5 * _DAY_S)))
    out = times.copy()
    out[there] += _DAY_S * days
    return out


def _infinite(values: FloatArray) -> int | None:
    """The row of the first number that is not finite: `inf`, or one that no float holds."""
    return _first(np.isinf(values))


def _first(wrong: NDArray[np.bool_]) -> int | None:
    return int(np.flatnonzero(wrong)[0]) if wrong.any() else None
