"""The severity at which an effect of a case is as visible as was drawn for it.

What fault-free vehicles differ by in the effect's own number counts with all else that they differ
by, as for the figures of the proof: a slope that the next road may have as well is not seen.

Known limits: one run stands for its class of maneuvers, as in `sigma_b.py`; a sigma_b reached to 15
percent is near enough.
Validated with: test/proving_ground/test_severities.py.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from dataclasses import asdict, replace
from pathlib import Path

from proving_ground.calibrate import from_guess, search
from proving_ground.cases import CaseSpec, EffectSpec
from proving_ground.ensemble import Nulls
from proving_ground.spreads import individual
from proving_ground.visibility import MOST, Seen, world_of
from proving_ground.worlds.severities import Found, known, path_of, wanted
from proving_ground.worlds.table import open_cases

LEAST = 1e-9  # a visibility of nothing


def settle(name: str, first: int, count: int, folder: Path, trucks: int
           ) -> Iterator[tuple[str, Found]]:
    """Find what is not found yet of a world's cases; yields each case, and keeps them all.

    Raises:
        ValueError: no world of that name.
    """
    found, worlds = dict(known(name)), dict[str, Nulls]()
    for spec in map(wanted, open_cases(name, first, count)):
        if spec.id in found or not any(effect.sigma_b for effect in spec.effects):
            continue
        nulls = worlds.setdefault(world_of(spec), Nulls(world_of(spec), folder, trucks))
        found[spec.id] = severities(spec, nulls)
        text = json.dumps(found, sort_keys=True, indent=1) + "\n"
        path_of(name).write_text(text, encoding="utf-8")
        yield spec.id, found[spec.id]


def severities(spec: CaseSpec, nulls: Nulls) -> Found:
    """Severity, sigma_b and spreads of fault-free vehicles of each effect, each on its own."""
    seen, found = Seen(spec, nulls), []
    for effect in spec.effects:
        tried: dict[float, tuple[float, float]] = {}

        def power(severity: float, effect: EffectSpec = effect,
                  tried: dict[float, tuple[float, float]] = tried) -> tuple[float, str]:
            strength = asdict(effect.at(severity, 0.0).strength)
            both = seen.sigma_b(effect, severity), individual(strength, spec.truth == "w3")
            tried[severity] = both
            return math.hypot(1.0 / max(both[0], LEAST), 1.0 / max(both[1], LEAST)) ** -1.0, ""

        best = search(from_guess(replace(effect, sigma=effect.sigma_b)), power, effect.kind.lowest)
        found.append([best.severity, *tried[best.severity]])
    return {name: [float(f"{min(one[k], MOST):.3g}") for one in found]
            for k, name in enumerate(("severity", "sigma_b", "individual"))}
