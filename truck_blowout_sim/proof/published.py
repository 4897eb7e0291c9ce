"""Whether a run gives the answers that were published.

Validated with: test/proof/test_published.py.
"""

from __future__ import annotations

import csv
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from truck_blowout_sim.errors import InputError

_ANSWER = ("verdict", "named")


@dataclass(frozen=True)
class Repeat:
    """One case that was diagnosed again.

    Attributes:
        case: its name; ``concealed``: what is missing in it.
        published, now: verdict and names, each as one text.
        later: what a correction made of the published answer, if it is known; ``why`` it did.
    """

    case: str
    concealed: str
    published: str
    now: str
    later: str | None = None
    why: str = ""

    @property
    def same(self) -> bool:
        """Whether verdict and names are those that were published."""
        return self.published == self.now

    @property
    def corrected(self) -> bool:
        """Whether they are what a published correction has made of them."""
        return not self.same and self.now == self.later


def repeats(run: Path, published: Path, changed: Path | None = None) -> list[Repeat]:
    """Each case of a run's ``cases.csv`` beside the published one, in the order of the run.

    ``changed``: table of published answers that later corrections changed, with the reason.

    Raises:
        InputError: a file is missing or no such table; a case was never published.
    """
    before, later = _rows(published), _rows(changed) if changed else {}
    found = []
    for case, row in _rows(run).items():
        if case not in before:
            raise InputError(f"no case {case}", file=published, expected="a published case")
        after = later.get(case)
        found.append(Repeat(case, row["concealed"], _answer(before[case]), _answer(row),
                            _answer(after) if after else None, after["why"] if after else ""))
    return found


def cases_in(path: Path) -> list[str]:
    """Names of the cases of a ``cases.csv``, in its order.

    Raises:
        InputError: the file is missing or no such table.
    """
    return list(_rows(path))


def _answer(row: Mapping[str, str]) -> str:
    return ": ".join(row[key] for key in _ANSWER if row[key])


def _rows(path: Path) -> dict[str, dict[str, str]]:
    try:
        with path.open(encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise InputError(f"cannot be read: {error}", file=path, expected="cases.csv") from error
    if any(None in row.values() or not {"case", "concealed", *_ANSWER} <= row.keys()
           for row in rows):
        raise InputError("no table of cases", file=path, expected="cases.csv of `prove`")
    return {row["case"]: row for row in rows}
