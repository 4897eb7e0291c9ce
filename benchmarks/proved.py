"""Figures of a folder that `truck-blowout prove -o` wrote.

Validated with: test/benchmarks/test_ablation.py, test/benchmarks/test_oracle.py.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

from truck_blowout_sim.errors import InputError


def figures_of(folder: Path) -> dict[str, Any]:
    """What ``proof.json`` holds.

    Raises:
        InputError: no such file.
    """
    path = folder / "proof.json"
    if not path.is_file():
        raise InputError("no such file", file=path, expected="what `truck-blowout prove -o` wrote")
    return dict(json.loads(path.read_text(encoding="utf-8")))


def two_a_world(words: Iterable[str], expected: str) -> Iterator[tuple[str, Path, Path]]:
    """World and two paths of each word like ``w1=ONE,OTHER``.

    Raises:
        InputError: a word is not like that; ``expected``: what stands behind ``WORLD=``.
    """
    for word in words:
        world, _, paths = word.partition("=")
        one, comma, other = paths.partition(",")
        if not comma:
            raise InputError(f"{word!r}", expected=f"WORLD={expected}")
        yield world, Path(one), Path(other)


def of(row: Mapping[str, Any]) -> str:
    """Hits and trials of a row."""
    return f"{row['hits']} of {row['trials']}"
