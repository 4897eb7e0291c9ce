"""What each run shows of an amount, with the nuisances marginalized."""

from __future__ import annotations

from functools import partial
from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.algebra.linear import Projector
from truck_blowout_sim.diagnosis.case.runs import Run
from truck_blowout_sim.diagnosis.fit.shown import Part, Question, Shown, parts_of


def test_runs_are_told_apart_with_the_nuisances_marginalized() -> None:
    """The same numbers as a dense Gaussian gives."""
    rng = np.random.default_rng(3)
    nuisances, columns = rng.normal(size=(60, 4)), rng.normal(size=60)
    residual = rng.normal(size=60) + 0.8 * columns
    projector = Projector.of(nuisances)
    parts = [Part(slice(20 * k, 20 * k + 20), columns[20 * k:20 * k + 20], k < 2) for k in range(3)]
    found = Shown.of(projector, projector.remove(residual), parts)
    assert found is not None
    inverse = np.linalg.inv(np.eye(60) + nuisances @ nuisances.T)
    split = np.stack([np.where(np.arange(60) // 20 == k, columns, 0.0) for k in range(3)], axis=1)
    np.testing.assert_allclose(found.information, split.T @ inverse @ split, atol=1e-9)
    np.testing.assert_allclose(found.gradient, split.T @ inverse @ residual, atol=1e-9)
    np.testing.assert_array_equal(found.trained, [1.0, 1.0, 0.0])


def test_a_run_that_does_not_show_the_effect_is_left_out() -> None:
    """Brakes that were not applied say nothing of a brake."""
    projector, ones = Projector.of(np.zeros((30, 1))), np.ones(10)
    parts = [Part(slice(0, 10), ones, True), Part(slice(10, 20), 1e-4 * ones, False)]
    found = Shown.of(projector, np.ones(30), parts)
    assert found is not None
    assert found.trained.size == 1
    assert Shown.of(projector, np.ones(30), [Part(slice(0, 10), 0.0 * ones, True)]) is None


def test_a_run_that_nothing_explains_weighs_less() -> None:
    """A run left with nine times its variance counts as if its widths were three times as wide."""
    projector, ones = Projector.of(np.zeros((20, 1))), np.ones(10)
    parts = [Part(slice(0, 10), ones, True), Part(slice(10, 20), ones, True)]
    left = np.concatenate([0.5 * ones, 3.0 * ones])
    found = Shown.of(projector, np.ones(20), parts, left=left)
    assert found is not None
    np.testing.assert_allclose(np.diag(found.information), [10.0, 10.0 / 9.0])
    np.testing.assert_allclose(found.gradient, [10.0, 10.0 / 9.0])


def test_a_question_is_asked_again_beside_another_effect() -> None:
    """The same as asked anew of the residual without that effect."""
    rng = np.random.default_rng(4)
    nuisances, column, change = (rng.normal(size=shape) for shape in ((40, 3), 40, 40))
    residual, projector = rng.normal(size=40) + change, Projector.of(nuisances, [0, 2])
    parts = [Part(slice(0, 20), column[:20], True), Part(slice(20, 40), column[20:], False)]
    first, anew = (Question.of(projector, projector.remove(one), parts, (0.0,), (-1.0, 1.0))
                   for one in (residual, residual - change))
    assert first is not None
    assert anew is not None
    again = first.beside(change, nuisances.T @ change)
    np.testing.assert_allclose(again.gradient, anew.gradient)
    np.testing.assert_allclose(again.information, anew.information)


@pytest.mark.parametrize(("seconds", "parts"), [(12.0, 1), (39.9, 1), (40.0, 2), (600.0, 30)])
def test_of_a_long_run_each_episode_counts_as_a_run(seconds: float, parts: int) -> None:
    """Episodes of 20 s and more that follow each other and leave nothing out."""
    bins = round(seconds / 0.1)
    run = SimpleNamespace(measured=np.zeros((bins, 3)), length_s=seconds, has_blowout=False)
    run.episodes = partial(Run.episodes, run)
    column = np.arange(3.0 * bins)
    found = parts_of(run, 7, column, True, 20.0)  # type: ignore[arg-type]
    assert len(found) == parts
    assert found[0].rows.start == 7
    assert found[-1].rows.stop == 7 + column.size
    np.testing.assert_array_equal(np.concatenate([part.column for part in found]), column)
    assert all(a.rows.stop == b.rows.start for a, b in pairwise(found))
