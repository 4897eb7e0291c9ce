"""A residual of known color becomes white, exactly, and comes back."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import toeplitz
from scipy.signal import lfilter

from truck_blowout_sim.diagnosis.algebra.color import Color, autocovariance

LAGS = 6


def covariance_of(decay: float, size: float, n: int) -> np.ndarray:
    """Autocovariance [n] of a process that forgets by ``decay`` a bin, with some white noise."""
    found = size * decay ** np.arange(n)
    found[0] += 0.3
    return found


@given(decay=st.floats(0.0, 0.95), size=st.floats(0.1, 20.0), n=st.integers(1, LAGS + 1))
@settings(max_examples=40, deadline=None)
def test_squares_of_a_short_series_are_those_of_its_dense_covariance(
        decay: float, size: float, n: int) -> None:
    covariance = covariance_of(decay, size, LAGS + 1)
    z = np.random.default_rng(n).standard_normal(n)
    white = Color.of(covariance[None]).whitened(z[:, None])
    dense = z @ np.linalg.solve(toeplitz(covariance[:n]), z)
    assert float(np.sum(np.square(white))) == pytest.approx(dense, rel=1e-9)


@pytest.mark.parametrize("n", [3, 200])
def test_color_comes_back(n: int) -> None:
    color = Color.of(np.stack([covariance_of(0.8, 2.0, LAGS + 1), np.eye(1, LAGS + 1)[0] * 4.0]))
    cube = np.random.default_rng(1).standard_normal((n, 2, 3))
    np.testing.assert_allclose(color.colored(color.whitened(cube)), cube, atol=1e-12)
    np.testing.assert_allclose(color.whitened(cube)[:, :, 1], color.whitened(cube[:, :, 1]))
    np.testing.assert_allclose(color.whitened(cube)[:, 1], 0.5 * cube[:, 1])


def test_an_autoregression_becomes_white() -> None:
    rng = np.random.default_rng(2)
    series = lfilter([1.0], [1.0, -1.2, 0.6], rng.standard_normal(4000))[100:]
    color = Color.of(autocovariance(series, LAGS)[None] / series.size)
    white = color.whitened(series[:, None])[:, 0]
    after = autocovariance(white, 3) / white.size
    assert after[0] == pytest.approx(1.0, abs=0.02)
    assert np.abs(after[1:]).max() < 0.03


def test_a_channel_without_color_stays_as_it_is() -> None:
    joined = Color.joined([None, Color.of(covariance_of(0.9, 1.0, LAGS + 1)[None])], LAGS)
    cube = np.random.default_rng(3).standard_normal((50, 2))
    np.testing.assert_array_equal(joined.whitened(cube)[:, 0], cube[:, 0])
    np.testing.assert_array_equal(Color.white(2).whitened(cube), cube)
    np.testing.assert_array_equal(Color.white(2).colored(cube), cube)
