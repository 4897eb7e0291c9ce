"""What each sample of a rebuilt record is: stated, derived or interpolated.

A recording whose metadata name a ``provenance`` file has one beside it: the same rows and columns,
with a mark and its source in each cell.

Validated with: test/comparison/test_provenance.py.
"""

from __future__ import annotations

import csv
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.errors import InputError, quoted
from truck_blowout_sim.recordings import Recording

MARKS = ("stated", "derived", "interpolated")


@dataclass(frozen=True, eq=False)
class Marks:
    """Marks of one channel's samples.

    Attributes:
        time_s: instants.
        mark: index into ``MARKS`` of each.
        sources: where the stated and derived ones come from, each once.
    """

    time_s: NDArray[np.float64]
    mark: NDArray[np.int64]
    sources: tuple[str, ...]

    def share(self, mark: str) -> float:
        """Share of the samples with this mark."""
        return float(np.mean(self.mark == MARKS.index(mark)))


def marks_of(path: Path, recording: Recording) -> Mapping[str, Marks]:
    """Marks of each channel, empty for a recording that names no provenance.

    Args:
        path: the recording's file; the provenance lies beside it.
        recording: what was read from it.

    Raises:
        InputError: the file is missing, or a cell carries no mark.
    """
    name = recording.metadata.get("provenance", "").partition(",")[0].strip()
    if not name:
        return {}
    file = path.parent / name
    if not file.is_file():
        raise InputError("the provenance that the recording names is missing", file=file)
    with file.open(encoding="utf-8", newline="") as lines:
        rows = list(csv.reader(line for line in lines if not line.startswith("#")))
    if len(rows) < 2:
        raise InputError("no rows", file=file, expected="one mark a sample")
    times = _times(rows, file)
    return {
        channel: _column(rows, column, times, file)
        for column, channel in enumerate(rows[0])
        if column and channel in recording
    }


def _times(rows: list[list[str]], file: Path) -> NDArray[np.float64]:
    try:
        return np.array([float(row[0]) for row in rows[1:]])
    except (ValueError, IndexError) as error:
        raise InputError(f"column time_s: {error}", file=file, expected="a number a row") from error


def _column(rows: list[list[str]], column: int, times: NDArray[np.float64], file: Path) -> Marks:
    marks: list[int] = []
    kept: list[int] = []
    sources: dict[str, None] = {}
    for line, row in enumerate(rows[1:], start=2):
        cell = row[column].strip() if column < len(row) else ""
        if not cell:
            continue
        word, _, source = cell.partition(" ")
        if word not in MARKS:
            raise InputError(
                f"mark {quoted(word)}",
                file=file,
                where=f"line {line}, column {rows[0][column]}",
                expected="one of " + ", ".join(MARKS),
            )
        marks.append(MARKS.index(word))
        kept.append(line - 2)
        if source and word != "interpolated":
            sources[source] = None
    return Marks(times[kept], np.array(marks, dtype=np.int64), tuple(sources))
