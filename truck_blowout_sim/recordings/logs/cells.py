"""Cells of a text log as numbers: decimal comma, clock times, dates, words for "nothing"."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from datetime import datetime, timezone

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

_NOTHING = frozenset({"", "-", "--", "nan", "na", "n/a", "null", "none", "inf", "-inf", "+inf",
                      "#n/a", "1.#qnan", "-1.#ind", "---"})  # fmt: skip
_CLOCK = re.compile(r"(?:(\d+):)?(\d{1,2}):(\d{1,2}(?:[.,:]\d+)?)\s*(am|pm)?", re.IGNORECASE)
_DATE = re.compile(r"\d{1,4}[-/.]\d{1,2}[-/.]\d{1,4}[ T]\d{1,2}:\d{2}.*")
_DATE_FORMS = ("%d.%m.%Y %H:%M:%S.%f", "%d.%m.%Y %H:%M:%S", "%m/%d/%Y %H:%M:%S.%f",
               "%m/%d/%Y %H:%M:%S", "%Y/%m/%d %H:%M:%S.%f", "%Y/%m/%d %H:%M:%S")  # fmt: skip
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
    """Seconds since midnight of a clock time, since 1970 of a date; NaN if it is neither."""
    text = cell.strip().strip('"')
    match = _CLOCK.fullmatch(text)
    if match:
        hours, minutes, rest, half = match.groups()
        whole = int(hours or 0) % 12 + 12 * (half.lower() == "pm") if half else int(hours or 0)
        # a colon before the fraction: hh:mm:ss:mmm
        return 3600.0 * whole + 60.0 * int(minutes) + float(re.sub("[,:]", ".", rest))
    return _date(text) if _DATE.fullmatch(text) else math.nan


def _date(text: str) -> float:
    plain = text.rstrip("Z").replace(",", ".")
    try:
        return _stamp(datetime.fromisoformat(plain.replace("T", " ")))
    except ValueError:
        pass
    for form in _DATE_FORMS:
        try:
            return _stamp(datetime.strptime(plain, form))
        except ValueError:
            continue
    return math.nan


def _stamp(moment: datetime) -> float:
    known = moment if moment.tzinfo else moment.replace(tzinfo=timezone.utc)
    return known.timestamp()


def column_of(cells: Sequence[str], decimal: str) -> tuple[FloatArray, str, int | None]:
    """A column's numbers.

    Returns:
        Values (NaN where the cell says nothing or is no number); ``clock`` if the cells are times
        of day or dates, else empty; the row of the first cell that is no number.
    """
    try:
        plain = cells if decimal == "." else [cell.replace(",", ".") for cell in cells]
        values = np.fromiter(map(float, plain), dtype=np.float64, count=len(cells))
        if not any("_" in cell for cell in cells[:1]):
            return np.where(np.isfinite(values), values, np.nan), "", None
    except ValueError:
        pass
    values = np.array([number(cell, decimal) for cell in cells])
    told = np.array([not is_nothing(cell) for cell in cells], dtype=np.bool_)
    wrong = told & np.isnan(values)
    if wrong.sum() > 0.5 * max(told.sum(), 1):
        times = np.array([seconds(cell) for cell in cells])
        if np.isfinite(times).sum() > 0.5 * max(told.sum(), 1):
            wrong = told & np.isnan(times)
            return _past_midnight(times), "clock", _first(wrong)
    return values, "", _first(wrong)


def _past_midnight(times: FloatArray) -> FloatArray:
    """Times of day that go on counting after midnight."""
    there = np.flatnonzero(np.isfinite(times))
    steps = np.diff(times[there])
    days = np.concatenate(([0], np.cumsum(steps < -0.5 * _DAY_S)))
    out = times.copy()
    out[there] += _DAY_S * days
    return out


def _first(wrong: NDArray[np.bool_]) -> int | None:
    return int(np.flatnonzero(wrong)[0]) if wrong.any() else None
