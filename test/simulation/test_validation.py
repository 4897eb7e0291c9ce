"""The validation table: measured, not written; thesis mode fails as the thesis did."""

from __future__ import annotations

import pytest

from truck_blowout_sim.recordings import read_recording
from truck_blowout_sim.resources import config_file
from truck_blowout_sim.simulation import simulate
from truck_blowout_sim.simulation.validation import MODES, Row, as_markdown
from truck_blowout_sim.simulation.validation.published import published_rows
from truck_blowout_sim.simulation.validation.soundness import soundness_rows
from truck_blowout_sim.simulation.validation.turning import turning_rows
from truck_blowout_sim.vehicle import load_vehicle, pack


@pytest.fixture(scope="module")
def published() -> dict[str, dict[str, Row]]:
    log = read_recording(config_file("recordings", "test_2013_steer_blowout.csv"))
    rows = {}
    for mode, name in MODES.items():
        packed = pack(load_vehicle(name))
        run = simulate(packed, "steer_axle_blowout")
        rows[mode] = {row.key: row for row in published_rows(packed, run, log)}
    return rows


def test_all_published_figures_are_answered(published: dict[str, dict[str, Row]]) -> None:
    for rows in published.values():
        assert set(rows) == {f"V{n}" for n in range(1, 24)}


def test_thesis_mode_reproduces_the_failure_of_the_thesis(published: dict[str, dict[str, Row]]
                                                          ) -> None:
    """No yaw rate peak of 2.5 deg/s: about that much is missing at one second."""
    assert published["thesis"]["V7"].met is False
    peak = float(published["thesis"]["V7"].value.split()[0])
    missing = float(published["thesis"]["V19"].value.split()[0])
    assert peak < 1.5
    assert missing > 1.5


def test_default_mode_comes_nearer(published: dict[str, dict[str, Row]]) -> None:
    peaks = {mode: float(rows["V7"].value.split()[0]) for mode, rows in published.items()}
    pulls = {mode: float(rows["V10"].value.split()[0]) for mode, rows in published.items()}
    assert peaks["default"] > peaks["thesis"] + 0.5
    assert pulls["default"] > 2.0 * pulls["thesis"]


@pytest.mark.parametrize("key", ["V1", "V2", "V3", "V4", "V5", "V6", "V8", "V12", "V13", "V20",
                                 "V21", "V23"])
def test_default_mode_meets(published: dict[str, dict[str, Row]], key: str) -> None:
    assert published["default"][key].met, published["default"][key]


def test_benchmarks_are_not_called_met(published: dict[str, dict[str, Row]]) -> None:
    assert all(rows[key].met is None for rows in published.values() for key in ("V17", "V18"))


def test_turning_cases_that_the_thesis_is_right_about() -> None:
    """Q1, and in thesis mode the signs of Q2, Q5 and Q6."""
    for mode, keys in (("default", ["Q1"]), ("thesis", ["Q1", "Q2", "Q6"])):
        rows = {row.key: row for row in turning_rows(pack(load_vehicle(MODES[mode])))}
        assert set(rows) == {f"Q{n}" for n in range(1, 9)}
        for key in keys:
            assert rows[key].met, rows[key]


def test_default_truck_is_sound() -> None:
    rows = soundness_rows(pack(load_vehicle(MODES["default"])), weighed=True)
    assert [row.key for row in rows].count("load") == 3
    assert all(row.met for row in rows), [row for row in rows if not row.met]


def test_the_page_has_a_line_for_every_row() -> None:
    rows = [Row("V10", "wheel", "25", "9", False),
            Row("V2", "speed", "52 mph", "53 mph", True, "a")]
    page = as_markdown({key: dict.fromkeys(MODES, rows)
                        for key in ("published", "turning", "soundness")})
    assert page.count("| V2 | speed | 52 mph | 53 mph | yes | 53 mph | yes | a |") == 3
    assert page.index("| V2 ") < page.index("| V10 ")
    assert "**no**" in page
