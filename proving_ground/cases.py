"""What a case is, and the seeded tables of cases; one YAML file describes one case.

A case is one truck individual with two baseline runs (nothing missing), two or three training
runs and two holdout runs in which its effects are at work.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import Any

import yaml

from proving_ground.effects import FAMILIES, LISTED, UNLISTED
from proving_ground.effects.base import Active, EffectKind, Place
from proving_ground.faults import FAULTS
from proving_ground.manoeuvres import MANOEUVRES

GROUPS = ("null", "single", "pair", "sensor", "unknown")


@dataclass(frozen=True)
class EffectSpec:
    """One effect of a case. `sigma` is the wanted detectability; None takes `severity` as it is.

    `law` chooses among the laws that the effect follows. `sigma_b` is what its severity was found
    for (`worlds/severities.py`), if it was.
    """

    name: str
    place: int = 0
    sign: float = 1.0
    sigma: float | None = None
    severity: float = 0.3
    law: int = 0
    sigma_b: float | None = None

    @property
    def kind(self) -> EffectKind:
        """The family, listed or not."""
        found = LISTED.get(self.name) or UNLISTED.get(self.name)
        if found is None:
            raise ValueError(f"effect {self.name!r} is not known to the proving ground")
        return found

    @property
    def where(self) -> Place:
        """Where it sits."""
        return self.kind.places[self.place % len(self.kind.places)]

    def at(self, severity: float, when: float) -> Active:
        """The effect at work, at a severity, from an instant or place on."""
        return self.kind.by_law(self.law)(severity, self.where, self.sign, when)


@dataclass(frozen=True)
class FaultSpec:
    """One instrument fault of a case; fields as for an effect."""

    name: str
    place: int = 0
    sign: float = 1.0
    sigma: float | None = None
    severity: float = 0.3


@dataclass(frozen=True)
class CaseSpec:
    """All that defines a case; everything else follows from `seed`.

    `without` names what the diagnosis must do without: effects taken out of its library. `truth`
    is the world whose truck is driven, `rough` whether it is recorded as roughly as real logs are.
    `more` baseline and training runs of the same kinds are driven besides, and `alike` baseline
    runs of the kinds of training; severities stay those that the case has without them.
    """

    id: str
    group: str
    seed: int
    baseline: tuple[str, ...]
    train: tuple[str, ...]
    holdout: tuple[str, ...]
    effects: tuple[EffectSpec, ...] = ()
    faults: tuple[FaultSpec, ...] = ()
    missing: tuple[str, ...] = ()
    dropouts: bool = False
    without: tuple[str, ...] = ()
    truth: str = "w1"
    rough: bool = False
    more: int = 0
    alike: int = 0

    def runs(self) -> list[tuple[str, str, int]]:
        """(name, manoeuvre kind, seed) of every run."""
        rows: list[tuple[str, str, int]] = []
        for role, kinds in (("baseline", self.baseline), ("train", self.train),
                            ("holdout", self.holdout)):
            for number, kind in enumerate(kinds, start=1):
                rows.append((f"{role}_{number}", kind, self.seed * 100 + len(rows) + 1))
        for role, kinds in (("baseline", self.baseline), ("train", self.train)):
            for number in range(len(kinds), len(kinds) + self.more if kinds else 0):
                rows.append((f"{role}_{number + 1}", kinds[number % len(kinds)],
                             self.seed * 100 + len(rows) + 1))
        first = len(self.baseline) + (self.more if self.baseline else 0)
        for number in range(self.alike):
            rows.append((f"baseline_{first + number + 1}", self.train[number % len(self.train)],
                         self.seed * 100 + len(rows) + 1))
        return rows


def read_case(path: Path) -> CaseSpec:
    """A case from its YAML file; raises ValueError with file, field and what was wanted."""
    raw = yaml.safe_load(path.read_text(encoding="utf-8"))
    if not isinstance(raw, dict):
        raise ValueError(f"{path}: a case is a mapping of fields")
    known = {field.name for field in fields(CaseSpec)}
    for key in raw:
        if key not in known:
            raise ValueError(f"{path}: {key}: unknown field, expected one of {sorted(known)}")
    try:
        return check(_from_mapping(raw))
    except (TypeError, ValueError) as error:
        raise ValueError(f"{path}: {error}") from error


def _from_mapping(raw: dict[str, Any]) -> CaseSpec:
    values = dict(raw)
    values["effects"] = tuple(EffectSpec(**item) for item in raw.get("effects", ()))
    values["faults"] = tuple(FaultSpec(**item) for item in raw.get("faults", ()))
    for key in ("baseline", "train", "holdout", "missing", "without"):
        values[key] = tuple(raw.get(key, ()))
    return CaseSpec(**values)


def write_case(path: Path, spec: CaseSpec) -> None:
    """Write a case as YAML."""
    raw = asdict(spec)
    for key, value in raw.items():
        if isinstance(value, tuple):
            raw[key] = list(value)
    path.write_text(yaml.safe_dump(raw, sort_keys=False), encoding="utf-8")


def check(spec: CaseSpec) -> CaseSpec:
    """The case itself if every name in it exists; raises ValueError otherwise."""
    if spec.group not in GROUPS:
        raise ValueError(f"group: {spec.group!r}, expected one of {GROUPS}")
    _names("train", spec.train + spec.baseline + spec.holdout, MANOEUVRES)
    _names("faults", [fault.name for fault in spec.faults], FAULTS)
    _names("effects", [effect.name for effect in spec.effects], {**LISTED, **UNLISTED})
    _names("without", spec.without, dict.fromkeys(n for names in FAMILIES.values() for n in names))
    if not spec.train or not spec.holdout:
        raise ValueError("train and holdout: at least one manoeuvre each")
    return spec


def _names(field: str, names: Sequence[str], known: dict[str, Any]) -> None:
    for name in names:
        if name not in known:
            raise ValueError(f"{field}: {name!r}, expected one of {sorted(known)}")
