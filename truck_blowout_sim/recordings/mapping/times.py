"""The time column of a log: which one it is, in which unit, where it begins.

Validated with: test/recordings/test_mapping.py.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.errors import InputError, nearest, quoted
from truck_blowout_sim.recordings.logs.cells import past_midnight
from truck_blowout_sim.recordings.logs.log import Column, Log, no_column
from truck_blowout_sim.recordings.mapping.rules import TimeRule
from truck_blowout_sim.recordings.units import find_unit, not_known, unknown_unit

FloatArray = NDArray[np.float64]

_NAME = re.compile(
    r"(?:log|elapsed|utc|gps|test|sample|rel(?:ative)?|abs(?:olute)?)?[ _.-]*"
    r"(?:time ?stamp|date ?time|time|zeit|t|tiempo|temps|timestamps?)"
    r"(?:[ _.-]*(?:s|sec|ms|us|ns|seconds?|e|h|since.*|of day|stamp))?",
    re.IGNORECASE,
)
_UNIT_IN_NAME = re.compile(r"[ _.-](s|sec|ms|us|ns)$", re.IGNORECASE)
_EPOCH_S = 1e8
# from these numbers on a time since 1970 is in that unit
_EPOCH_UNITS = ((1e17, "ns"), (1e14, "us"), (1e11, "ms"), (_EPOCH_S, "s"))
_LARGEST_STEP_S = 0.5
# no log of a vehicle has 50,000 rows a second: numbers that grow so slowly are days
_SMALLEST_STEP_S = 2e-5
_DAY_S = 86_400.0
# spreadsheets count days from 1899-12-30; numbers from 1954 on are no elapsed days
_FIRST_DATE, _DAY_OF_1970 = 20_000.0, 25_569.0
CLOCK_UNITS = ("clock", "hhmmss")


@dataclass(frozen=True)
class Times:
    """Instants of a log's rows.

    Attributes:
        time_s: seconds, on the log's own clock.
        column: which column it was.
        unit: as stated or guessed.
        guessed: whether the unit is a guess.
        absolute: a time of day or date: the recording begins at 0 then.
        named: whether the mapping or the column's name says that it is time.
    """

    time_s: FloatArray
    column: str
    unit: str
    guessed: bool = False
    absolute: bool = False
    named: bool = True


def times_of(log: Log, rule: TimeRule, where: str = "key time") -> Times:
    """Instants of a log's rows, by the mapping's rule or by name.

    Raises:
        InputError: no such column, no time column, or a unit that cannot be told.
    """
    name = log.find(rule.column) if rule.column else time_column(log)
    if name is None:
        if rule.column:
            raise InputError(no_column(log, rule.column), file=log.path, where=where,
                             expected=nearest(rule.column, log.names))  # fmt: skip
        raise InputError("no time column was found", file=log.path, where=where,
                         expected="in the mapping: time: {from: COLUMN, unit: s}")  # fmt: skip
    column = log.column(name)
    unit, guessed = rule.unit or column.unit, False
    stated = unknown_time_unit(column)
    if rule.column and stated and not rule.unit:
        raise InputError(
            not_known(stated, f"time column {quoted(name)}"),
            file=log.path, where=where,
            expected=f"in the mapping: time: {{from: {name}, unit: s}}, or another unit",
        )  # fmt: skip
    if column.unit in CLOCK_UNITS and not rule.unit:
        unit = column.unit
    elif find_unit(unit) is None or find_unit(unit).quantity != "time":  # type: ignore[union-attr]
        unit, guessed = _unit_by_size(name, column), True
    if not unit:
        step = float(np.nanmedian(np.diff(column.values)))
        raise InputError(
            f"time column {quoted(name)}: no unit is stated, and steps of {step:g} may be ms or s",
            file=log.path, expected=f"in the mapping: time: {{from: {name}, unit: ms}}",
        )  # fmt: skip
    time_s = _seconds(column.values, unit)
    first = time_s[np.isfinite(time_s)][:1]
    of_day = unit == "day" and bool(first.size and 0.0 < first[0] < _DAY_S)
    absolute = unit in CLOCK_UNITS or of_day or bool(first.size and first[0] > _EPOCH_S)
    named = bool(rule.column or _NAME.fullmatch(name.strip()))
    return Times(time_s, name, unit, guessed, absolute, named)


def unknown_time_unit(column: Column) -> str:
    """The unit that a time column states, if it is not known here; else empty."""
    return "" if column.unit in CLOCK_UNITS else unknown_unit(column.unit)


def time_column(log: Log) -> str | None:
    """The column that is time by its name, or else the first that always increases.

    A column with the unit of another quantity, as a distance, is not time, however it increases.
    """
    for name in log.names:
        if _NAME.fullmatch(name.strip()) and _mostly_increases(_comparable(log.column(name))):
            return name
    for name in list(log.names)[:3]:
        column = log.column(name)
        unit = find_unit(column.unit)
        if unit is not None and unit.quantity != "time":
            continue
        values = column.values
        if _mostly_increases(values) and bool(np.all(np.diff(values[np.isfinite(values)]) > 0)):
            return name
    return None


def _comparable(column: Column) -> FloatArray:
    """Numbers that increase with time: digits of a clock begin again at midnight."""
    return _seconds(column.values, "hhmmss") if column.unit == "hhmmss" else column.values


def _mostly_increases(values: FloatArray) -> bool:
    told = values[np.isfinite(values)]
    return told.size > 1 and bool(np.mean(np.diff(told) >= 0) > 0.9) and told[-1] > told[0]


def _unit_by_size(name: str, column: Column) -> str:
    """The unit that the name ends in, or that the size of the numbers allows; empty if neither."""
    match = _UNIT_IN_NAME.search(name)
    if match:
        return match[1].lower()
    told = column.values[np.isfinite(column.values)]
    for least, unit in _EPOCH_UNITS:
        if told.size and told[0] > least:
            return unit
    steps = np.diff(told)
    step = float(np.median(steps)) if steps.size else np.nan
    if (steps > 0.0).any() and float(np.median(steps[steps > 0.0])) < _SMALLEST_STEP_S:
        return "day"
    return "s" if step < _LARGEST_STEP_S else ""


def _seconds(values: FloatArray, unit: str) -> FloatArray:
    if unit == "clock":
        return values
    found = find_unit(unit)
    if found is None:
        raise ValueError(f"{unit} is no unit of time")
    if found.name == "day":
        told = values[np.isfinite(values)]
        dated = bool(told.size and told[0] > _FIRST_DATE)
        return (values - _DAY_OF_1970 if dated else values) * found.factor
    if found.name != "hhmmss":
        return values * found.factor
    hours, rest = np.divmod(values, 10_000.0)
    minutes, seconds = np.divmod(rest, 100.0)
    # rest of a division loses digits: hundredths of seconds are what the format has
    return past_midnight(3600.0 * hours + 60.0 * minutes + np.round(seconds, 6))
