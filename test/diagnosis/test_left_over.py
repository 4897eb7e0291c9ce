"""Training keeps more than baseline where something is missing, and else by chance only."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.case.study import Study, row_ranges
from truck_blowout_sim.diagnosis.locate.left_over import (
    chance_of_more,
    expected_squares,
    keeps_more,
    mean_squares,
)

Studies = Callable[..., Study]


def case(train: int, baseline: int) -> Study:
    """A study of so many runs, baseline first."""
    return cast(Study, SimpleNamespace(runs=tuple(range(baseline + train)),
                                       baseline=tuple(range(baseline)),
                                       train=tuple(range(baseline, baseline + train)),
                                       settings=SimpleNamespace(alarms_by_rest=0.02)))


def test_without_baseline_runs_only_far_more_than_the_widths_says_that_something_is_missing(
) -> None:
    alone = case(2, 0)
    assert expected_squares(alone, (9.0, 9.0)) == 1.0
    assert chance_of_more(alone, (1.5, 1.5)) > 0.1
    # noise that remembers leaves three times what a guess of good instruments says
    assert chance_of_more(alone, (9.0, 9.0)) > 0.01
    assert chance_of_more(alone, (30.0, 30.0)) < 5e-3


def test_alarms_are_as_rare_as_stated_where_runs_scatter_as_the_prior_says() -> None:
    rng = np.random.default_rng(3)
    study = case(3, 2)
    scatters = 0.4 * np.sqrt(6.0 / rng.chisquare(6.0, 4000))
    alarms = [keeps_more(study, np.exp(scatter * rng.standard_normal(5)).tolist())
              for scatter in scatters]
    assert 0.008 < np.mean(alarms) < 0.025


def test_tenfold_squares_are_more_and_a_common_level_is_not() -> None:
    study = case(3, 2)
    assert keeps_more(study, (0.3, 0.35, 3.0, 4.0, 3.5))
    for level in (0.01, 1.0, 100.0):
        assert not keeps_more(study, (0.9 * level, 1.1 * level, level, 1.2 * level, level))


def test_unseen_runs_tell_too() -> None:
    study = case(2, 2)
    squares = (0.3, 0.35, 0.75, 0.8)
    assert not keeps_more(study, squares)
    assert keeps_more(study, (*squares, 0.8, 0.75, 0.8, 0.78))
    assert chance_of_more(study, (*squares, 0.3, 0.3)) > chance_of_more(study, squares)


def test_one_run_of_training_that_keeps_far_more_is_enough() -> None:
    study = case(3, 2)
    assert keeps_more(study, (0.3, 0.35, 0.3, 9.0, 0.35))
    assert not keeps_more(study, (0.3, 0.35, 0.3, 0.7, 0.35))


def test_more_runs_tell_a_smaller_difference() -> None:
    few = chance_of_more(case(1, 1), (1.0, 3.0))
    many = chance_of_more(case(4, 4), (1.0, 1.1, 0.9, 1.0, 3.0, 3.1, 2.9, 3.0))
    assert many < 0.02 < few


def test_squares_of_a_true_truck_are_alike_in_all_runs(study_of: Studies) -> None:
    study = study_of(baseline=True)
    baseline, train = mean_squares(study)
    assert 0.3 < train / baseline < 3.0
    assert expected_squares(study, (baseline, train)) == pytest.approx(baseline)


def test_what_baseline_and_training_cost_adds_up_and_is_never_negative(study_of: Studies) -> None:
    """Chain rule: baseline alone, and training beside it, make the sum of squares of both.

    A run that strains the sheet does not make the other look better than it is.
    """
    study = study_of(baseline=True)
    (train,), (baseline,) = study.train, study.baseline
    run, rows = study.runs[train], row_ranges(study)[train]
    usual = mean_squares(study)
    strain = study.columns[rows] @ np.linspace(-9.0, 9.0, study.columns.shape[1])
    study.models[train] = study.models[train] - run.plain(strain.reshape(run.measured.shape))
    squares = mean_squares(study)
    assert squares[train] > 2.0 * usual[train]
    assert squares[baseline] == pytest.approx(usual[baseline])
    counts = [int(np.isfinite(one.measured).sum()) for one in study.runs]
    total = study.projector().chi2(study.residual())
    assert np.dot(squares, counts) == pytest.approx(total)


def test_an_unseen_run_is_counted_as_a_training_run_is(study_of: Studies) -> None:
    study = study_of(baseline=True)
    (train,) = study.train
    held = replace(study, holdout=(study.runs[train],),
                   holdout_columns=[study.columns[row_ranges(study)[train]]])
    squares = mean_squares(held, unseen=[study.models[train]])
    assert squares[:2] == mean_squares(study)
    assert squares[2] == pytest.approx(squares[train])
