"""CSV to recording: one row an instant, header and metadata as in the interface description.

References: interface description, "A recording", format 2; RFC 4180 for quoting.
Known limits: comma separated, decimal point, UTF-8; other text logs are read through a mapping.
Validated with: test/recordings/test_csv_format.py (round trip and fuzz by hypothesis).
"""

from __future__ import annotations

import csv
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.errors import InputError, quoted
from truck_blowout_sim.recordings.channels import BLOWOUT_EVENT, Channel
from truck_blowout_sim.recordings.checks import check_times, check_values, without_glitches
from truck_blowout_sim.recordings.csv_header import Header, parse_header
from truck_blowout_sim.recordings.names import parts_of
from truck_blowout_sim.recordings.recording import Blowout, Recording, Series
from truck_blowout_sim.recordings.resets import reset_times_s, run_at

FloatArray = NDArray[np.float64]


def names_channels(path: Path) -> bool:
    """Whether a CSV is a recording under the names of the channel table, and not another log."""
    with path.open("rb") as file:
        for line in file:
            text = line.decode("utf-8-sig", "replace").strip()
            if text and not text.startswith("#"):
                cells = [cell.strip().strip('"') for cell in text.split(",")]
                known = {channel.name for channel in parts_of(cells).table()}
                return "time_s" in cells and bool(known & set(cells))
    return False


def read_csv(
    path: Path, *, tires: Iterable[str] = (), hubs: Iterable[str] = (), strict: bool = True
) -> Recording:
    """Read a CSV recording.

    Args:
        path: the file.
        tires: tire names of the vehicle besides the default truck's and those that a line
            ``# tire_names: …`` declares.
        hubs: likewise, ``# hub_names: …``.
        strict: refuse a column that is nearly a channel's name; else it is left out.

    Raises:
        InputError: with line, column, value and expectation.
        FileNotFoundError: no such file.
    """
    lines = _lines(path)
    header = parse_header(path, lines, tires=tires, hubs=hubs, strict=strict)
    body = _Body(path, header, _rows(path, lines, header))
    time_s = body.times()
    channels, notes = {}, list(header.notes)
    for column, channel in header.channels.items():
        series = body.series(column, channel, time_s, notes)
        if len(series):
            channels[channel.name] = series
    blowouts = body.blowouts(time_s, reset_times_s(channels))
    return Recording(path.stem, channels, blowouts, header.metadata, tuple(notes))


@dataclass(frozen=True)
class _Body:
    path: Path
    header: Header
    rows: list[list[str]]

    def times(self) -> FloatArray:
        column = self.header.columns.index("time_s")
        cells = [row[column] for row in self.rows]
        empty = [i for i, cell in enumerate(cells) if not cell.strip()]
        if empty:
            raise self.error(empty[0], "time_s", "is empty", "a time in seconds")
        time_s = self.numbers(cells, range(len(cells)), "time_s")
        if not np.isfinite(time_s).all():
            i = int(np.flatnonzero(~np.isfinite(time_s))[0])
            raise self.error(i, "time_s", f"time {cells[i]}", "a finite time in seconds")
        check_times(time_s, file=self.path, where=lambda i: self.where(i, "time_s"))
        return time_s

    def series(
        self, column: int, channel: Channel, time_s: FloatArray, notes: list[str]
    ) -> Series:
        cells = [row[column] for row in self.rows]
        if "" in cells or any(cell.isspace() for cell in cells):
            index = [i for i, cell in enumerate(cells) if cell and not cell.isspace()]
        else:
            index = list(range(len(cells)))
        values = self.numbers([cells[i] for i in index], index, channel.name)
        check_values(
            channel, values, file=self.path, where=lambda i: self.where(index[i], channel.name)
        )
        return Series(*without_glitches(channel, time_s[index], values, notes))

    def numbers(self, cells: Sequence[str], index: Sequence[int], name: str) -> FloatArray:
        try:
            values = np.fromiter(map(float, cells), dtype=np.float64, count=len(cells))
        except ValueError:
            values = None
        if values is not None and not any("_" in cell for cell in cells):
            return values
        for i, cell in zip(index, cells, strict=True):
            if not _is_number(cell):
                expected = "a number, or nothing where it was not measured"
                if i == 0:
                    expected += " (units stand in the column's name, not in a line of their own)"
                raise self.error(i, name, quoted(cell), expected)
        raise AssertionError("a cell that is no number was there a moment ago")

    def blowouts(self, time_s: FloatArray, resets_s: Sequence[float]) -> tuple[Blowout, ...]:
        if BLOWOUT_EVENT.name not in self.header.columns:
            return ()
        column = self.header.columns.index(BLOWOUT_EVENT.name)
        blown: dict[int, set[str]] = {}  # in each run
        found = []
        for i, row in enumerate(self.rows):
            cell = row[column].strip()
            if cell:
                at_s = float(time_s[i])
                in_run = blown.setdefault(run_at(at_s, resets_s), set())
                found.append(Blowout(at_s, self._tires(i, cell, in_run)))
        return tuple(found)

    def _tires(self, i: int, cell: str, blown: set[str]) -> tuple[str, ...]:
        tires = tuple(name.strip() for name in cell.split("+"))
        for tire in tires:
            if not self.header.parts.knows_tire(tire):
                names = ", ".join(self.header.parts.tires) or "steer_left, drive_1_left_outer, …"
                raise self.error(i, "blowout", f"unknown tire {quoted(tire)}", f"one of {names}")
            if tire in blown:
                raise self.error(
                    i, "blowout", f"{tire} is blown a second time",
                    "each tire at most once, or a reset between (the position jumps)",
                )  # fmt: skip
            blown.add(tire)
        return tires

    def where(self, i: int, column: str) -> str:
        return f"line {self.header.line + 1 + i}, column {column}"

    def error(self, i: int, column: str, problem: str, expected: str) -> InputError:
        return InputError(problem, file=self.path, where=self.where(i, column), expected=expected)


def _lines(path: Path) -> list[str]:
    data = path.read_bytes()
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(
            f"byte {data[error.start]:#04x} is not UTF-8 text",
            file=path,
            where=f"byte {error.start}",
            expected="a CSV of a recording",
        ) from None
    if "\0" in text:
        where = f"byte {data.index(0)}"
        raise InputError("a zero byte", file=path, where=where, expected="a CSV of a recording")
    return text.replace("\r\n", "\n").replace("\r", "\n").split("\n")


def _rows(path: Path, lines: list[str], header: Header) -> list[list[str]]:
    body = lines[header.line :]
    while body and not body[-1].strip():
        body.pop()
    if not body:
        raise InputError(
            "no rows below the header",
            file=path,
            where=f"line {header.line}",
            expected="one row an instant",
        )
    rows = []
    width = len(header.columns)
    for i, line in enumerate(body):
        number = header.line + 1 + i
        row = _split(path, line, number)
        if len(row) != width:
            hint = " (the file is cut short)" if i == len(body) - 1 and len(row) < width else ""
            raise InputError(
                f"{len(row)} cells{hint}",
                file=path,
                where=f"line {number}",
                expected=f"{width} cells, as the header has",
            )
        rows.append(row)
    return rows


def _split(path: Path, line: str, number: int) -> list[str]:
    if '"' not in line:
        return line.split(",")
    try:
        return next(csv.reader([line], strict=True))
    except csv.Error as error:
        raise InputError(
            f"quoting: {error}", file=path, where=f"line {number}", expected="comma separated cells"
        ) from None


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return "_" not in cell
