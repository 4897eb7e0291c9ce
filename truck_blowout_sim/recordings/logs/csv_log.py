"""Text logs of any logger: CSV, TSV, TXT, with any separator, decimal sign and header.

Known limits: held in memory as text while it is read.
Validated with: test/recordings/test_logs_text.py.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from truck_blowout_sim.errors import InputError, quoted
from truck_blowout_sim.recordings.logs.cells import column_of, is_nothing
from truck_blowout_sim.recordings.logs.csv_layout import Layout, find_layout
from truck_blowout_sim.recordings.logs.log import Column, Table

_CLOCK_UNIT = "clock"
_MOST_ODD_SHARE = 0.01
_MOST_ODD = 5
_ENTRY = re.compile(r":(?!\d)|(?<!\d):")  # after a key; the colon of 12:34 is none
_BYTE_ORDER_MARKS = {b"\xff\xfe": "utf-16", b"\xfe\xff": "utf-16", b"\xef\xbb\xbf": "utf-8-sig"}


def open_csv(path: Path) -> Table:
    """Read a text log.

    Raises:
        InputError: no text, or no table of numbers in it.
    """
    lines = text_of(path).replace("\r\n", "\n").replace("\r", "\n").split("\n")
    layout = find_layout(path, lines)
    table = Table(path, "text log", {}, metadata=_metadata(layout.above))
    rows, places = _rows(path, lines, layout, table.notes)
    fill(table, layout.names, layout.units, rows, places, layout.decimal)
    return table


def fill(
    table: Table, names: Sequence[str], units: Sequence[str], rows: Sequence[Sequence[str]],
    places: Sequence[int], decimal: str,
) -> None:  # fmt: skip
    """Add the columns that hold numbers; ``places`` are the rows' line numbers, from 1."""
    for name, unit, cells in zip(names, units, zip(*rows, strict=True), strict=True):
        if all(is_nothing(cell) for cell in cells):
            table.unread[name] = "is empty"
            continue
        values, kind, wrong = column_of(cells, decimal)
        bad = "" if wrong is None else f"line {places[wrong]}: {quoted(cells[wrong])}"
        if kind or (values == values).any():
            table.columns[name] = Column(values, _CLOCK_UNIT if kind else unit, bad=bad)
        else:
            table.unread[name] = "holds text"
            table.notes.append(text_note(name))


def text_note(name: str) -> str:
    """What is said of a column of words."""
    return f"column {quoted(name)} holds text: not read"


def text_of(path: Path) -> str:
    """A file's text, whatever its encoding.

    Raises:
        InputError: it holds zero bytes, as no text does.
    """
    data = path.read_bytes()
    for mark, coding in _BYTE_ORDER_MARKS.items():
        if data.startswith(mark):
            return data.decode(coding, "replace")
    if b"\0" in data:
        where = f"byte {data.index(0)}"
        raise InputError("a zero byte", file=path, where=where, expected="a text log")
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError:
        return data.decode("cp1252", "replace")


def _rows(
    path: Path, lines: Sequence[str], layout: Layout, notes: list[str]
) -> tuple[list[list[str]], list[int]]:
    width = len(layout.names)
    rows, places, odd = [], [], []
    for number, line in enumerate(lines[layout.first :], layout.first + 1):
        if not line.strip():
            continue
        cells = layout.cells(line)
        if len(cells) == width + 1 and not cells[-1].strip():
            cells = cells[:-1]
        if len(cells) == width:
            rows.append(cells)
            places.append(number)
        else:
            odd.append(number)
    if len(odd) > max(_MOST_ODD, _MOST_ODD_SHARE * len(rows)):
        raise InputError(
            f"{len(odd)} lines have another number of cells", file=path, where=f"line {odd[0]}",
            expected=f"{width} cells, as the others have",
        )  # fmt: skip
    if odd:
        notes.append(f"{len(odd)} lines with another number of cells left out, the first is"
                     f" line {odd[0]}")  # fmt: skip
    return rows, places


def _metadata(lines: Sequence[str]) -> dict[str, str]:
    found = {}
    for line in lines:
        parts = _ENTRY.split(line.strip().lstrip("#%"), maxsplit=1)
        if len(parts) < 2:
            parts = line.split("=", 1)
        key, value = (*(part.strip(' \t",;') for part in parts), "")[:2]
        if key and value and len(key) < 60:
            found[" ".join(key.split())] = " ".join(value.split())
    return found
