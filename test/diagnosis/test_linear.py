"""Projection and score against the dense Gaussian model they stand for."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar
from scipy.stats import binomtest, kstest, multivariate_normal

from truck_blowout_sim.diagnosis.algebra.linear import Projector, joint_score, score

Floats = NDArray[np.float64]

FEW = settings(max_examples=20)


def problem(seed: int, n: int = 30, k: int = 4, m: int = 1) -> tuple[Floats, Floats, Floats]:
    """Nuisance columns of very different strength, candidate columns, a residual."""
    rng = np.random.default_rng(seed)
    nuisances = rng.standard_normal((n, k)) * 10.0 ** rng.uniform(-1.5, 1.5, k)
    return nuisances, rng.standard_normal((n, m)), 3.0 * rng.standard_normal(n)


def dense(nuisances: Floats) -> Floats:
    """Covariance of the residual once unit-prior nuisances are marginalized."""
    return np.eye(nuisances.shape[0]) + nuisances @ nuisances.T


@FEW
@given(st.integers(0, 10_000), st.integers(2, 25), st.integers(0, 12))
def test_removing_is_the_inverse_of_the_dense_covariance(seed: int, n: int, k: int) -> None:
    nuisances, _, residual = problem(seed, n, k)
    projector = Projector.of(nuisances)
    expected = np.linalg.solve(dense(nuisances), residual)
    np.testing.assert_allclose(projector.remove(residual), expected, rtol=1e-6, atol=1e-9)
    assert projector.chi2(residual) == pytest.approx(residual @ expected, rel=1e-6)


@FEW
@given(st.integers(0, 10_000))
def test_amounts_and_covariance_are_the_gaussian_posterior(seed: int) -> None:
    nuisances, _, residual = problem(seed)
    projector = Projector.of(nuisances)
    gain = nuisances.T @ np.linalg.inv(dense(nuisances))
    np.testing.assert_allclose(projector.amounts(residual), gain @ residual, rtol=1e-6, atol=1e-9)
    np.testing.assert_allclose(projector.covariance(), np.eye(4) - gain @ nuisances, atol=1e-8)


@FEW
@given(st.integers(0, 10_000))
def test_the_sum_of_squares_is_that_of_the_best_nuisances_with_their_priors(seed: int) -> None:
    nuisances, _, residual = problem(seed)
    projector = Projector.of(nuisances)
    amounts = projector.amounts(residual)
    left = residual - nuisances @ amounts
    assert projector.chi2(residual) == pytest.approx(left @ left + amounts @ amounts, rel=1e-6)


@FEW
@given(st.integers(0, 10_000))
def test_score_is_twice_the_rise_of_the_log_marginal_likelihood(seed: int) -> None:
    nuisances, columns, residual = problem(seed)
    projector, column = Projector.of(nuisances), columns[:, 0]
    found = score(projector, projector.remove(residual), column)
    law = multivariate_normal(np.zeros(residual.size), dense(nuisances))
    best = minimize_scalar(lambda a: -2.0 * law.logpdf(residual - a * column))
    assert found.amount == pytest.approx(best.x, abs=1e-4)
    assert found.delta == pytest.approx(-2.0 * law.logpdf(residual) - best.fun, abs=1e-6)
    information = column @ np.linalg.solve(dense(nuisances), column)
    assert found.sigma == pytest.approx(information**-0.5, rel=1e-6)


@FEW
@given(st.integers(0, 10_000), st.floats(-1.0, 0.0), st.floats(0.0, 1.0))
def test_a_limited_amount_is_worth_what_it_buys_at_its_limit(
    seed: int, low: float, high: float
) -> None:
    nuisances, columns, residual = problem(seed)
    projector, column = Projector.of(nuisances), columns[:, 0]
    free = score(projector, projector.remove(residual), column)
    found = score(projector, projector.remove(residual), column, low, high)
    assert found.amount == pytest.approx(min(max(free.amount, low), high))
    bought = projector.chi2(residual) - projector.chi2(residual - found.amount * column)
    assert found.delta == pytest.approx(bought, abs=1e-7)
    assert -1e-9 <= found.delta <= free.delta + 1e-9


def test_a_column_that_changes_nothing_is_worth_nothing() -> None:
    nuisances, _, residual = problem(0)
    projector = Projector.of(nuisances)
    found = score(projector, projector.remove(residual), np.zeros(residual.size))
    assert (found.amount, found.delta, found.sigma) == (0.0, 0.0, np.inf)


@FEW
@given(st.integers(0, 10_000))
def test_columns_fitted_together_are_generalized_least_squares(seed: int) -> None:
    nuisances, columns, residual = problem(seed, m=3)
    projector = Projector.of(nuisances)
    amounts, covariance = joint_score(projector, projector.remove(residual), columns)
    inverse = np.linalg.inv(dense(nuisances))
    expected = np.linalg.inv(columns.T @ inverse @ columns)
    np.testing.assert_allclose(covariance, expected, rtol=1e-5, atol=1e-9)
    np.testing.assert_allclose(amounts, expected @ columns.T @ inverse @ residual,
                               rtol=1e-5, atol=1e-7)


def test_one_column_alone_has_the_same_answer_either_way() -> None:
    nuisances, columns, residual = problem(7)
    projector = Projector.of(nuisances)
    removed = projector.remove(residual)
    amounts, covariance = joint_score(projector, removed, columns)
    alone = score(projector, removed, columns[:, 0])
    assert amounts[0] == pytest.approx(alone.amount, rel=1e-6)
    assert covariance[0, 0] == pytest.approx(alone.sigma**2, rel=1e-6)


def drawn(seed: int, truth: float) -> tuple[Projector, Floats, Floats, Floats]:
    """Many residuals of one problem: noise, nuisances from their priors, and the effect."""
    rng = np.random.default_rng(seed)
    nuisances = rng.standard_normal((40, 6)) * np.geomspace(0.1, 20.0, 6)
    column = rng.standard_normal(40) + 0.3 * nuisances[:, 3]
    hidden = rng.standard_normal((2000, 6))
    residuals = (hidden @ nuisances.T + rng.standard_normal((2000, 40)) + truth * column)
    return Projector.of(nuisances), column, residuals, hidden


def test_evidence_of_nothing_is_chi_square_with_one_degree() -> None:
    projector, column, residuals, _ = drawn(1, truth=0.0)
    deltas = [score(projector, projector.remove(r), column).delta for r in residuals]
    assert kstest(deltas, "chi2", args=(1,)).pvalue > 0.01
    # and would be far from it if the nuisances were not projected out
    plain = [float((column @ r) ** 2 / (column @ column)) for r in residuals]
    assert kstest(plain, "chi2", args=(1,)).pvalue < 1e-6


def test_ninety_percent_intervals_hold_the_truth_nine_times_in_ten() -> None:
    projector, column, residuals, hidden = drawn(2, truth=0.7)
    found = [score(projector, projector.remove(r), column) for r in residuals]
    hits = sum(abs(f.amount - 0.7) < 1.645 * f.sigma for f in found)
    assert binomtest(hits, len(found), 0.9).pvalue > 0.01
    spread = np.sqrt(np.diag(projector.covariance()))
    for r, f, truth in zip(residuals[:5], found[:5], hidden[:5], strict=True):
        assert np.abs((projector.amounts(r - 0.7 * column) - truth) / spread).max() < 5.0
        assert f.delta > 0.0


def test_posterior_of_the_nuisances_covers_what_they_were() -> None:
    projector, _, residuals, hidden = drawn(3, truth=0.0)
    spread = np.sqrt(np.diag(projector.covariance()))
    errors = np.stack([projector.amounts(r) for r in residuals]) - hidden
    for k in range(spread.size):
        hits = int((np.abs(errors[:, k]) < 1.645 * spread[k]).sum())
        assert binomtest(hits, len(errors), 0.9).pvalue > 1e-3


@FEW
@given(st.integers(0, 10_000), st.floats(0.01, 3.0))
def test_bounded_amounts_keep_their_bounds_and_the_others_are_best_given_them(
    seed: int, bound: float
) -> None:
    nuisances, _, residual = problem(seed, k=6)
    projector = Projector.of(nuisances)
    limit = np.full(6, bound)
    found = projector.amounts_within(residual, -limit, limit)
    assert np.all(np.abs(found) <= bound * (1.0 + 1e-9))
    slope = found - nuisances.T @ (residual - nuisances @ found)
    inside = np.abs(found) < bound * (1.0 - 1e-9)
    scale = 1.0 + np.linalg.norm(nuisances, axis=0) * np.linalg.norm(residual)
    np.testing.assert_allclose((slope / scale)[inside], 0.0, atol=1e-7)
    free = projector.amounts_within(residual, -1e6 * limit, 1e6 * limit)
    np.testing.assert_allclose(free, projector.amounts(residual), rtol=1e-9)
