"""The plane model gives the table that docs/riddle.md shows."""

from __future__ import annotations

import runpy
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
MODEL = runpy.run_path(str(ROOT / "scripts" / "plane_model.py"))


@pytest.mark.parametrize(("words", "kept"), [("all", 1.0), ("40 %", 0.4), ("25 %", 0.25),
                                             ("10 %", 0.1)])  # fmt: skip
def test_the_page_shows_what_the_model_gives(words: str, kept: float) -> None:
    drag, steer = MODEL["ratios"](kept)
    row = f"| {words} | {drag:.3f} | {steer:.3f} |"
    assert row in (ROOT / "docs" / "riddle.md").read_text(encoding="utf-8").splitlines()
