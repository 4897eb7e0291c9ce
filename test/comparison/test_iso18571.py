"""Scores of signals whose scores follow from the standard by hand, or from another program."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from truck_blowout_sim.comparison.iso18571 import Rating, grade, rate
from truck_blowout_sim.comparison.warp import warp_distance

TIME = np.arange(400) * 0.01
WAVE = np.sin(2 * np.pi * TIME / 1.7) * np.exp(-TIME / 3) + 0.3 * TIME


def example(n: int, late_s: float, gain: float) -> tuple[np.ndarray, np.ndarray]:
    time = np.arange(n) * 0.01

    def wave(t: np.ndarray) -> np.ndarray:
        return np.sin(2 * np.pi * t / 1.7) * np.exp(-t / 3) + 0.3 * t

    return wave(time), gain * wave(time - late_s) + 0.05 * np.sin(40 * time)


def scores(rating: Rating) -> list[float]:
    return [rating.corridor, rating.phase, rating.magnitude, rating.slope, rating.overall]


def test_the_same_signal_rates_one() -> None:
    rating = rate(WAVE, WAVE, 0.01)
    assert scores(rating) == pytest.approx([1.0] * 5, abs=1e-12)
    assert (rating.shift_s, rating.grade) == (0.0, "excellent")


# Computed with rating.py of github.com/yeonsoo-p/ISO18571, which is checked against the annex of
# the standard.
@pytest.mark.parametrize(
    ("n", "late_s", "gain", "expected"),
    [
        (400, 0.07, 1.1, [0.8465252170839446, 0.9125, 0.9464033643519306, 0.7416945350709987,
                          0.8587296667181638]),
        (900, -0.21, 0.8, [0.7487277317797498, 0.8833333333333333, 0.8248423831293437,
                           0.5345503379052423, 0.7480363035854839]),
        (250, 0.0, 1.3, [0.5924191282419065, 1.0, 0.7934925677748309, 0.7533393184351362,
                         0.7463340285387561]),
    ],
)  # fmt: skip
def test_an_independent_program_gives_the_same_scores(
    n: int, late_s: float, gain: float, expected: list[float]
) -> None:
    assert scores(rate(*example(n, late_s, gain), 0.01)) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("late", [-30, -8, 8, 30])
def test_a_shifted_signal_loses_phase_by_its_share_of_a_fifth(late: int) -> None:
    long = np.sin(np.arange(500) / 23.0) * np.exp(-np.arange(500) / 200)
    test, model = long[50:450], long[50 - late : 450 - late]
    rating = rate(test, model, 0.01)
    assert rating.shift_s == pytest.approx(late * 0.01)
    assert rating.phase == pytest.approx(1.0 - abs(late) / 80.0)
    assert rating.magnitude == pytest.approx(1.0, abs=1e-12)
    assert rating.slope == pytest.approx(1.0, abs=1e-12)


@pytest.mark.parametrize("gain", [1.2, 1.7])
def test_a_scaled_signal_loses_slope_by_its_gain(gain: float) -> None:
    rating = rate(WAVE, gain * WAVE)
    assert rating.slope == pytest.approx(1.0 - (gain - 1.0) / 2.0)
    assert rating.phase == 1.0


def test_a_scaled_ramp_loses_corridor_as_the_integral_says() -> None:
    n, gain = 20001, 1.5
    ramp = np.linspace(0.0, 1.0, n)
    # |C - T| = 0.5 x: 1 up to x = 0.1, then ((0.5 - 0.5 x) / 0.45)^2
    expected = 0.1 + (0.5 / 0.45) ** 2 * (1 - 0.1) ** 3 / 3
    assert rate(ramp[::50], gain * ramp[::50]).corridor == pytest.approx(expected, abs=5e-3)


def test_a_constant_gap_on_a_level_gives_the_magnitude_of_its_share() -> None:
    level = 100.0 + np.concatenate((np.zeros(100), np.ones(100)))
    rating = rate(level, level + 25.0)
    # no warp can help: the gap is 25 times the step
    assert rating.magnitude == pytest.approx(0.5, abs=0.006)


def test_the_opposite_signal_rates_poor() -> None:
    assert rate(np.sin(TIME * 9), -np.sin(TIME * 9)).grade == "poor"


def test_a_model_that_does_not_move_is_not_in_time() -> None:
    rating = rate(WAVE, np.zeros_like(WAVE))
    assert (rating.phase, rating.magnitude) == (0.0, 0.0)


@pytest.mark.parametrize(
    ("overall", "word"), [(0.95, "excellent"), (0.94, "good"), (0.80, "fair"), (0.58, "poor")]
)
def test_grades_end_where_the_standard_says(overall: float, word: str) -> None:
    assert grade(overall) == word


@pytest.mark.parametrize(
    ("measured", "simulated", "words"),
    [
        (np.ones(50), np.ones(50), "constant"),
        (np.arange(50.0), np.arange(49.0), "differ"),
        (np.arange(5.0), np.arange(5.0), "samples"),
        (np.arange(50.0), np.full(50, math.nan), "finite"),
    ],
)
def test_what_cannot_be_rated_is_refused(
    measured: np.ndarray, simulated: np.ndarray, words: str
) -> None:
    with pytest.raises(ValueError, match=words):
        rate(measured, simulated)


def cheapest_warp(x: np.ndarray, y: np.ndarray, window: int) -> float:
    """Least sum of squares over every warp of short signals, by exhaustive search."""
    n = x.size

    def cost(i: int, j: int) -> float:
        here = (x[i] - y[j]) ** 2
        if i == j == n - 1:
            return here
        ways = [(i + 1, j), (i, j + 1), (i + 1, j + 1)]
        allowed = [w for w in ways if max(w) < n and abs(w[0] - w[1]) < window]
        return here + min(cost(*way) for way in allowed)

    return cost(0, 0)


@given(st.lists(st.integers(-3, 3), min_size=6, max_size=6),
       st.lists(st.integers(-3, 3), min_size=6, max_size=6), st.integers(1, 6))  # fmt: skip
@settings(max_examples=60, deadline=None)
def test_the_warp_is_no_dearer_than_any_other(a: list[int], b: list[int], window: int) -> None:
    # On signals of -1, 0, 1 apart by at most one step, squares and absolute values agree.
    x, y = np.sign(np.array(a, float)), np.sign(np.array(b, float))
    x, y = (x + 1) / 2 > 0.5, (y + 1) / 2 > 0.5
    found, _ = warp_distance(x.astype(float), y.astype(float), window)
    assert found == pytest.approx(cheapest_warp(x.astype(float), y.astype(float), window))


@given(st.integers(0, 10_000))
@settings(max_examples=40, deadline=None)
def test_scores_stay_between_zero_and_one_and_scale_does_not_matter(seed: int) -> None:
    random = np.random.default_rng(seed)
    test, model = np.cumsum(random.normal(size=(2, 120)), axis=1)
    rating = rate(test, model)
    assert all(0.0 <= score <= 1.0 for score in scores(rating))
    assert scores(rate(8.0 * test, 8.0 * model)) == pytest.approx(scores(rating), abs=1e-9)
    assert scores(rate(-test, -model)) == pytest.approx(scores(rating), abs=1e-9)


def test_the_weights_add_up_to_one() -> None:
    ones = itertools.repeat(1.0, 4)
    assert Rating(*ones, shift_s=0.0).overall == pytest.approx(1.0)
