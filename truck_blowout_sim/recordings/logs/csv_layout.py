"""How a text log is laid out: separator, decimal sign, header lines, units, first row of numbers.

The separator and decimal sign are those under which the lines in the middle of the file fall into
the most numbers. The header is what stands above the first of such lines, as wide as they are.

Known limits: one table a file; no thousands separators.
Validated with: test/recordings/test_logs_text.py (CarSim, VBOX, MATLAB and other exports).
"""

from __future__ import annotations

import csv
import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings.logs.cells import is_nothing, is_number
from truck_blowout_sim.recordings.units import find_unit

_SEPARATORS = (",", ";", "\t", "|", " ")
_SAMPLED_LINES = 40
_MOST_HEADER_LINES = 200
_NUMERIC_SHARE = 0.5
_UNIT_SHARE = 0.5
_IN_NAME = re.compile(r"(.+?)\s*[\[({]\s*([^\])}]*)\s*[\])}]\s*")


@dataclass(frozen=True)
class Layout:
    """Where things stand in a text log.

    Attributes:
        separator: between cells; a blank stands for any run of blanks.
        decimal: ``.`` or ``,``.
        first: index of the first line of numbers.
        names: of the columns, each once.
        units: as stated, empty where none is.
        above: lines above the column names.
    """

    separator: str
    decimal: str
    first: int
    names: tuple[str, ...]
    units: tuple[str, ...]
    above: tuple[str, ...]

    def cells(self, line: str) -> list[str]:
        """The cells of one line."""
        return split(line, self.separator)


def split(line: str, separator: str) -> list[str]:
    """Cells of a line; quoted ones may hold the separator."""
    if separator == " ":
        return line.split()
    if '"' not in line:
        return line.split(separator)
    return next(csv.reader([line], delimiter=separator), [])


def find_layout(path: Path, lines: Sequence[str]) -> Layout:
    """Find out how a log is laid out.

    Raises:
        InputError: there is no table of numbers in it.
    """
    numbered = [i for i, line in enumerate(lines) if line.strip()]
    if not numbered:
        raise InputError("is empty", file=path, expected="a log: column names and rows of numbers")
    separator, decimal, width = _best(lines, numbered)
    if not width:
        raise InputError("holds no table of numbers", file=path,
                         expected="a log: column names and rows of numbers")  # fmt: skip
    first = next((i for i in numbered[:_MOST_HEADER_LINES]
                  if _is_row(lines[i], separator, decimal, width)), numbered[0])  # fmt: skip
    header = [i for i in numbered if i < first]
    rows = [(i, split(lines[i], separator)) for i in header]
    wide = [(i, cells) for i, cells in rows if _same_width(cells, width)]
    names, units, used = _names(wide, width)
    above = tuple(lines[i] for i in header if i < used)
    return Layout(separator, decimal, first, names, units, above)


def _best(lines: Sequence[str], numbered: Sequence[int]) -> tuple[str, str, int]:
    """Separator, decimal sign and number of columns that make the most numbers."""
    middle = len(numbered) // 2
    # the last line may be cut short; short logs are nearly all header
    sample = numbered[max(0, middle - _SAMPLED_LINES // 2) : middle + _SAMPLED_LINES // 2]
    if len(sample) < _SAMPLED_LINES:
        sample = numbered[-_SAMPLED_LINES:]
    best = (0.0, ",", ".", 0)
    for separator in _SEPARATORS:
        for decimal in (".", ","):
            if separator == decimal and not any('"' in lines[i] for i in sample):
                continue  # a comma within a number is one only in quotes
            rows = [split(lines[i], separator) for i in sample]
            width = Counter(len(row) for row in rows).most_common(1)[0][0]
            fitting = [row for row in rows if len(row) == width]
            numeric = sum(is_number(cell, decimal) for row in fitting for cell in row)
            told = sum(not is_nothing(cell) for row in fitting for cell in row)
            if width < 2 or not told or numeric / told < _NUMERIC_SHARE:
                continue
            # a comma within numbers splits them into more cells: whole rows of numbers count most
            score = numeric / len(sample) * (numeric / told) ** 2
            if score > best[0] * (1.0 if decimal == "." else 1.0 + 1e-9):
                best = (score, separator, decimal, width)
    return best[1], best[2], best[3]


def _same_width(cells: Sequence[str], width: int) -> bool:
    return len(cells) == width or (len(cells) == width + 1 and not cells[-1].strip())


def _is_row(line: str, separator: str, decimal: str, width: int) -> bool:
    cells = split(line, separator)
    told = [cell for cell in cells if not is_nothing(cell)]
    numeric = sum(is_number(cell, decimal) for cell in told)
    return len(cells) == width and bool(told) and numeric >= max(1, _NUMERIC_SHARE * len(told))


def _names(
    rows: Sequence[tuple[int, list[str]]], width: int
) -> tuple[tuple[str, ...], tuple[str, ...], int]:
    """Names and units from the lines above the numbers, and the first of the lines used."""
    units = [""] * width
    left = list(rows)
    unit_rows = [(i, cells) for i, cells in left if _is_unit_row(cells)]
    if unit_rows:
        index, cells = unit_rows[-1]
        units = [_unit_text(cell) for cell in cells[:width]]
        left = [row for row in left if row[0] != index]
    if not left:
        return tuple(f"column {i + 1}" for i in range(width)), tuple(units), 0
    index, cells = max(left, key=lambda row: (_distinct(row[1]), row[0]))
    names = []
    for i, cell in enumerate(cells[:width]):
        name, unit = _split_unit(cell.strip().strip('"').lstrip("#").strip() or f"column {i + 1}")
        names.append(name)
        units[i] = units[i] or unit
    used = min(index, *(row[0] for row in unit_rows)) if unit_rows else index
    return _each_once(names, units), tuple(units), used


def _distinct(cells: Sequence[str]) -> int:
    return len({cell.strip() for cell in cells if cell.strip()})


def _is_unit_row(cells: Sequence[str]) -> bool:
    told = [cell for cell in cells if cell.strip().strip('"')]
    units = [c for c in told if find_unit(c.strip().strip('"')) or c.strip()[:1] in ("[", "(")]
    return len(told) > 1 and len(units) >= max(2, _UNIT_SHARE * len(told))


def _unit_text(cell: str) -> str:
    return cell.strip().strip('"').strip("[](){} ")


def _split_unit(text: str) -> tuple[str, str]:
    """``Speed [km/h]`` as name and unit; brackets that hold no unit stay in the name."""
    match = _IN_NAME.fullmatch(text)
    if match and (find_unit(match[2]) or "[" in text):
        return match[1].strip(), match[2].strip()
    return text, ""


def _each_once(names: Sequence[str], units: Sequence[str]) -> tuple[str, ...]:
    """Doubled names told apart by their unit, or else by a number."""
    out: list[str] = []
    for name, unit in zip(names, units, strict=True):
        wanted = name
        if wanted in out and unit:
            wanted = f"{name} [{unit}]"
        number = 2
        while wanted in out:
            wanted, number = f"{name} #{number}", number + 1
        out.append(wanted)
    return tuple(out)
