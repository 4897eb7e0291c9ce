"""What the benchmark of a real car writes."""

from __future__ import annotations

from typing import Any

from benchmarks.cars.driven import SIDEWAYS, YAW_RATE, driven_table, found_table


def comparison(yaw_rate_radps: float, sideways_mps: float) -> dict[str, Any]:
    return {"channels": {YAW_RATE: {"rms": yaw_rate_radps}, SIDEWAYS: {"rms": sideways_mps}}}


def test_errors_of_both_vehicles_stand_side_by_side() -> None:
    table = driven_table({"never seen": comparison(0.04, 0.5)},
                         {"never seen": comparison(0.03, 0.25)})
    assert table.lines[2:] == ["| yaw rate [deg/s], half never seen | 2.29 | 1.72 | 25 % |",
                               "| side velocity [m/s], half never seen | 0.50 | 0.25 | 50 % |"]


def test_what_was_found_is_told_with_its_equation() -> None:
    effect = {"name": "tire_saturation", "sentence": "Grip levels off.", "equation": "F = s"}
    table = found_table({"verdict": "missing_physics", "effects": [effect],
                         "summary": {"sure": "1 in 100.", "changed": "Better."}})
    assert "| `tire_saturation` | Grip levels off. `F = s` |" in table.lines
    assert table.lines[-1] == "| unseen half | Better. |"
