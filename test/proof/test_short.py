from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from truck_blowout_sim.proof.cases import find_cases
from truck_blowout_sim.proof.prove import score_run
from truck_blowout_sim.proof.short import short_table

Maker = Callable[..., dict[str, Any]]


@pytest.fixture
def figures(tmp_path: Path, write_case: Callable[..., Path], line: Maker, effect: Maker,
            cause: Maker, manifest: Callable[[Path], Path]) -> dict[str, Any]:
    """A null, a single effect, and one that broke down."""
    write_case(tmp_path, "n")
    write_case(tmp_path, "s", "single", (cause(),))
    write_case(tmp_path, "x", "single", (cause(),))
    errors = {"no_change": 9.0, "recalibrated": 5.0, "gaussian_process": 4.0,
              "sparse_regression": 1.0, "diagnosed": 2.0}
    lines = {"n": line("n", "consistent"),
             "s": line("s", effects=(effect(),)) | {"baselines": errors},
             "x": line("x") | {"answer": None, "error": "broke"}}
    return score_run(find_cases(tmp_path), lines, tmp_path / "out", manifest(tmp_path))


def test_the_short_table_says_what_was_sought_and_reached(
    figures: dict[str, Any], tmp_path: Path
) -> None:
    table = short_table(figures)
    assert "3 cases (`dev`), 3 under a seal that holds; 1 broke down" in table
    assert "| the same, named first | ≥ 80 % | 100 % (1/1; 21–100) |" in table
    assert "by: everything recalibrated |  | 100 % (1/1; 21–100) |" in table
    assert "sparse regression on residual accelerations |  | 0 % (0/1; 0–79) |" in table
    assert (tmp_path / "out" / "summary.md").read_text() == table + "\n"
