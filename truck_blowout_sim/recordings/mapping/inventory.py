"""What is in a log: columns with rates, sizes and gaps, clocks, and what becomes which channel.

Validated with: test/recordings/test_bring_your_own_log.py.
"""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings.logs import open_log
from truck_blowout_sim.recordings.logs.bag_log import BagLog, lateness_s
from truck_blowout_sim.recordings.logs.log import Column
from truck_blowout_sim.recordings.mapping.mapping_file import load_mapping
from truck_blowout_sim.recordings.mapping.oddities import oddities
from truck_blowout_sim.recordings.mapping.opened import Opened, open_test
from truck_blowout_sim.recordings.mapping.proposing import (
    Proposal,
    Wheels,
    propose,
)
from truck_blowout_sim.recordings.mapping.rules import Rules, Source
from truck_blowout_sim.recordings.mapping.signs import gravity_is_removed
from truck_blowout_sim.recordings.mapping.times import time_column, unknown_time_unit
from truck_blowout_sim.recordings.units import find_unit

FloatArray = NDArray[np.float64]
_GAP_FACTOR = 2.5


@dataclass(frozen=True)
class Line:
    """One column of a log.

    Attributes:
        name, unit: as in the log.
        samples: numbers in it.
        rate_hz: by the median step; None where there is no time.
        low, high: smallest and largest number.
        gaps: silences longer than 2.5 steps.
        channel: what it becomes, empty if nothing.
        by: ``name`` (a channel's own), ``mapping`` or ``guess``.
        received_late_s: median time of reception after the header stamp, for bags.
    """

    name: str
    unit: str
    samples: int
    rate_hz: float | None
    low: float
    high: float
    gaps: int
    channel: str = ""
    by: str = ""
    received_late_s: float | None = None


@dataclass(frozen=True)
class Further:
    """A further file of the test.

    Attributes:
        file: as a mapping names it.
        time_column, time_unit: where its rows have one time column; ``guessed``: no unit is stated.
        unknown_time_unit: the unit that the log states, where it is not known here.
    """

    file: str
    time_column: str
    time_unit: str
    guessed: bool
    unknown_time_unit: str = ""


@dataclass(frozen=True)
class Inventory:
    """Everything that `inspect` says; ``time_guessed``: the time's unit is not stated.

    ``unknown_time_unit``: the one that is stated, where it is not known here.
    """

    file: str
    kind: str
    time_column: str
    time_unit: str
    start_s: float | None
    end_s: float | None
    lines: tuple[Line, ...]
    proposals: tuple[Proposal, ...] = ()
    notes: tuple[str, ...] = ()
    metadata: dict[str, str] = field(default_factory=dict)
    blowouts: tuple[tuple[float, str], ...] = ()
    time_guess: tuple[str, str] | None = None
    gravity_removed: bool = False
    time_guessed: bool = False
    further: tuple[Further, ...] = ()
    unknown_time_unit: str = ""

    @property
    def unused(self) -> tuple[str, ...]:
        """Columns that become nothing."""
        return tuple(line.name for line in self.lines if not line.channel)


def inspect_log(
    path: str | os.PathLike[str], *, mapping: str | os.PathLike[str] | None = None,
    namespace: str | None = None, also: Iterable[str | os.PathLike[str]] = (),
    wheels: Wheels | None = None,
) -> Inventory:
    """Look into a log, with or without a mapping.

    ``wheels``: of the vehicle that it is of, for guesses; None: the default truck's.

    Raises:
        InputError: it cannot be read.
    """
    rules, also = load_mapping(mapping) if mapping else Rules(), tuple(also)
    try:
        files = open_test(Path(path), rules, also=map(Path, also), namespace=namespace)
    except InputError as error:
        if mapping or "time column" not in error.problem:
            raise
        # a log is shown also where its time is not understood yet
        files = [_without_time(Path(path), error), *(_without_time(Path(p)) for p in also)]
    # absurd numbers overflow in sums of squares: they are shown, and no guess rests on them
    with np.errstate(over="ignore", invalid="ignore"):
        guesses = [[] for _ in files] if mapping else _proposals(files, wheels)
    proposals = tuple(one for some in guesses for one in some)
    lines = [line for opened, some in zip(files, guesses, strict=True)
             for line in _lines(opened, rules, some)]  # fmt: skip
    notes = [n for f in files for n in (*f.notes, *(() if mapping else oddities(f)))]
    main = files[0]
    span = _span(main)
    rows = main.rows
    guess = _time_guess(main) if rows is None else None
    blowouts = main.native.blowouts if main.native else ()
    return Inventory(
        str(path), main.log.kind, rows.column if rows else "", rows.unit if rows else "",
        *span, tuple(lines), proposals, tuple(notes), main.metadata,
        tuple((b.time_s, "+".join(b.tires)) for b in (*blowouts, *rules.blowouts)),
        guess,
        any(gravity_is_removed(f.log, some) for f, some in zip(files, guesses, strict=True)),
        rows is not None and rows.guessed, tuple(_further(main, f) for f in files[1:]),
        _unknown_time_unit(main, rows.column if rows else (guess or ("", ""))[0]),
    )  # fmt: skip


