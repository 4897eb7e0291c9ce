"""A foreign log as columns: named numbers on their own instants, units as the log states them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.errors import quoted

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Column:
    """One column, read.

    Attributes:
        values: numbers as they stand in the log; NaN where it has none.
        unit: as the log states it, empty if it does not.
        times: instants in seconds by the name of the clock, e.g. ``header stamp`` and
            ``receive stamp``, the usual one first; empty where the log has one time column.
        bad: the first cell that is no number, as ``line 7: 'abc'``; empty if there is none.
    """

    values: FloatArray
    unit: str = ""
    times: Mapping[str, FloatArray] = field(default_factory=dict)
    bad: str = ""


class Log(Protocol):
    """What every reader of foreign logs gives."""

    path: Path
    kind: str
    notes: list[str]
    metadata: dict[str, str]

    @property
    def names(self) -> Sequence[str]:
        """Columns that hold numbers, in the log's order."""
        ...

    def find(self, name: str) -> str | None:
        """The column's full name where a user may write a shorter one; None if there is none."""
        ...

    def column(self, name: str) -> Column:
        """Read one column, by its full name."""
        ...


@dataclass
class Table:
    """A log that is in memory as a whole."""

    path: Path
    kind: str
    columns: dict[str, Column]
    notes: list[str] = field(default_factory=list)
    metadata: dict[str, str] = field(default_factory=dict)
    unread: dict[str, str] = field(default_factory=dict)
    """Columns that hold no numbers, and what they are instead."""

    @property
    def names(self) -> Sequence[str]:
        """Columns that hold numbers, in the log's order."""
        return list(self.columns)

    def find(self, name: str) -> str | None:
        """The column itself; case and blanks at the ends do not count where that is unique."""
        return find_name(name, self.columns)

    def column(self, name: str) -> Column:
        """One column."""
        return self.columns[name]


def no_column(log: Log, name: str) -> str:
    """Why a log has no such column of numbers, as words for an error."""
    unread = log.unread if isinstance(log, Table) else {}
    there = find_name(name, unread)
    return f"column {quoted(name)} {unread[there]}" if there else f"no column {quoted(name)}"


def find_name(name: str, names: Sequence[str] | Mapping[str, object]) -> str | None:
    """A name as it is, or else the only one that differs in case and outer blanks."""
    if name in names:
        return name
    alike = [one for one in names if one.strip().lower() == name.strip().lower()]
    return alike[0] if len(alike) == 1 else None
