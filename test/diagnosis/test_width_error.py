"""A fall of the sum of squares in estimated widths follows a t-law."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from truck_blowout_sim.diagnosis.fit.width_error import RUN_SCATTER, degrees_of, most_supported

TWO_SIDED_T8_AT_0_001 = 5.041  # Fisher and Yates 1963, table III
CHI2_1_AT_0_001 = 10.828  # the same, table IV


def test_a_fall_is_as_rare_as_the_t_law_says() -> None:
    assert most_supported(TWO_SIDED_T8_AT_0_001**2, 8.0) == pytest.approx(CHI2_1_AT_0_001, rel=1e-3)


def test_where_widths_are_known_the_fall_itself_is_the_support() -> None:
    assert most_supported(25.0, 1e9) == pytest.approx(25.0, rel=1e-6)


@given(st.floats(0.1, 1e6), st.integers(1, 20))
def test_estimated_widths_support_less_and_more_runs_more(fall: float, runs: int) -> None:
    here, more = (most_supported(fall, degrees_of(n)) for n in (runs, runs + 1))
    assert here < more < fall


def test_what_explains_nothing_supports_nothing() -> None:
    assert most_supported(-3.0, 8.0) == most_supported(0.0, 8.0) == 0.0


def test_widths_of_one_run_err_by_its_scatter_and_that_of_the_next() -> None:
    """Of a chi-square, divided by its degrees of freedom, the logarithm has variance 2 / n."""
    draws = np.random.default_rng(5).chisquare(4.0 * degrees_of(1), 200_000)
    assert np.var(np.log(draws)) == pytest.approx(2.0 * RUN_SCATTER**2 / 4.0, rel=0.06)
