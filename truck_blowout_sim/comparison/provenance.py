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

ENDING = ".provenance.csv"
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
    if not name or path.suffix.lower() != ".csv":
        return {}
    file = path.parent / name
    # The name comes from inside a file that may be anybody's: it must not lead to other files.
    if Path(name).name != name or not name.endswith(ENDING) or file.is_symlink():
        raise InputError(f"provenance {quoted(name)}", file=path, where="metadata line provenance",
                         expected=f"a file beside the recording whose name ends in {ENDING}")
    if not file.is_file():
        raise InputError("the provenance that the recording names is missing", file=file)
    try:
        with file.open(encoding="utf-8", newline="") as lines:
            rows = list(csv.reader(line for line in lines if not line.startswith("#")))
    except (UnicodeDecodeError, csv.Error):
        raise InputError("is no CSV", file=file, expected="one mark a sample") from None
    if len(rows) < 2:
        raise InputError("no rows", file=file, expected="one mark a sample")
    times = _times(rows, file)
    return {
        channel: _column(rows, column, channel, times, file)
        for column, channel in enumerate(rows[0])
        if column and channel in recording
    }


def _times(rows: list[list[str]], file: Path) -> NDArray[np.float64]:
    try:
        return np.array([float(row[0]) for row in rows[1:]])
    except (ValueError, IndexError):
        raise InputError("a row without a time", file=file, where="column time_s",
                         expected="a number a row") from None


def _column(rows: list[list[str]], column: int, channel: str, times: NDArray[np.float64], file: Path
            ) -> Marks:  # fmt: skip
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
                "a cell without a mark",
                file=file,
                where=f"line {line}, column {channel}",
                expected="one of " + ", ".join(MARKS),
            )
        marks.append(MARKS.index(word))
        kept.append(line - 2)
        if source and word != "interpolated":
            sources[source] = None
    return Marks(times[kept], np.array(marks, dtype=np.int64), tuple(sources))
