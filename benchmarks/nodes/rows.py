"""A row of the printed table; the machine's load stands in it, because it changes every figure."""

from __future__ import annotations

import os

HEAD = "| figure | measured | sought | load average |\n|---|---|---|---|"


def row(name: str, value: float, unit: str, sought: str) -> None:
    """Print one row."""
    load = os.getloadavg()[0]
    print(f"| {name} | {value:.6g} {unit} | {sought} | {load:.1f} |", flush=True)
