from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from truck_blowout_sim.proof.statistics import Proportion, clustered, proportion, quantile, wilson


@pytest.mark.parametrize(
    ("hits", "trials", "low", "high"),
    [(0, 10, 0.0, 0.27753), (5, 10, 0.23659, 0.76341), (10, 10, 0.72247, 1.0),
     (81, 263, 0.25526, 0.36616)],
)  # the last: R. G. Newcombe, Statistics in Medicine 17 (1998), table I, method 3
def test_wilson_interval_against_published_values(
    hits: int, trials: int, low: float, high: float
) -> None:
    assert wilson(hits, trials) == pytest.approx((low, high), abs=5e-5)


def test_interval_covers_as_often_as_it_says() -> None:
    n, p = 60, 0.3
    covered = sum(
        math.comb(n, k) * p**k * (1 - p) ** (n - k)
        for k in range(n + 1)
        if wilson(k, n)[0] <= p <= wilson(k, n)[1]
    )
    assert 0.93 < covered < 0.97


def test_what_was_not_asked_is_no_trial() -> None:
    assert proportion([True, None, False, True]) == Proportion(2, 3)
    assert Proportion(0, 0).value is None
    assert str(Proportion(0, 0)) == "–"
    assert str(Proportion(5, 10)) == "50 % (5/10; 24–76)"


@pytest.mark.parametrize(("hits", "trials"), [(1, 0), (3, 2), (-1, 4)])
def test_impossible_counts_are_refused(hits: int, trials: int) -> None:
    with pytest.raises(ValueError, match="no proportion"):
        wilson(hits, trials)


def test_trials_that_differ_inside_their_clusters_count_each() -> None:
    mixed = [(name, k < 5) for name in "abcd" for k in range(10)]
    assert clustered(mixed) == wilson(20, 40)
    assert clustered([("a", True)] * 3) == wilson(3, 3)


def test_clusters_that_are_all_or_none_count_as_one_trial_each() -> None:
    """The limit of the design effect; m / (m - 1) is the correction for few clusters."""
    blocks = [(f"{k}", k < 10) for k in range(20) for _ in range(7)]
    assert clustered(blocks) == pytest.approx(wilson(9.5, 19.0))


@given(st.lists(st.tuples(st.sampled_from("abcde"), st.booleans()), min_size=1, max_size=40))
def test_clusters_never_narrow_the_interval(trials: list[tuple[str, bool]]) -> None:
    low, high = clustered(trials)
    plain = wilson(sum(hit for _, hit in trials), len(trials))
    assert 0.0 <= low <= plain[0] + 1e-12
    assert plain[1] - 1e-12 <= high <= 1.0


def test_quantile() -> None:
    assert quantile([1.0, 2.0, 3.0, 4.0], 0.9) == pytest.approx(3.7)
    assert quantile([], 0.5) is None
