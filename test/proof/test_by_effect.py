from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from truck_blowout_sim.proof.by_effect import effect_rows, effect_table, span
from truck_blowout_sim.proof.cases import Cause, Truth
from truck_blowout_sim.proof.figures import draw_effects
from truck_blowout_sim.proof.score import CaseScore, score_case

Maker = Callable[..., dict[str, Any]]
NOWHERE = {"body": None, "axle": None, "hub": None, "tire": None}


@pytest.fixture
def scores(line: Maker, effect: Maker) -> list[CaseScore]:
    """Two lags, one taken for a fade, a gain not noticed, two effects of no list, one pair."""
    def one(group: str, name: str, kind: str, sigma: float, **answer: object) -> CaseScore:
        cause = Cause(name, kind, NOWHERE, sigma, {}, ("", 0.0, ""))
        right = {"unknown": "unknown"}.get(group, "missing_physics")
        return score_case(line(**answer), Truth(group, (right,), (cause,), ()))

    lag, fade = effect("brake_lag"), effect("brake_fade")
    pair = Truth("pair", ("missing_physics",), (Cause("brake_lag", "physics", NOWHERE, 9.0, {},
                                                      ("", 0.0, "")),) * 2, ())
    return [one("unknown", "wake", "unlisted", 50.0, verdict="unknown"),
            one("unknown", "wake", "unlisted", 50.0, effects=(fade,)),
            one("single", "brake_lag", "physics", 20.0, effects=(lag,)),
            one("single", "brake_lag", "physics", 20.0, effects=(fade,)),
            one("sensor", "speed_scale", "sensor", 5.0, verdict="consistent"),
            score_case(line(effects=(lag,)), pair)]


def test_rows_count_what_was_found_and_what_it_was_taken_for(scores: list[CaseScore]) -> None:
    rows = effect_rows(scores)
    assert [row["name"] for row in rows] == ["brake_lag", "speed_scale", "wake"]
    assert [row["found"]["hits"] for row in rows] == [1, 0, 1]
    assert [row["taken_for"] for row in rows] == [
        {"brake_fade": 1}, {"nothing": 1}, {"brake_fade": 1}]
    assert [p["trials"] for p in rows[0]["by_sigma"]] == [0, 0, 2, 0, 0]


def test_the_table_shows_hits_by_visibility(scores: list[CaseScore]) -> None:
    lag = effect_table(effect_rows(scores))[4]
    assert lag == "| brake_lag |  |  | 1/2 |  |  | 50 % (1/2; 9–91) | brake_fade 1 |"
    assert (span(0), span(4)) == ("0–7", "≥ 64")


def test_the_map_of_effects_is_drawn(scores: list[CaseScore]) -> None:
    picture = draw_effects(effect_rows(scores))
    (axes,) = picture.figure.axes
    assert [text.get_text() for text in axes.texts] == ["1/2", "0/1", "1/2"]
    assert [label.get_text() for label in axes.get_yticklabels()] == [
        "brake lag", "speed scale", "wake"]
    assert picture.png().startswith(b"\x89PNG")
