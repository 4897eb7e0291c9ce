from __future__ import annotations

import hashlib
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

NOWHERE = {"body": None, "axle": None, "hub": None, "tire": None}
Maker = Callable[..., dict[str, Any]]


@pytest.fixture
def cause() -> Maker:
    """An answer's entry of one effect."""
    def make(name: str = "brake_lag", **changes: object) -> dict[str, Any]:
        entry = {"name": name, "kind": "physics", "where": NOWHERE, "sigma": 20.0, "onset_s": None,
                 "strength": {"name": "extra lag", "value": 0.4, "unit": "s"}}
        return entry | changes
    return make


@pytest.fixture
def effect() -> Maker:
    """A diagnosis's entry of one effect."""
    def make(name: str = "brake_lag", **changes: object) -> dict[str, Any]:
        entry = {"name": name, "kind": "physics", "where": NOWHERE, "onset_s": None,
                 "parameters": {"extra_lag_s": {"value": 0.44, "unit": "s", "ci90": [0.41, 0.47]}}}
        return entry | changes
    return make


@pytest.fixture
def line() -> Maker:
    """A line of results."""
    def make(case: str = "a", verdict: str = "missing_physics",
             effects: tuple[dict[str, Any], ...] = (),
             alias_sets: tuple[tuple[str, ...], ...] | None = None,
             holdout: tuple[float, float] = (3.0, 1.0), p_value: float = 0.01,
             **changes: object) -> dict[str, Any]:
        sets = [[e["name"]] for e in effects] if alias_sets is None else alias_sets
        answer = {"verdict": verdict, "effects": list(effects), "alias_sets": list(sets),
                  "fit": {"holdout": {"before": {"vx": holdout[0]}, "after": {"vx": holdout[1]}}},
                  "null_p_value": p_value}
        return {"case": case, "answer": answer, "baselines": None, "cpu_s": 2.0, "error": None,
                "recordings_sha256": "", **changes}
    return make


@pytest.fixture
def write_case() -> Callable[..., Path]:
    """Put a case of a generated set on disk; its recordings say nothing."""
    def write(root: Path, name: str, group: str = "null",
              effects: tuple[dict[str, Any], ...] = ()) -> Path:
        folder = root / "cases" / name
        folder.mkdir(parents=True)
        (folder / "train_1.csv").write_text(f"time_s\n{name}\n")
        right = {"null": "consistent", "sensor": "sensor_artefact", "unknown": "unknown"}
        answer = {"group": group, "verdicts": [right.get(group, "missing_physics")],
                  "effects": list(effects), "missing_channels": []}
        (root / "answers").mkdir(exist_ok=True)
        path = root / "answers" / f"{name}.json"
        path.write_text(json.dumps(answer))
        return path
    return write


@pytest.fixture
def manifest() -> Callable[[Path], Path]:
    """Seal what lies below a folder, spelled out here apart from the code under test."""
    def seal(root: Path) -> Path:
        cases = {}
        for answer in (root / "answers").iterdir():
            csv = root / "cases" / answer.stem / "train_1.csv"
            inner = hashlib.sha256(csv.read_bytes()).hexdigest()
            outer = hashlib.sha256(f"train_1.csv {inner}\n".encode()).hexdigest()
            cases[answer.stem] = {"recordings_sha256": outer, "answer_sha256":
                                  hashlib.sha256(answer.read_bytes()).hexdigest()}
        path = root / "manifest.json"
        path.write_text(json.dumps({"set": "dev", "cases": cases}))
        return path
    return seal


@pytest.fixture
def prove_ci(tmp_path: Path) -> Callable[..., dict[str, Any]]:
    """Make the cases of some groups of the `ci` set, seal, diagnose and score them as `prove`."""
    pytest.importorskip("mujoco")
    from proving_ground.generate import generate
    from proving_ground.seal import write_manifest
    from proving_ground.table import cases_of
    from truck_blowout_sim.proof.cases import find_cases
    from truck_blowout_sim.proof.prove import score_run
    from truck_blowout_sim.proof.run import run_cases

    def prove(*groups: str) -> dict[str, Any]:
        made = tmp_path / "made"
        # Every other one, for time; `make prove SET=ci` runs them all.
        chosen = [c for c in cases_of("ci") if c.group in groups][::2]
        assert all(not astray for _, astray in generate(chosen, made, 1))
        sealed, cases = write_manifest(made, "ci"), find_cases(made)
        lines = {line["case"]: line for line in run_cases(
            cases, tmp_path / "out", workers=1, step_s=0.0025, with_baselines=False)}
        figures = score_run(cases, lines, tmp_path / "out", sealed)
        # Not one case broke down, no answer moved, and no process that diagnosed could read one.
        assert (figures["cases"], figures["failed"]) == (len(chosen), {})
        assert len(figures["seals"]["holds"]) == len(chosen)
        assert all(line["blindfolded"] for line in lines.values())
        return figures
    return prove


@pytest.fixture
def solved() -> Callable[[dict[str, Any]], tuple[dict[str, int], list[str]]]:
    """Cases solved, by group and in all; and what was said of each case."""
    def count(figures: dict[str, Any]) -> tuple[dict[str, int], list[str]]:
        hits = {group: entry["hits"] for group, entry in figures["solved"].items()}
        return hits | {"all": sum(hits.values())}, [
            f"{s['case']} {s['group']}: {s['verdict']} {s['named']}" for s in figures["each"]]
    return count
