from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from truck_blowout_sim.proof.cases import Truth, read_truth
from truck_blowout_sim.proof.comparable import COMPARABLE, NOT_COMPARABLE
from truck_blowout_sim.proof.score import Fitted, fitted, score_case

Maker = Callable[..., dict[str, Any]]
NOWHERE = {"body": None, "axle": None, "hub": None, "tire": None}


@pytest.fixture
def truth(tmp_path: Path, write_case: Callable[..., Path]) -> Callable[..., Truth]:
    def make(group: str, *causes: dict[str, Any]) -> Truth:
        return read_truth(write_case(tmp_path, "a", group, causes))
    return make


def test_right_name_strength_and_place(line: Maker, effect: Maker, cause: Maker,
                                       truth: Callable[..., Truth]) -> None:
    sealed = cause(where=NOWHERE | {"body": "tractor", "axle": "drive"})
    found = effect(where=NOWHERE | {"body": "tractor", "axle": "drive_1"})
    one = score_case(line(effects=(found,)), truth("single", sealed)).causes[0]
    assert (one.raw, one.aliased, one.alias_size, one.body, one.axle) == (True, True, 1, True, True)
    assert one.parameter is not None
    assert one.parameter.relative_error == pytest.approx(0.1)
    assert not one.parameter.covered


def test_only_the_first_of_several_names_counts(line: Maker, effect: Maker, cause: Maker,
                                                truth: Callable[..., Truth]) -> None:
    effects = (effect("road_grade"), effect("brake_lag"))
    one = score_case(line(effects=effects), truth("single", cause())).causes[0]
    assert (one.raw, one.aliased) == (False, False)


def test_an_alias_counts_as_alias_only(line: Maker, effect: Maker, cause: Maker,
                                       truth: Callable[..., Truth]) -> None:
    given = line(effects=(effect("brake_fade"),), alias_sets=(("brake_fade", "brake_lag"),))
    one = score_case(given, truth("single", cause())).causes[0]
    assert (one.raw, one.aliased, one.alias_size) == (False, True, 2)
    assert one.parameter is None
    assert one.body is None


def test_both_of_a_pair_are_looked_for_anywhere(line: Maker, effect: Maker, cause: Maker,
                                                truth: Callable[..., Truth]) -> None:
    effects = (effect("road_grade"), effect("brake_lag"))
    pair = truth("pair", cause("brake_lag"), cause("crosswind"))
    assert [c.aliased for c in score_case(line(effects=effects), pair).causes] == [True, False]


def test_another_axle_of_the_same_tandem_is_wrong(line: Maker, effect: Maker, cause: Maker,
                                                  truth: Callable[..., Truth]) -> None:
    sealed = cause(where=NOWHERE | {"body": "trailer", "axle": "trailer_2"})
    found = effect(where=NOWHERE | {"body": "trailer", "axle": "trailer_1"})
    assert score_case(line(effects=(found,)), truth("single", sealed)).causes[0].axle is False


def test_onset_against_the_earliest_training_run(line: Maker, effect: Maker, cause: Maker,
                                                 truth: Callable[..., Truth]) -> None:
    sealed = cause("payload_shift", onset_s={"holdout_1": 1.0, "train_1": 4.0, "train_2": 3.0})
    found = effect("payload_shift", onset_s=3.2, onset_ci90_s=[3.1, 3.3])
    one = score_case(line(effects=(found,)),
                     truth("single", sealed)).causes[0]
    assert one.onset_error_s == pytest.approx(0.2)
    assert one.onset_covered is False


def test_an_instrument_answered_with_physics_is_the_wrong_kind(
    line: Maker, effect: Maker, cause: Maker, truth: Callable[..., Truth]
) -> None:
    sensor = truth("sensor", cause("speed_scale", kind="sensor"))
    right = effect("speed_scale", kind="sensor")
    assert score_case(line(effects=(right,)), sensor).kind_right is True
    assert score_case(line(effects=(right, effect())), sensor).kind_right is False
    assert score_case(line(verdict="consistent"), sensor).kind_right is None


def test_a_null_is_right_when_nothing_is_named(line: Maker, truth: Callable[..., Truth]) -> None:
    null = truth("null")
    quiet, loud = (score_case(line(verdict=v), null) for v in ("miscalibrated", "unknown"))
    assert (quiet.right, quiet.detected) == (True, False)
    assert (loud.right, loud.detected) == (False, True)


def test_share_removed() -> None:
    assert Fitted(9.0, 3.0).removed(1.0) == pytest.approx(0.75)
    assert Fitted(9.0, 11.0).removed(1.0) == pytest.approx(-0.25)
    assert Fitted(1.4, 1.0).removed(1.0) is None


def test_mean_squares_and_floor_over_the_same_channels() -> None:
    fit = {"before": {"a": 3.0, "b": 1.0, "lost": 9.0}, "after": {"a": 1.0, "b": 1.0}}
    assert fitted(fit, {"a": 2.0, "b": 4.0}) == Fitted(5.0, 1.0, 3.0)
    assert fitted(fit, {"a": 2.0}) == Fitted(5.0, 1.0, None)
    assert fitted({"before": {}, "after": {}}, None) is None


def test_every_effect_is_compared_or_a_reason_is_given() -> None:
    from truck_blowout_sim.diagnosis.effects import LIBRARY

    assert {effect.name for effect in LIBRARY} <= set(COMPARABLE) | set(NOT_COMPARABLE)
    assert not set(COMPARABLE) & set(NOT_COMPARABLE)


def test_friction_lost_is_one_minus_the_factor() -> None:
    assert COMPARABLE["friction_change"].convert(0.3) == pytest.approx(0.7)
