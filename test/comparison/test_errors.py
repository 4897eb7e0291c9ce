from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from truck_blowout_sim.comparison.errors import channel_error, shortened
from truck_blowout_sim.comparison.noise import Sigma
from truck_blowout_sim.comparison.pairing import Pair

TIME = np.arange(0.0, 10.0, 0.01)
MEASURED = 20.0 + np.sin(TIME)


def test_a_known_difference_gives_known_errors() -> None:
    difference = 0.5 * np.sin(2 * np.pi * TIME) + 0.1
    difference[700] = -3.0
    pair = Pair("tractor_vx_mps", TIME, MEASURED, MEASURED + difference)
    error = channel_error(pair, "speed", Sigma(0.05, "stated"))
    kept = np.delete(np.arange(TIME.size), 700)
    assert error.rms == pytest.approx(np.sqrt((np.sum(difference[kept] ** 2) + 9.0) / TIME.size))
    assert (error.peak, error.peak_time_s) == (pytest.approx(-3.0), pytest.approx(7.0))
    assert error.final == pytest.approx(difference[-1])
    assert error.peak_sigma == pytest.approx(60.0)
    assert error.rms_sigma == pytest.approx(error.rms / 0.05)
    assert error.shown(0.44704) == "1 mph"


@given(st.floats(-100, 100), st.integers(2, 500))
def test_a_constant_difference_is_rms_mean_and_peak_alike(gap: float, count: int) -> None:
    pair = Pair("tractor_vx_mps", TIME[:count], MEASURED[:count], MEASURED[:count] + gap)
    error = channel_error(pair, "speed", None)
    assert error.rms == pytest.approx(abs(gap), abs=1e-9)
    assert error.mean == pytest.approx(gap, abs=1e-9)
    assert error.peak == pytest.approx(gap, abs=1e-9)
    assert error.rms_sigma is None


def test_a_channel_that_only_shows_its_noise_is_not_rated() -> None:
    noise = np.random.default_rng(5).normal(scale=0.1, size=TIME.size)
    noisy = Pair("tractor_vy_mps", TIME, noise, np.zeros_like(TIME))
    assert channel_error(noisy, "", Sigma(0.1, "stated")).rating is None
    assert channel_error(noisy, "", Sigma(0.01, "stated")).rating is not None
    level = Pair("tractor_vy_mps", TIME, np.ones_like(TIME), np.zeros_like(TIME))
    assert channel_error(level, "", None).rating is None


def test_a_computed_record_that_hardly_moves_has_neither_rating_nor_lag() -> None:
    """A tenth of a degree a second is less than the noise of a gyro lets anybody see."""
    swing = np.radians(0.1) * np.sin(TIME)
    late = np.radians(0.1) * np.sin(TIME - 0.5)
    error = channel_error(Pair("trailer_yaw_rate_radps", TIME, late, swing), "", None)
    assert (error.rating, error.lag_s) == (None, None)
    wide = channel_error(Pair("trailer_yaw_rate_radps", TIME, 30 * late, 30 * swing), "", None)
    assert wide.rating is not None
    assert wide.lag_s == pytest.approx(0.5, abs=0.01)


def test_an_error_that_no_instrument_resolves_is_a_perfect_match() -> None:
    """9 mm beside a path that moves sideways by 0.4 m: late by 0.05 s in numbers only."""
    across, model = 0.2 * np.sin(TIME), 0.2 * np.sin(TIME + 0.06)
    error = channel_error(Pair("tractor_across_m", TIME, across, model), "", None)
    assert error.rating is not None
    assert (error.rating.overall, error.lag_s) == (1.0, None)
    better = channel_error(Pair("tractor_across_m", TIME, across, model), "",
                           Sigma(0.001, "stated"))  # fmt: skip
    assert better.rating is not None
    assert better.rating.overall < 1.0
    assert better.lag_s == pytest.approx(0.06, abs=0.01)


def test_uneven_samples_are_rated_on_an_even_grid() -> None:
    uneven = np.sort(np.random.default_rng(7).uniform(0, 10, 600))
    pair = Pair("tractor_vx_mps", uneven, np.sin(uneven), np.sin(uneven))
    rating = channel_error(pair, "", None).rating
    assert rating is not None
    assert rating.overall == pytest.approx(1.0)


def test_a_long_record_is_rated_in_reasonable_time_at_a_coarser_grid() -> None:
    def wave(time_s: np.ndarray) -> np.ndarray:
        return np.sin(time_s**2 / 900)

    long = np.arange(0.0, 550.0, 0.01)
    pair = Pair("tractor_yaw_rate_radps", long, wave(long), wave(long - 1.0))
    rating = channel_error(pair, "", None).rating
    assert rating is not None
    assert rating.shift_s == pytest.approx(1.0, abs=0.2)


@pytest.mark.parametrize(
    ("value", "text"), [(0.0, "0"), (1234.5, "1234"), (0.01234, "0.0123"), (-15.04, "-15")]
)
def test_people_see_three_digits(value: float, text: str) -> None:
    assert shortened(value) == text
