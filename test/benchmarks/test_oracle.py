"""Cases of which the true name is told."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from typer.testing import CliRunner

from benchmarks.oracle import ROW, app, oracle_table, others
from truck_blowout_sim.proof.cases import find_cases


def a_case(root: Path, name: str, kind: str, effect: str) -> None:
    folder = root / "cases" / name
    folder.mkdir(parents=True)
    (folder / "train_1.csv").write_text("time_s\n", encoding="utf-8")
    (folder / "library.json").write_text('{"vehicle": "bmw_320i"}', encoding="utf-8")
    (root / "answers").mkdir(exist_ok=True)
    answer = {"group": "single", "verdict": "missing_physics",
              "effects": [{"name": effect, "kind": kind, "where": {}, "strength": None}]}
    (root / "answers" / f"{name}.json").write_text(json.dumps(answer), encoding="utf-8")


def test_all_names_but_the_true_one_are_excluded(tmp_path: Path) -> None:
    a_case(tmp_path / "all", "w3-1", "physics", "crosswind")
    a_case(tmp_path / "all", "w3-2", "sensor", "yaw_rate_gain")
    a_case(tmp_path / "all", "w3-3", "physics", "roll_steer")
    (tmp_path / "all" / "sigma_b.json").write_text(
        '{"w3-3": {"sigma_b": [90.0], "individual": [2.0]}}', encoding="utf-8")
    done = CliRunner().invoke(app, ["make", str(tmp_path / "all"), str(tmp_path / "told")],
                              catch_exceptions=False)
    (case,) = find_cases(tmp_path / "told")
    assert done.stdout == "1 cases\n"
    assert (case.id, case.vehicle()) == ("w3-1", "bmw_320i")
    assert case.without() == tuple(others({"crosswind"}))
    assert "roll_steer" in case.without()


def test_both_counts_stand_side_by_side() -> None:
    def figures(hits: int, *after: float) -> dict[str, Any]:
        """The last case has an effect that does not stand out."""
        each = [{"case": f"{k}", "holdout": {"before": 500.0, "after": error}}
                for k, error in enumerate(after)]
        causes = [{"case": one["case"], "kind": "physics"} for one in each[:-1]]
        return {"rows": [{"row": ROW, "hits": hits, "trials": 24}], "each": each, "causes": causes}

    table = oracle_table({"w3": (figures(16, 9.0, 5.0, 4.0, 1e6), figures(19, 3.0, 2.0, 1e6))})
    assert table.lines[-1] == "| W3 | 16 of 24 | 19 of 24 | 7 | 2.5 | 500 |"
    assert oracle_table({"w3": (figures(0), figures(0))}).lines[-1].endswith("| – | – | – |")
