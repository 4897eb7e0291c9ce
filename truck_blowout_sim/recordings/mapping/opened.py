"""The files of one test, opened: as columns, and as a recording where they name channels.

Validated with: test/recordings/test_mapping.py.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from truck_blowout_sim.errors import InputError, quoted
from truck_blowout_sim.recordings.bag_reader import read_bag
from truck_blowout_sim.recordings.channels import BLOWOUT_EVENT
from truck_blowout_sim.recordings.csv_reader import names_channels, read_csv
from truck_blowout_sim.recordings.logs import Log, open_log
from truck_blowout_sim.recordings.logs.bag_log import RECEIVE, BagLog, lateness_s
from truck_blowout_sim.recordings.logs.csv_log import text_note
from truck_blowout_sim.recordings.logs.mat_log import variables_of
from truck_blowout_sim.recordings.mapping.clocks import CLOCK_START, lay_on, set_clock, wanted
from truck_blowout_sim.recordings.mapping.coarse_clock import spread_rows
from truck_blowout_sim.recordings.mapping.rules import Rules, TimeRule
from truck_blowout_sim.recordings.mapping.times import Times, times_of, unknown_time_unit
from truck_blowout_sim.recordings.mat_format import OWN_TIME, TIME, read_mat
from truck_blowout_sim.recordings.mat_thesis import SOURCES, has_thesis_variables
from truck_blowout_sim.recordings.names import parts_of
from truck_blowout_sim.recordings.recording import Recording
from truck_blowout_sim.recordings.topic_names import relative_names
from truck_blowout_sim.recordings.units import Unit, find_unit, not_known

_OTHER_CLOCK_S = 0.5


@dataclass
class Opened:
    """One file.

    Attributes:
        path: where it is.
        stated: how the mapping file names it; empty for the log itself.
        log: its columns.
        native: what it says under the names of the channel table, if it does.
        native_columns: columns that ``native`` took.
        rows: instants of its rows, for logs with one time column.
        zero_s: its own time 0 on an absolute clock, since 1970 or midnight; None without one.
        origin_s: added to the log's times to get the recording's.
        shift_s: added besides, as the mapping says.
        late_s: how far receive stamps run ahead of header stamps; 0 where both are not compared.
        notes: what a person should know.
    """

    path: Path
    stated: str
    log: Log
    native: Recording | None = None
    native_columns: set[str] = field(default_factory=set)
    rows: Times | None = None
    zero_s: float | None = None
    origin_s: float = 0.0
    shift_s: float = 0.0
    late_s: float = 0.0
    notes: list[str] = field(default_factory=list)

    @property
    def other_clock_s(self) -> float:
        """How far receive stamps run ahead of header stamps, if these are two clocks; else 0."""
        return self.late_s if abs(self.late_s) > _OTHER_CLOCK_S else 0.0

    @property
    def name(self) -> str:
        """Short name of the recording."""
        folder = self.path.parent if self.path.name == "metadata.yaml" else self.path
        return folder.resolve().name if folder.is_dir() else folder.stem

    @property
    def metadata(self) -> dict[str, str]:
        """What the file says of itself."""
        found = dict(self.native.metadata) if self.native else dict(self.log.metadata)
        if self.zero_s and not self.native:
            found[CLOCK_START] = repr(self.zero_s)
        return found


def open_test(
    path: Path, rules: Rules, *, also: Iterable[Path] = (), namespace: str | None = None,
    source: str = "experiment",
) -> list[Opened]:
    """Open a log and the further files of its test; the log itself comes first.

    Raises:
        InputError: one of them cannot be read.
    """
    main = _open(path, "", rules.time, rules, namespace, source)
    main.shift_s = rules.shift_s.get(path.name, 0.0)
    set_clock(main, rules)
    if main.zero_s and not main.native:
        main.notes.append(f"time 0 is {main.zero_s:.3f} s on the clock of {path.name}")
    _align_native(main)
    files = [main]
    for place, entry in zip(further_files(path, rules), rules.also, strict=True):
        opened = _open(place, entry.file, entry.time, rules, namespace, source)
        opened.shift_s = entry.shift_s + rules.shift_s.get(entry.file, 0.0)
        files.append(opened)
    for place in also:
        opened = _open(place, str(place), TimeRule(), rules, namespace, source)
        opened.shift_s = rules.shift_s.get(place.name, 0.0)
        files.append(opened)
    for opened in files[1:]:
        set_clock(opened, rules)
        lay_on(opened, main)
        _align_native(opened)
    return files


def further_files(log: Path, rules: Rules) -> list[Path]:
    """Where the mapping's further files are: each beside the log, or beside the mapping file."""
    base = rules.file.parent if rules.file else Path()
    found = []
    for entry in rules.also:
        places = [log.parent / entry.file, base / entry.file]
        found.append(next((place for place in places if place.exists()), places[0]))
    return found


