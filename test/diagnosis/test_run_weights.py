"""A run that nothing explains weighs little, and the others find the nuisances without it."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.algebra.linear import Projector
from truck_blowout_sim.diagnosis.fit.run_weights import run_weights, weighed

BINS, CHANNELS = 200, 3
ROWS = BINS * CHANNELS


def rows(k: int) -> slice:
    return slice(k * ROWS, (k + 1) * ROWS)


def study(columns: np.ndarray) -> SimpleNamespace:
    """Runs of as many samples each."""
    run = SimpleNamespace(measured=np.zeros((BINS, CHANNELS)))
    fitted = columns.shape[0] // ROWS - 1
    return SimpleNamespace(runs=(run,) * fitted, holdout=(run,),
                           gram=lambda k: columns[rows(k)].T @ columns[rows(k)])


@pytest.fixture
def rng() -> np.random.Generator:
    return np.random.default_rng(7)


def test_runs_that_are_explained_weigh_one(rng: np.random.Generator) -> None:
    columns = 5.0 * rng.standard_normal((3 * ROWS, 2))
    rest = columns @ np.array([0.3, -0.2]) + 0.9 * rng.standard_normal(3 * ROWS)
    assert (run_weights(study(columns), Projector.of(columns), rest) == 1.0).all()


def test_a_run_weighs_the_inverse_of_its_mean_square(rng: np.random.Generator) -> None:
    """Nothing to explain it with: weights in closed form."""
    rest = rng.standard_normal(3 * ROWS)
    rest[rows(1)] *= 4.0
    nothing = np.zeros((3 * ROWS, 1))
    found = run_weights(study(nothing), Projector.of(nothing), rest)
    assert found[rows(1)] == pytest.approx(1.0 / np.mean(rest[rows(1)] ** 2))
    assert found[rows(0)] == pytest.approx(min(1.0 / np.mean(rest[rows(0)] ** 2), 1.0))


def test_a_spoiled_run_does_not_set_what_the_others_show(rng: np.random.Generator) -> None:
    """It asks for 400 of a nuisance of which the three others show 0.3."""
    columns = rng.standard_normal((4 * ROWS, 1))
    rest = 0.3 * columns[:, 0] + 0.9 * rng.standard_normal(4 * ROWS)
    rest[rows(3)] = 400.0 * (columns[rows(3), 0] + rng.standard_normal(ROWS))
    projector = Projector.of(columns)
    assert projector.amounts(rest)[0] > 50.0
    weights = run_weights(study(columns), projector, rest)
    assert weights[rows(3)].max() < 1e-5
    size = np.sqrt(weights)
    there = Projector.of(columns * size[:, None])
    again = weighed(study(columns), projector, weights)
    assert again.amounts(rest * size) == pytest.approx(there.amounts(rest * size))
    assert again.remove(rest * size) == pytest.approx(there.remove(rest * size))
    found, sigma = there.amounts(rest * size)[0], there.covariance()[0, 0] ** 0.5
    assert found == pytest.approx(0.3, abs=4.0 * sigma)
    assert sigma < 0.05


def test_unseen_runs_are_weighed_only_where_there_are_rows_for_them(
    rng: np.random.Generator
) -> None:
    rest = rng.standard_normal(2 * ROWS)
    found = run_weights(study(np.zeros((3 * ROWS, 1))), Projector.of(np.zeros((2 * ROWS, 1))), rest)
    assert found.shape == (2 * ROWS,)
