"""Cause by cause over several worlds."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from truck_blowout_sim.proof.cases import Truth, read_truth
from truck_blowout_sim.proof.causes import causes_table, causes_told, wrongly_told
from truck_blowout_sim.proof.score import CaseScore, score_case

Maker = Callable[..., dict[str, Any]]


@pytest.fixture
def world(tmp_path: Path, write_case: Callable[..., Path], line: Maker, cause: Maker,
          effect: Maker) -> tuple[list[CaseScore], dict[str, Truth]]:
    """Of four late brakes one is found, one misnamed, one missed, one too faint to count."""
    right, wrong = (effect(),), (effect("crosswind"),)
    stray = (cause("wake", kind="unlisted"),)
    lines = {
        "a": (line("a", effects=right), "single", (cause(),), 50.0),
        "b": (line("b", effects=wrong), "single", (cause(),), 50.0),
        "c": (line("c", "consistent"), "single", (cause(),), 50.0),
        "d": (line("d", "consistent"), "single", (cause(),), 2.0),
        "e": (line("e", "unknown"), "unknown", stray, 50.0),
        "f": (line("f", effects=wrong), "null", (), 0.0),
        "g": (line("g", effects=(*right, *wrong)), "pair", (cause(), cause("road_bank")), 50.0),
    }
    scores, truths = [], {}
    for name, (answer, group, causes, size) in lines.items():
        truth = read_truth(write_case(tmp_path, name, group, causes))
        truths[name] = replace(truth, causes=tuple(
            replace(one, sigma_b=size, individual=1e6) for one in truth.causes))
        scores.append(score_case(answer, truths[name]))
    return scores, truths


def test_only_what_stands_out_is_counted(
        world: tuple[list[CaseScore], dict[str, Truth]]) -> None:
    told = causes_told(*world)
    lags = [one["found"] for one in told if one["name"] == "brake_lag"]
    assert lags == [True, False, False, True]
    assert [one["found"] for one in told if one["kind"] == "unlisted"] == [True]


def test_the_table_has_a_row_a_cause_and_every_wrong_name(
        world: tuple[list[CaseScore], dict[str, Truth]]) -> None:
    figures = {"causes": causes_told(*world), "wrongly_told": wrongly_told(*world)}
    table = causes_table({"w1": figures, "w2": {"causes": [], "wrongly_told": []}})
    assert table.splitlines() == [
        "| concealed | W1 | W2 | wrong names stated |",
        "|---|---|---|---|",
        "| brake_lag | 2/4 |  | crosswind |",
        "| road_bank | 0/1 |  |  |",
        "| wake (of no list) | 1/1 |  |  |",
        "| nothing |  |  | crosswind |",
        "| two effects |  |  | crosswind |",
    ]
