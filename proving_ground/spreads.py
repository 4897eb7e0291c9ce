"""What single fault-free vehicles, roads and days differ by, beside what an effect makes of one.

An effect is told from a sound vehicle of the kind by no less than what these differ by in its own
number. The scoring joins this with sigma_b (`truck_blowout_sim/proof/cases.py`, `beyond_spread`).

Validated with: test/proving_ground/test_spreads.py.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

import yaml

FILE = Path(__file__).parent / "spreads.yaml"


@cache
def _spreads() -> Mapping[str, Mapping[str, Any]]:
    return dict(yaml.safe_load(FILE.read_text(encoding="utf-8")))


def individual(strength: Mapping[str, Any], car: bool = False) -> float:
    """Strength of an effect in standard deviations of what fault-free vehicles differ by in it.

    Infinite for what no sound vehicle has.
    """
    known = _spreads().get(strength["name"])
    if known is None:
        return math.inf
    value, sound = float(strength["value"]), float(known["sound"])
    away = math.log(max(value, 1e-6) / sound) if known.get("of") == "ratio" else value - sound
    return abs(away) / float(known["car"] if car and "car" in known else known["spread"])

