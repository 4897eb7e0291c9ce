"""Rows of a log whose clock is coarser than its rate."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from truck_blowout_sim.recordings import read_recording
from truck_blowout_sim.recordings.mapping.coarse_clock import spread

FINE = np.arange(237) * 0.1 + 7.35


@pytest.mark.parametrize("tick", [0.5, 1.0])
def test_a_clock_that_was_cut_off_is_found_again(tick: float) -> None:
    coarse = np.floor(FINE / tick + 1e-9) * tick
    found, note = spread(coarse)
    # where in its slot of a tick a row was, nobody knows
    assert np.abs(found - FINE).max() < 0.1
    assert np.diff(found) == pytest.approx(0.1)
    assert f"{round(tick / 0.1)} rows share each {tick:g} s" in note


@pytest.mark.parametrize("times", [
    FINE,                                       # each row has its own
    np.repeat(np.arange(100) * 0.02, 2),        # two rows share each, but finely
    np.floor(FINE)[::-1],                       # runs backwards
    np.zeros(50),                               # stands still
    np.where(np.arange(237) == 100, FINE[99], FINE),
    np.zeros(0),
])
def test_other_clocks_stay_as_they_are(times: np.ndarray) -> None:
    found, note = spread(times)
    assert note == ""
    assert found is times


@given(st.lists(st.integers(1, 30), min_size=3, max_size=40))
def test_instants_increase_and_stay_within_their_tick(counts: list[int]) -> None:
    coarse = np.repeat(np.arange(len(counts), dtype=np.float64), counts)
    found, note = spread(coarse)
    assert (np.diff(found) > 0.0).all() or note == ""
    assert (found >= coarse).all()
    assert (found < coarse + 1.0).all()


def test_a_log_in_whole_seconds_keeps_all_its_rows(tmp_path: Path) -> None:
    path = tmp_path / "whole_seconds.csv"
    rows = [f"12:34:{int(t):02d},{80 + t:.2f},{np.sin(t):.4f}\n" for t in FINE]
    path.write_text("Time,Speed (km/h),YawRate (deg/s)\n" + "".join(rows))
    rules = tmp_path / "map.yaml"
    rules.write_text("channels: {tractor_vx_mps: {from: Speed, unit: km/h}}\n")
    read = read_recording(path, mapping=rules)
    series = read["tractor_vx_mps"]
    assert series.time_s.size == FINE.size
    assert np.diff(series.time_s) == pytest.approx(0.1)
    assert "10 rows share each 1 s of the clock" in "\n".join(read.notes)
