"""Rivals of cases that are diagnosed already."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from benchmarks import rivals
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.proof.cases import find_cases
from truck_blowout_sim.proof.run import RESULTS, read_lines
from truck_blowout_sim.proof.seal import folder_hash

ERRORS = {"no_change": 90.0, "diagnosed": 3.0}


def a_case(root: Path, run: Path, name: str, group: str, **other: object) -> None:
    """A case, and its line among the results."""
    folder = root / "cases" / name
    folder.mkdir(parents=True)
    for role in ("train", "baseline", "holdout"):
        (folder / f"{role}_1.csv").write_text(f"time_s\n{name}\n", encoding="utf-8")
    (folder / "library.json").write_text('{"vehicle": "bmw_320i"}', encoding="utf-8")
    (root / "answers").mkdir(exist_ok=True)
    answer = {"group": group, "verdict": "missing_physics", "effects": []}
    (root / "answers" / f"{name}.json").write_text(json.dumps(answer), encoding="utf-8")
    line = {"case": name, "recordings_sha256": folder_hash(folder), "baselines": None,
            "step_s": 0.0025, "with_baselines": False, "error": None,
            "answer": {"fit": {"holdout": {"after": {"tractor_vx_mps": 2.0}}}}, **other}
    run.mkdir(exist_ok=True)
    with (run / RESULTS).open("a", encoding="utf-8") as file:
        file.write(json.dumps(line) + "\n")


def test_only_answered_cases_with_physics_missing_are_compared(tmp_path: Path) -> None:
    run = tmp_path / "run"
    a_case(tmp_path, run, "w1-1", "single")
    a_case(tmp_path, run, "w1-2", "null")
    a_case(tmp_path, run, "w1-3", "sensor")
    a_case(tmp_path, run, "w1-4", "unknown")
    a_case(tmp_path, run, "w1-5", "pair", answer=None)
    a_case(tmp_path, run, "w1-6", "pair", baselines=ERRORS)
    a_case(tmp_path, run, "w1-7", "pair", recordings_sha256="of others")
    chosen = rivals.uncompared(find_cases(tmp_path), read_lines(run / RESULTS))
    assert [case.id for case in chosen] == ["w1-1", "w1-4"]
    assert [case.id for case in rivals.some(find_cases(tmp_path), 0)] == [
        "w1-1", "w1-4", "w1-5", "w1-6", "w1-7"]
    assert [case.id for case in rivals.some(find_cases(tmp_path), 2)] == ["w1-4", "w1-6"]


def test_the_line_keeps_its_answer_and_gets_the_errors(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """They are found for the vehicle, the step and the errors of the diagnosis."""
    asked: list[object] = []

    def errors(*words: object) -> dict[str, float]:
        asked.extend(words)
        return ERRORS

    monkeypatch.setattr(rivals, "read_recording", lambda path: path.stem)
    monkeypatch.setattr(rivals, "baseline_errors", errors)
    a_case(tmp_path, tmp_path / "run", "w3-1", "single")
    line = read_lines(tmp_path / "run" / RESULTS)["w3-1"]
    after = rivals.with_rivals((find_cases(tmp_path)[0], line))
    assert after == {**line, "baselines": ERRORS, "with_baselines": True}
    assert asked == [["train_1"], ["baseline_1"], ["holdout_1"], "bmw_320i", 0.0025,
                     {"tractor_vx_mps": 2.0}]


def test_a_case_that_cannot_be_compared_is_told_and_leaves_its_line(tmp_path: Path) -> None:
    run = tmp_path / "run"
    a_case(tmp_path, run, "w3-1", "single")
    before = (run / RESULTS).read_bytes()
    done = CliRunner().invoke(rivals.app, [str(tmp_path), str(run), "1"], catch_exceptions=False)
    assert done.stdout.startswith("w3-1 InputError: ")
    assert (run / RESULTS).read_bytes() == before
    with pytest.raises(InputError):
        CliRunner().invoke(rivals.app, [str(tmp_path), str(tmp_path)], catch_exceptions=False)