def _further(main: Opened, opened: Opened) -> Further:
    column, unit = (opened.rows.column, opened.rows.unit) if opened.rows else (
        _time_guess(opened) or ("", ""))  # fmt: skip
    return Further(_name_in_mapping(main, opened), column, unit,
                   opened.rows is None or opened.rows.guessed,
                   _unknown_time_unit(opened, column))  # fmt: skip


def _unknown_time_unit(opened: Opened, column: str) -> str:
    return unknown_time_unit(opened.log.column(column)) if column else ""


def _name_in_mapping(main: Opened, opened: Opened) -> str:
    """A file's name, as a mapping finds files beside the log; elsewhere the whole path."""
    beside = opened.path.resolve().parent == main.path.resolve().parent
    return opened.path.name if beside else str(opened.path.resolve())


def _time_guess(opened: Opened) -> tuple[str, str] | None:
    """The likely time column of a log that does not state its unit: long steps are ms."""
    names = list(opened.log.names)
    if isinstance(opened.log, BagLog) or not names or opened.log.column(names[0]).times:
        return None
    column = time_column(opened.log)
    return (column, "ms") if column else None


def _without_time(path: Path, error: InputError | None = None) -> Opened:
    log = open_log(path)
    said = [f"{error.problem}; expected {error.expected}"] if error else []
    return Opened(path, "", log, notes=[*said, *log.notes])


def _proposals(files: list[Opened], wheels: Wheels | None) -> list[list[Proposal]]:
    """Guesses for each file; a channel that several have is taken from the first."""
    taken: dict[str, object] = {}
    for opened in files:
        taken |= opened.native.channels if opened.native else {}
    found = []
    for opened in files:
        rows = opened.rows
        own = {rows.column} if rows else set()
        others = [f for f in files if f is not opened]
        some = [replace(p, file=_file_of(p.column, files[0], opened, others))
                for p in propose(opened.log, taken, wheels, rows.time_s if rows else None)
                if p.column not in opened.native_columns | own]  # fmt: skip
        taken |= {p.channel: p for p in some}
        found.append(some)
    return found


def _file_of(column: str, main: Opened, opened: Opened, others: list[Opened]) -> str:
    """The file that a mapping must name: a further one, or one of several with this column."""
    if opened is main and not any(other.log.find(column) for other in others):
        return ""
    return _name_in_mapping(main, opened)


def _lines(opened: Opened, rules: Rules, proposals: Iterable[Proposal]) -> list[Line]:
    guessed = {proposal.column: proposal.channel for proposal in proposals}
    mapped = _mapped(opened, rules)
    own = opened.rows.column if opened.rows else ""
    guess = (_time_guess(opened) or ("", ""))[0]
    out = []
    for name in opened.log.names:
        if name == own or (not own and name == guess):
            continue
        column = opened.log.column(name)
        channel, by = mapped.get(name, ""), "mapping"
        if not channel and name in opened.native_columns:
            channel, by = _own_name(opened, name), "name"
        if not channel and name in guessed:
            channel, by = guessed[name], "guess"
        out.append(_line(opened, name, column, channel, by if channel else ""))
    return out


def _mapped(opened: Opened, rules: Rules) -> dict[str, str]:
    found: dict[str, str] = {}
    for channel, source in rules.channels.items():
        name = opened.log.find(source.column) if _may_be_in(source, opened) else None
        if name:
            found[name] = f"{found[name]}, {channel}" if name in found else channel
    return found


def _may_be_in(source: Source, opened: Opened) -> bool:
    return source.file in ("", opened.path.name, str(opened.path), opened.stated)


def _own_name(opened: Opened, name: str) -> str:
    if isinstance(opened.log, BagLog):
        return "by its topic"
    native = opened.native
    return name if native and name in native else "by its name"


def _line(opened: Opened, name: str, column: Column, channel: str, by: str) -> Line:
    told = column.values[np.isfinite(column.values)]
    times = next(iter(column.times.values()), None)
    if times is None and opened.rows is not None:
        times = opened.rows.time_s
    rate, gaps = _rate(times, column.values)
    late = lateness_s(column)
    unit = find_unit(column.unit)
    return Line(
        name, unit.name if unit else column.unit, int(told.size), rate,
        float(told.min()) if told.size else float("nan"),
        float(told.max()) if told.size else float("nan"),
        gaps, channel, by, late[0] if late else None,
    )  # fmt: skip


def _rate(times: FloatArray | None, values: FloatArray) -> tuple[float | None, int]:
    if times is None or times.size != values.size:
        return None, 0
    told = times[np.isfinite(times) & np.isfinite(values)]
    steps = np.diff(told)
    if not steps.size or not np.median(steps) > 0.0:
        return None, 0
    middle = float(np.median(steps))
    return 1.0 / middle, int(np.count_nonzero(steps > _GAP_FACTOR * middle))


def _span(opened: Opened) -> tuple[float | None, float | None]:
    if opened.native:
        return opened.native.start_s, opened.native.end_s
    if opened.rows is not None:
        told = opened.rows.time_s[np.isfinite(opened.rows.time_s)] + opened.origin_s
        return (float(told[0]), float(told[-1])) if told.size else (None, None)
    edges = [t for name in opened.log.names[:1] for t in opened.log.column(name).times.values()]
    return (float(edges[0][0]), float(edges[0][-1])) if edges and edges[0].size else (None, None)
