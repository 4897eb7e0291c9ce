#!/usr/bin/env python3
"""sum_up_comparison.py FOLDER: what a comparison found, in a handful of lines.

FOLDER is the output of `truck-blowout compare`. The channels are ordered by their ISO/TS 18571
rating; those without one (held still, or too short) are counted only.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

_WORST, _BEST = 3, 2


def lines(compared: Mapping[str, Any]) -> list[str]:
    """The mean rating, the worst channels and the best, of the data in comparison.json."""
    channels = compared["channels"]
    rated = sorted((c for c in channels.values() if c["iso_18571"] and not c["imposed"]),
                   key=lambda c: float(c["iso_18571"]["overall"]))
    worst, rest = rated[:_WORST], rated[_WORST:]
    ratings = [float(c["iso_18571"]["overall"]) for c in rated]
    head = f"{len(channels)} channels compared, {len(rated)} rated by ISO/TS 18571"
    return [head + (f", mean {sum(ratings) / len(ratings):.3f} (1: equal)" if ratings else ""),
            *_table("worst", worst), *_table("best", rest[::-1][:_BEST])]


def _table(title: str, channels: list[Mapping[str, Any]]) -> list[str]:
    return [f"{title if first else '':5}  {c['iso_18571']['overall']:.3f}  {c['label']}, rms error "
            f"{c['display']['rms']:.3g} {c['display']['unit']}".rstrip()
            for first, c in zip([True] + [False] * len(channels), channels, strict=False)]


if __name__ == "__main__":
    folder = Path(sys.argv[1])
    found = json.loads((folder / "comparison.json").read_text(encoding="utf-8"))
    print(*lines(found), sep="\n")
