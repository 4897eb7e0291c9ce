"""What docs/riddle.md says of the diagnosis of the test of 2013 is what the diagnosis says."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from truck_blowout_sim.diagnosis import USUAL, diagnose
from truck_blowout_sim.recordings import read_recording

ROOT = Path(__file__).resolve().parents[2]
RECORD = ROOT / "config" / "recordings" / "test_2013_steer_blowout.csv"
YAW = "tractor_yaw_rate_radps"


@pytest.mark.parametrize(("vehicle", "begin"), [
    ("international_9400i_trailmobile", "| default (this command) "),
    ("international_9400i_trailmobile_thesis", "| thesis mode (`--vehicle"),
])
def test_the_page_says_what_the_diagnosis_says(vehicle: str, begin: str) -> None:
    found, _ = diagnose([read_recording(RECORD)], vehicle=vehicle, settings="rebuilt_record",
                        impose_speed=True, effort=replace(USUAL, next_run=False))
    page = (ROOT / "docs" / "riddle.md").read_text(encoding="utf-8").splitlines()
    _, _, verdict, share, errors = next(
        line for line in page if line.startswith(begin)).split("|")[:5]
    before, after = (float(cell.split()[-1]) for cell in errors.split(","))
    assert verdict.strip() == found.verdict
    assert not found.effects
    assert found.null_p_value is not None
    assert float(share.strip(" %")) == pytest.approx(100.0 * found.null_p_value, rel=0.05)
    left = found.train.before[YAW], found.train.after[YAW]
    assert (before, after) == pytest.approx(left, rel=0.02)
