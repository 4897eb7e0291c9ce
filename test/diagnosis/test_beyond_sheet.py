"""Numbers of the sheet that no vehicle has tell that something is missing."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.locate.beyond_sheet import (
    chance_of_any_beyond,
    chance_of_numbers,
)

Studies = Callable[..., Study]
ASKEW = {"axle.trailer_1.misalignment_rad": 0.1}


def test_chance_of_one_number_is_that_of_a_good_or_a_wrong_sheet() -> None:
    rng = np.random.default_rng(1)
    wrong = rng.random(400_000) < 0.1
    drawn = np.abs(rng.standard_normal(wrong.size) * np.where(wrong, 4.0, 1.0))
    for far in (0.5, 2.0, 6.0):
        expected = float(np.mean(drawn > far))
        assert chance_of_any_beyond(np.array([-far])) == pytest.approx(expected, rel=0.05)


def test_many_numbers_reach_farther_by_chance() -> None:
    alone, many = (chance_of_any_beyond(np.array([9.0, *[0.0] * k])) for k in (0, 70))
    assert many == pytest.approx(1.0 - (1.0 - alone) ** 71)
    assert chance_of_any_beyond(np.full(71, 9.0)) == pytest.approx(many)


def test_of_no_numbers_nothing_is_far() -> None:
    assert chance_of_any_beyond(np.zeros(0)) == 1.0


def test_a_truck_as_its_baseline_runs_show_it_is_not_far(study_of: Studies) -> None:
    assert chance_of_numbers(study_of(baseline=True)) > 0.5


def test_what_turns_the_truck_in_training_only_pulls_its_numbers_far(study_of: Studies) -> None:
    study = study_of(ASKEW, baseline=True)
    assert chance_of_numbers(study) < study.settings.alarms_by_rest
    assert chance_of_numbers(replace(study, runs=tuple(
        replace(run, role="train") for run in study.runs))) == 1.0
