"""One real case from end to end: made by the independent truth, diagnosed, scored, resumed."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

CASE = """
id: short
group: single
seed: 4712
baseline: []
train: [braking_all]
holdout: [braking_trailer]
effects:
  - {name: brake_imbalance, place: 8, sign: -1.0, severity: 0.9}
"""
PROVE = [sys.executable, "-m", "truck_blowout_sim", "prove"]


@pytest.mark.timeout(900)
def test_a_case_from_truth_to_table(tmp_path: Path) -> None:
    pytest.importorskip("mujoco")
    (tmp_path / "short.yaml").write_text(CASE)
    made = tmp_path / "made"
    subprocess.run([sys.executable, "-m", "proving_ground", "generate", "-o", str(made), "--case",
                    str(tmp_path / "short.yaml"), "--cores", "1"], check=True)
    out = tmp_path / "out"
    words = [*PROVE, "--cases", str(made), "-o", str(out), "--workers", "1"]
    subprocess.run(words, check=True)
    figures = json.loads((out / "proof.json").read_text())
    assert figures["seals"]["holds"] == ["short"]
    assert figures["failed"] == {}
    assert figures["each"][0]["causes"][0]["aliased"]
    assert set(figures["each"][0]["baselines"]) >= {"no_change", "recalibrated",
                                                    "gaussian_process", "sparse_regression"}
    # A second run finds the line and only scores.
    before = (out / "results.jsonl").read_bytes()
    told = subprocess.run([*words, "--json"], check=True, capture_output=True, text=True)
    assert (out / "results.jsonl").read_bytes() == before
    assert json.loads(told.stdout)["seals"]["holds"] == ["short"]
    assert "brake_imbalance trailer_2_left" in (out / "cases.csv").read_text()


def test_a_wrong_set_is_one_line_and_status_2(tmp_path: Path) -> None:
    done = subprocess.run([*PROVE, "--set", "none", "-o", str(tmp_path)], capture_output=True,
                          text=True, check=False)
    assert done.returncode == 2
    assert done.stderr.count("\n") == 1
    assert "dev, test, ci" in done.stderr
