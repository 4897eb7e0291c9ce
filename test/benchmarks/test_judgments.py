"""The list of judgments, and diagnoses with other ones."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from benchmarks.judgments import FURTHEST, JUDGMENTS, ROWS, judgments_table, varied_table

PAGE = Path(__file__).parents[2] / "docs" / "diagnosis.md"


def test_the_page_states_every_judgment_as_the_code_has_it() -> None:
    assert str(judgments_table()) in PAGE.read_text(encoding="utf-8")


def test_a_share_is_at_most_one() -> None:
    shares = [one for one in JUDGMENTS if one.share]
    assert shares
    for one in JUDGMENTS:
        assert one.varied(1.0 / FURTHEST) == pytest.approx(one.value / FURTHEST)
        assert one.varied(1e6) == (1.0 if one.share else pytest.approx(1e6 * one.value))


def test_every_module_gets_the_drawn_judgment() -> None:
    code = """
from importlib import import_module
from benchmarks.judgments import JUDGMENTS, ROOM, vary
before = [one.value for one in JUDGMENTS]
vary(1)
after = [one.value for one in JUDGMENTS]
assert all(a != b and 0.66 < b / a < 1.51 for a, b in zip(before, after, strict=True))
left_over, verdict, by_chance, scatter = (import_module(f"{ROOM}.{name}") for name in (
    "locate.left_over", "answer.verdict", "locate.by_chance", "fit.width_error"))
assert left_over.NAMING_SHARE == verdict.NAMING_SHARE
assert by_chance.RUN_SCATTER == scatter.RUN_SCATTER
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True,
                          check=False, cwd=PAGE.parents[1])
    assert done.returncode == 0, done.stderr


def test_the_table_counts_the_answers_that_stay_the_same(
        capsys: pytest.CaptureFixture[str]) -> None:
    def figures(*answers: tuple[str, list[str]]) -> dict[str, object]:
        each = [{"case": f"w1-{k}", "verdict": verdict, "named": named}
                for k, (verdict, named) in enumerate(answers)]
        return {"each": each, "rows": [{"row": row, "hits": len(answers), "trials": 9}
                                       for row in ROWS]}

    whole = figures(("consistent", []), ("missing_physics", ["crosswind"]))
    varied = figures(("consistent", []), ("unknown", []), ("consistent", []))
    varied_table({"w1": (whole, varied)})
    row = capsys.readouterr().out.splitlines()[-1]
    assert row.startswith("| W1 | 1 of 2 | 2 of 9 → 3 of 9 |")
