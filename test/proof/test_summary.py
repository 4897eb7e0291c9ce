from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from truck_blowout_sim.proof.cases import Cause, find_cases
from truck_blowout_sim.proof.comparable import compare_parameter
from truck_blowout_sim.proof.prove import score_run
from truck_blowout_sim.proof.summary import held, null_floor

Maker = Callable[..., dict[str, Any]]


@pytest.fixture
def figures(tmp_path: Path, write_case: Callable[..., Path], line: Maker, effect: Maker,
            cause: Maker, manifest: Callable[[Path], Path]) -> dict[str, Any]:
    """Two nulls, three single effects, a sensor, an unknown, and one that broke down."""
    lag, fade = effect("brake_lag"), effect("brake_fade")
    speed = effect("speed_scale", kind="sensor")
    concealed = {
        "n1": ("null", (), line("n1", "consistent", holdout=(2.0, 2.0), p_value=0.4)),
        "n2": ("null", (), line("n2", "missing_physics", (lag,), holdout=(2.0, 1.0), p_value=0.2)),
        "s1": ("single", (cause(sigma=30.0),), line("s1", effects=(lag,), holdout=(6.0, 2.0))),
        "s2": ("single", (cause(sigma=12.0),),
               line("s2", effects=(fade,), alias_sets=(("brake_fade", "brake_lag"),))),
        "s3": ("single", (cause(sigma=5.0),), line("s3", "consistent", holdout=(1.0, 1.1))),
        "f1": ("sensor", (cause("speed_scale", kind="sensor"),),
               line("f1", "sensor_artefact", (speed,))),
        "u1": ("unknown", (cause("wake", kind="unlisted"),), line("u1", "unknown")),
        "x1": ("single", (cause(),), line("x1") | {"answer": None, "error": "broke"}),
    }
    for name, (group, causes, _) in concealed.items():
        write_case(tmp_path, name, group, causes)
    lines = {name: row for name, (_, _, row) in concealed.items()}
    made = score_run(find_cases(tmp_path), lines, tmp_path / "out", manifest(tmp_path))
    assert made["cases"] == 7
    return made


def hits(figures: dict[str, Any], name: str) -> tuple[int, int]:
    entry = figures["proportions"][name]
    return entry["hits"], entry["trials"]


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("effect named at alias-set level", (2, 2)),  # below 10 sigma is not asked for
        ("effect named first, raw", (1, 2)),
        ("false discovery on nulls", (1, 2)),
        ("unknown recognised", (1, 1)),
        ("unknown misnamed", (0, 1)),
        ("sensor against physics", (3, 3)),
        ("instrument fault named at alias-set level", (1, 1)),
        ("both of a pair, alias-set level", (0, 0)),
    ],
)
def test_proportions(figures: dict[str, Any], name: str, expected: tuple[int, int]) -> None:
    assert hits(figures, name) == expected


def test_solved_is_verdict_and_name_by_group(figures: dict[str, Any]) -> None:
    assert {group: (p["hits"], p["trials"]) for group, p in figures["solved"].items()} == {
        "null": (1, 2), "single": (2, 4), "sensor": (1, 1), "unknown": (1, 1)}


def test_power_by_visibility(figures: dict[str, Any]) -> None:
    shares = {row["sigma"][0]: (row["noticed"]["hits"], row["aliased"]["hits"], row["raw"]["hits"])
              for row in figures["power"] if row["noticed"]["trials"]}
    assert shares == {0.0: (0, 0, 0), 7.0: (1, 1, 0), 28.0: (1, 1, 1)}


def test_holdout_shares_against_instruments_and_against_nulls(figures: dict[str, Any]) -> None:
    # before and after squared: 36 and 4, 9 and 1, 1 and 1.21; nulls leave 4 and 1, median 2.5
    fit = figures["holdout"]
    assert (fit["improved"]["hits"], fit["improved"]["trials"]) == (2, 3)
    assert fit["median_removed_of_excess_over_instruments"] == pytest.approx(
        (32 / 35 + 8 / 8) / 2)
    assert fit["median_removed_of_excess_over_null_floor"] == pytest.approx(
        (32 / 33.5 + 8 / 6.5) / 2)


def test_floor_is_the_median_over_nulls(line: Maker) -> None:
    lines = {str(k): line(str(k), holdout=(9.0, rms)) for k, rms in enumerate((1.0, 2.0, 3.0))}
    assert null_floor(lines, ["0", "1", "2"]) == {"vx": 4.0}


def test_alias_sets_parameters_p_values(figures: dict[str, Any]) -> None:
    assert figures["mean_alias_set_size"] == 1.5
    assert figures["null_p_values"] == [0.2, 0.4]
    assert figures["parameters"]["count"] == 1


def test_files_say_what_was_found(figures: dict[str, Any], tmp_path: Path) -> None:
    out = tmp_path / "out"
    assert json.loads((out / "proof.json").read_text())["cases"] == 7
    page = (out / "proof.md").read_text()
    assert "8 hold, none broken" in page
    assert "- x1: broke" in page
    cases = (out / "cases.csv").read_text().splitlines()
    assert "s2,brake_lag,12,,missing physics,brake_fade (brake_lag),yes,9,1" in cases
    assert len((out / "parameters.csv").read_text().splitlines()) == 2
    for name in ("power", "confusion"):
        assert (out / f"{name}.png").read_bytes().startswith(b"\x89PNG")
    assert not (out / "reliability.png").exists()


def test_p_values_are_drawn_where_there_are_enough() -> None:
    from truck_blowout_sim.proof.figures import draw_reliability

    picture = draw_reliability([0.1, 0.2, 0.5, 0.7, 0.9])
    shares = picture.figure.axes[0].lines[0]
    assert list(shares.get_xdata())[1:-1] == [0.1, 0.2, 0.5, 0.7, 0.9]
    assert list(shares.get_ydata()) == pytest.approx([0.0, 0.2, 0.4, 0.6, 0.8, 1.0, 1.0])
    assert picture.png().startswith(b"\x89PNG")


def test_intervals_of_other_levels_follow_from_the_stated_one() -> None:
    """Estimates that scatter by what their 90 % intervals say hold the truth as often as said."""
    rng = np.random.default_rng(4)
    arm = 1.645 * 0.1
    scored = []
    for value in rng.normal(1.0, 0.1, 4000):
        stated = {"value": value, "ci90": [value - arm, value + arm]}
        cause = Cause("brake_lag", "physics", {}, 20.0, {}, ("extra lag", 1.0))
        scored.append(compare_parameter(cause, {"name": "brake_lag",
                                                "parameters": {"extra_lag_s": stated}}))
    for level in (0.5, 0.8, 0.95):
        assert held([p for p in scored if p], level).value == pytest.approx(level, abs=0.02)


def test_an_interval_that_is_open_toward_the_truth_says_nothing_of_other_levels() -> None:
    cause = Cause("brake_lag", "physics", {}, 20.0, {}, ("extra lag", 1.0))
    parts = {"extra_lag_s": {"value": 0.9, "ci90": [0.8, None]}}
    scored = compare_parameter(cause, {"name": "brake_lag", "parameters": parts})
    assert scored
    assert scored.covered
    assert held([scored], 0.5).trials == 0
