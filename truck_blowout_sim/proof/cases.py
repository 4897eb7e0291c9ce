"""Cases on disk: recordings in a folder, the sealed answer beside them.

Two layouts are read: `cases/<id>/*.csv` with `answers/<id>.json` (a generated set), and
`<id>/*.csv` with `<id>/answers.json` (single cases put together by hand).

Validated with: test/proof/test_cases.py.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from truck_blowout_sim.errors import InputError

LIBRARY = "library.json"  # beside the recordings: the model's vehicle, what it must do without
VEHICLE = "international_9400i_trailmobile"
SIGMA_B = "sigma_b.json"   # beside cases/ and answers/
MEASURED = ("sigma_b", "individual", "apart")
ROLES = ("train", "baseline", "holdout")
NOTHING_MISSING = ("consistent", "miscalibrated")


@dataclass(frozen=True)
class Case:
    """Where a case lies."""

    id: str
    folder: Path
    answer: Path

    def recordings(self, role: str) -> list[Path]:
        """Recordings of one role, in order of name."""
        return sorted(self.folder.glob(f"{role}*.csv"))

    def without(self) -> tuple[str, ...]:
        """Names of effects that the diagnosis must do without in this case.

        Raises:
            InputError: the file that says so is not what it should be.
        """
        return tuple(map(str, self._library().get("without", ())))

    def vehicle(self) -> str:
        """Vehicle file of the model: the shipped truck, where the case names no other.

        Raises:
            InputError: the file that says so is not what it should be.
        """
        return str(self._library().get("vehicle", VEHICLE))

    def _library(self) -> dict[str, Any]:
        """What lies beside the recordings for the diagnosis; empty where nothing does."""
        path = self.folder / LIBRARY
        if not path.is_file():
            return {}
        try:
            tree = json.loads(path.read_text(encoding="utf-8"))
            return {**tree, "without": [*tree.get("without", ())]}
        except (AttributeError, TypeError, json.JSONDecodeError) as error:
            raise InputError(f"not a list of effects: {error!r}", file=path,
                             expected='{"without": ["crosswind"]}') from error


@dataclass(frozen=True)
class Cause:
    """One concealed effect, as its answer gives it.

    Attributes:
        name, kind: what; kind is ``physics``, ``sensor``, ``unlisted``, or ``taken_out`` where its
            family was taken out of the library.
        where: body, axle, hub, tire; None where it does not apply.
        sigma: how visible it is in the training runs; None if not calibrated.
        sigma_b: how visible to an ideal detector of its world; None if not measured.
        individual: its strength in standard deviations of what fault-free vehicles differ by in it.
        apart: sigma_b of what the nearest listed effect, or the other of a pair, leaves of it.
        onset_s: instant in each run, empty for what is always there.
        strength: (name, value, unit).
    """

    name: str
    kind: str
    where: Mapping[str, str | None]
    sigma: float | None
    onset_s: Mapping[str, float]
    strength: tuple[str, float, str]
    sigma_b: float | None = None
    individual: float | None = None
    apart: float | None = None

    @property
    def beyond_spread(self) -> float | None:
        """sigma_b, the individual spread of the effect's own number included.

        Where only that spread is known, the most that it can be.
        """
        if self.individual is None or self.sigma_b is None:
            return self.individual
        return self.sigma_b / math.sqrt(1.0 + (self.sigma_b / max(self.individual, 1e-9))**2)

    @property
    def visibility(self) -> float | None:
        """sigma_b with the spread of fault-free vehicles where that is known, else without."""
        return self.sigma_b if self.individual is None else self.beyond_spread

    @property
    def measured(self) -> bool:
        """Whether how visible it is can be told: for older sets nothing is known, and it counts."""
        return self.sigma_b is not None or self.individual is None


@dataclass(frozen=True)
class Truth:
    """What was concealed in a case; ``verdicts`` are those that count as right."""

    group: str
    verdicts: tuple[str, ...]
    causes: tuple[Cause, ...]
    missing: tuple[str, ...]


def find_cases(root: Path, limit: int = 0) -> list[Case]:
    """Cases below a folder, in order of name; ``limit`` takes that many, evenly spread.

    Raises:
        InputError: no case is there, or one has no training recording or no answer.
    """
    if (root / "cases").is_dir():
        # A case whose answer is not there yet is still being made.
        found = [Case(folder.name, folder, root / "answers" / f"{folder.name}.json")
                 for folder in sorted((root / "cases").iterdir()) if folder.is_dir()]
        found = [case for case in found if case.answer.is_file()]
    else:
        found = [Case(path.parent.name, path.parent, path)
                 for path in sorted(root.glob("*/answers.json"))]
    if not found:
        raise InputError("no case", file=root,
                         expected="cases/<id>/*.csv with answers/<id>.json, or <id>/answers.json")
    for case in found:
        if not case.recordings("train"):
            raise InputError("no training recording", file=case.folder, expected="train_1.csv")
    return spread(found, limit)


def spread(cases: Sequence[Case], limit: int) -> list[Case]:
    """``limit`` of the cases at even distances: sets are ordered by group, so all have a share."""
    if limit <= 0 or limit >= len(cases):
        return list(cases)
    return [cases[int((k + 0.5) * len(cases) / limit)] for k in range(limit)]


def read_truth(path: Path) -> Truth:
    """The sealed answer of a case.

    Raises:
        InputError: the file is not an answer; says which key is missing.
    """
    return truth_of(path.read_text(encoding="utf-8"), visibility_of(path), path)


def truth_of(text: str, visibility: Mapping[str, Sequence[float]], file: Path) -> Truth:
    """What the text of an answer says; ``visibility``: see :func:`visibility_of`.

    Raises:
        InputError: it is no answer; ``file`` is named as its origin.
    """
    try:
        tree = json.loads(text)
        group = str(tree["group"])
        verdicts = tree["verdicts"] if "verdicts" in tree else [tree["verdict"]]
        right = NOTHING_MISSING if group == "null" else tuple(map(str, verdicts))
        seen = [list(map(float, visibility.get(key, ()))) for key in MEASURED]
        causes = tuple(_cause(entry, *(one[k] if k < len(one) else None for one in seen))
                       for k, entry in enumerate(tree["effects"]))
        return Truth(group, right, causes, tuple(tree.get("missing_channels", ())))
    except (KeyError, TypeError, json.JSONDecodeError) as error:
        raise InputError(f"not an answer: {error!r}", file=file,
                         expected="group, verdicts, effects") from error


def visibility_of(answer: Path) -> dict[str, list[float]]:
    """`sigma_b`, `individual` and `apart` of each effect of a case of a world, where measured."""
    path = answer.parents[1] / SIGMA_B
    if not path.is_file():
        return {}
    return dict(json.loads(path.read_text(encoding="utf-8")).get(answer.stem, {}))


def _cause(entry: Mapping[str, Any], sigma_b: float | None = None,
           individual: float | None = None, apart: float | None = None) -> Cause:
    strength = entry["strength"] or {"name": "", "value": 0.0, "unit": ""}
    sigma = entry.get("sigma")
    return Cause(str(entry["name"]), str(entry["kind"]), dict(entry["where"]),
                 None if sigma is None else float(sigma), dict(entry.get("onset_s") or {}),
                 (str(strength["name"]), float(strength["value"]), str(strength["unit"])),
                 sigma_b, individual, apart)
