"""Severities of the later draws: sigma_b of every effect uniform from 2 to 30.

What severity makes an effect so visible is found on fault-free trucks (`settle.py`), once, before
the cases are made. It is kept beside the seals, so that cases can be made again without those.

Known limits: an effect that is not so visible at its physical end has the severity of that end.
Validated with: test/proving_ground/test_severities.py.
"""

from __future__ import annotations

import json
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from proving_ground.cases import CaseSpec
from proving_ground.kept_back import later
from proving_ground.worlds.draws import wanted_sigma_b

FOLDER = Path(__file__).resolve().parents[1] / "sealed"
Found = dict[str, list[float]]       # of each effect: `severity`, `sigma_b`, `individual`


def path_of(world: str) -> Path:
    """Where the severities of a world are kept."""
    return FOLDER / f"severities_{world}.json"


def wanted(spec: CaseSpec) -> CaseSpec:
    """The case with a sigma_b drawn for each of its effects, where its draw is a later one."""
    if not later(spec.seed) or not spec.effects:
        return spec
    rng = np.random.default_rng([spec.seed, 163])
    return replace(spec, effects=tuple(replace(e, sigma=None, sigma_b=wanted_sigma_b(rng))
                                       for e in spec.effects))


def settled(spec: CaseSpec) -> CaseSpec:
    """The case with the severities that were found for it.

    Raises:
        ValueError: they were not found yet.
    """
    spec = wanted(spec)
    if not any(effect.sigma_b for effect in spec.effects):
        return spec
    world = spec.id.partition("-")[0]
    found = known(world).get(spec.id)
    if found is None:
        raise ValueError(f"case {spec.id}: no severity in {path_of(world)}; expected what "
                         f"`python -m proving_ground severities {world}` writes")
    return replace(spec, effects=tuple(replace(e, severity=severity) for e, severity in zip(
        spec.effects, found["severity"], strict=True)))


@cache
def known(world: str) -> dict[str, Found]:
    """What was found, by case."""
    path = path_of(world)
    found: dict[str, Any] = json.loads(path.read_text()) if path.is_file() else {}
    return found
