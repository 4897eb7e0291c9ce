"""Several worlds in one table, and power against what an ideal detector sees."""

from __future__ import annotations

from typing import Any

from truck_blowout_sim.proof.worlds import (
    SOUGHT,
    draw_power_by_world,
    power,
    rivals_table,
    seen_effects,
    worlds_table,
)


def figures(named: int, uniform: float | None = 0.5) -> dict[str, Any]:
    seen = seen_effects([("brake_lag", 8.0, k < named) for k in range(4)]
                        + [("road_bank", 100.0, True), ("crosswind", 1.0, True),
                           ("roll_steer", None, True)])  # fmt: skip
    rows = [{"row": "false alarms, nothing missing", "hits": 1, "trials": 40},
            {"row": "of no list: unknown", "hits": 0, "trials": 0}]  # fmt: skip
    return {"rows": rows, "seen": seen, "null_p_values_uniform": uniform,
            "cpu_s": {"median": 12.34}}


def test_each_world_has_what_was_sought_and_reached() -> None:
    table = worlds_table({"w1": figures(1), "w3": figures(2, None)})
    assert "| | W1 sought | reached | W3 sought | reached | all |" in table
    assert "| ≤ 2 % | 2 % (1/40; 0–13) | ≤ 2 % | 2 % (1/40; 0–13) | 2 % (2/80; 1–9) |" in table
    assert "| of no list: unknown | ≥ 85 % | – | ≥ 70 % | – | – |" in table
    assert table.splitlines()[-2].endswith("|  | 0.5 |  | – | |")
    assert table.splitlines()[-1].endswith("|  | 12 s |  | 12 s | |")
    assert {line.count("|") for line in table.splitlines()} == {7}
    assert len(worlds_table({"w1": figures(1)}, short=True).splitlines()) == 4


def test_rivals_have_columns_in_worlds_where_they_were_tried() -> None:
    def rows(count: int) -> dict[str, Any]:
        names = ("no_change", "recalibrated", "gaussian_process", "sparse_regression", "diagnosed")
        return {name: {"count": count, "median_mean_square": 338.4 if count else None,
                       "diagnosed_is_better": {"hits": count, "trials": 2 * count}}
                for name in names}  # fmt: skip

    table = rivals_table({"w1": {"rivals": rows(5)}, "w3": {"rivals": rows(0)}}).splitlines()
    assert table[0] == "| | W1, 5 cases: median | diagnosed model is better |"
    assert table[2] == "| no change (sheet values) | 338 | 50 % (5/10; 24–76) |"
    assert len(table) == 7
    assert rivals_table({"w3": {"rivals": rows(0)}}) == ""


def test_power_is_counted_by_what_an_ideal_detector_sees() -> None:
    """Below 2 nothing can be seen, and what was not measured is not counted."""
    found = power({"w1": figures(3)})["w1"]
    assert [(low, sum(hit for _, hit in trials), len(trials)) for low, trials in found] == [
        (2.0, 0, 0), (6.0, 3, 4), (12.0, 0, 0), (18.0, 0, 0), (24.0, 1, 1)]  # fmt: skip


def test_the_picture_has_a_curve_a_world() -> None:
    picture = draw_power_by_world({"w1": figures(1), "w2": figures(4)})
    labels = [text.get_text() for text in picture.figure.axes[0].get_legend().get_texts()]
    assert labels == ["W1 (5 effects)", "W2 (5 effects)"]


def test_what_is_sought_has_a_figure_for_each_of_four_worlds() -> None:
    assert all(len(each) == 4 for each in SOUGHT.values())