def _open(path: Path, stated: str, time: TimeRule, rules: Rules, namespace: str | None, source: str
          ) -> Opened:  # fmt: skip
    _check_exists(path, rules, stated)
    opened = Opened(path, stated, open_log(path))
    opened.native = _native(path, opened.log, rules, namespace, source)
    if opened.native:
        opened.notes += opened.native.notes
        opened.native_columns = _native_columns(opened.log, opened.native, rules, namespace)
    known = {*opened.notes, *([text_note(BLOWOUT_EVENT.name)] if opened.native else [])}
    opened.notes += [note for note in opened.log.notes if note not in known]
    if isinstance(opened.log, BagLog):
        if rules.time.column != RECEIVE:
            opened.late_s = _late_s(opened.log, rules)
        return opened
    names = [name for name in opened.log.names if not opened.log.column(name).times][:1]
    if not names:
        return opened
    thesis_without_time = opened.native is not None and not time.column
    try:
        opened.rows, coarse = spread_rows(times_of(opened.log, time))
    except InputError:
        if not thesis_without_time:
            raise
    else:
        said = [*_notes_on(opened.rows, opened.log, time), *coarse]
        opened.notes += [f"{path.name}: {note}" for note in said]
    return opened


def _notes_on(rows: Times, log: Log, rule: TimeRule) -> Iterator[str]:
    """What a person should know of a log's time column."""
    column = log.column(rows.column)
    if told := other_unit(rows.column, column.unit, find_unit(rule.unit)):
        yield told
    if not rows.named:
        yield (f"no column is called time; {rows.column!r} is taken for it, because it increases in"
               " every row")
    stated = unknown_time_unit(column) if rows.guessed else ""
    if stated:
        yield (f"time column {rows.column!r} is taken to be in {rows.unit}, by its numbers:"
               f" {not_known(stated)}")
    elif rows.guessed and rows.unit != "s":
        yield f"time column {rows.column!r} is taken to be in {rows.unit}, by its numbers"
    left = np.flatnonzero(~np.isfinite(rows.time_s))
    if left.size:
        first = column.bad or f"row {left[0] + 1}"
        yield f"{left.size} rows without a valid time left out, the first is {first}"


def other_unit(column: str, stated: str, taken: Unit | None) -> str:
    """A note where a mapping takes a column in another unit than the log states; else empty."""
    theirs = find_unit(stated)
    if theirs is None or taken is None or theirs.quantity != taken.quantity:
        return ""
    if (theirs.factor, theirs.offset) == (taken.factor, taken.offset):
        return ""
    return (f"column {quoted(column)} is taken in {taken.name}, as the mapping says; the log states"
            f" {theirs.name}")


def _check_exists(path: Path, rules: Rules, stated: str) -> None:
    if not path.exists():
        file, where = (rules.file or path, "key also") if stated and rules.file else (path, "")
        problem = f"{stated}: no such file" if where else "no such file or directory"
        raise InputError(problem, file=file, where=where, expected="a log")


def _native(path: Path, log: Log, rules: Rules, namespace: str | None, source: str
            ) -> Recording | None:  # fmt: skip
    """The channels that a file names itself; None if it is somebody else's log."""
    if isinstance(log, BagLog):
        ours = any(name.startswith("/truck/") for name in log.topics)
        if not (ours or namespace or rules.topics):
            return None
        remap = {theirs: name for name, theirs in rules.topics.items()}
        return read_bag(path, namespace=namespace, remap=remap)
    suffix = path.suffix.lower()
    if suffix == ".csv" and names_channels(path):
        return read_csv(path, strict=False)
    if suffix == ".mat":
        held = variables_of(path)
        named = TIME in held and any(one.name in held for one in parts_of(held).table())
        if named or has_thesis_variables(held):
            return read_mat(path, source=source, held=held)
    return None


def _native_columns(log: Log, native: Recording, rules: Rules, namespace: str | None) -> set[str]:
    if isinstance(log, BagLog):
        remap = {theirs: name for name, theirs in rules.topics.items()}
        taken = set(relative_names(log.topics, namespace, remap).values())
        return {name for name in log.names
                if name.startswith("/truck/") or name.partition(":")[0] in taken}  # fmt: skip
    own = {*native.channels, "blowout", "time_s"}
    suffix = SOURCES.get(native.metadata.get("source", ""), OWN_TIME)
    return {name for name in log.names if name in own or name.endswith((OWN_TIME, suffix))}


def _align_native(opened: Opened) -> None:
    if opened.native and opened.shift_s:
        opened.native = opened.native.shifted(opened.shift_s)


def _late_s(log: BagLog, rules: Rules) -> float:
    """How far receive stamps run ahead of header stamps, median of the topics that have both."""
    late = [lateness_s(log.column(name)) for name in wanted(log, rules)]
    told = [one[0] for one in late if one]
    return float(np.median(told)) if told else 0.0
