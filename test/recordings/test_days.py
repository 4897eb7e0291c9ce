"""Time as a spreadsheet keeps it: days since 1899-12-30, or a share of a day."""

from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import pytest

from truck_blowout_sim.recordings import Recording, read_recording
from truck_blowout_sim.recordings.mapping.clocks import CLOCK_START

FINE = np.arange(300) * 0.1
DATE = (datetime(2013, 5, 14, 10, 30, tzinfo=UTC) - datetime(1899, 12, 30, tzinfo=UTC)).days


def read(folder: Path, days: np.ndarray, time: str = "") -> Recording:
    log, rules = folder / "sheet.csv", folder / "map.yaml"
    log.write_text("Time,Speed\n" + "".join(f"{day:.10f},80\n" for day in days))
    rules.write_text(f"{time}\nchannels: {{tractor_vx_mps: {{from: Speed, unit: km/h}}}}\n")
    return read_recording(log, mapping=rules)


@pytest.mark.parametrize(("first", "starts"), [
    (DATE + 0.4375, datetime(2013, 5, 14, 10, 30, tzinfo=UTC).timestamp()),
    (0.4375, 37_800.0),
])
@pytest.mark.parametrize("time", ["", "time: {from: Time, unit: day}"])
def test_days_become_seconds(tmp_path: Path, first: float, starts: float, time: str) -> None:
    found = read(tmp_path, first + FINE / 86_400.0, time)
    assert found["tractor_vx_mps"].time_s == pytest.approx(FINE, abs=1e-4)
    assert float(found.metadata[CLOCK_START]) == pytest.approx(starts, abs=1e-4)


def test_what_was_taken_for_days_is_told(tmp_path: Path) -> None:
    notes = "\n".join(read(tmp_path, DATE + FINE / 86_400.0).notes)
    assert "time column 'Time' is taken to be in day, by its numbers" in notes


def test_elapsed_days_begin_at_zero(tmp_path: Path) -> None:
    found = read(tmp_path, FINE / 86_400.0)
    assert found["tractor_vx_mps"].time_s == pytest.approx(FINE, abs=1e-4)
