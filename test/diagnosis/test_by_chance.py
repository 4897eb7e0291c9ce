"""Whether runs keep more than others by chance: rates, and runs that would hide one another."""

from __future__ import annotations

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.locate.by_chance import chance_of, chance_of_any, most_by_chance

CALM = (0.37, 0.38)


@pytest.mark.parametrize(("train", "baseline", "guess"), [(4, 2, 0.0), (6, 1, 0.0), (2, 1, 1.0)])
def test_chances_are_uniform_where_nothing_is_missing(train: int, baseline: int, guess: float
                                                      ) -> None:
    rng = np.random.default_rng(5)
    chances = []
    for scatter in 0.4 * np.sqrt(6.0 / rng.chisquare(6.0, 3000)):
        runs = scatter * rng.standard_normal(train + baseline)
        still = runs[train:] + guess * rng.standard_normal(baseline)
        chances.append(chance_of_any(np.exp(runs[:train]).tolist(), np.exp(still).tolist(), guess))
    for rate in (0.01, 0.1, 0.5):
        spread = np.sqrt(rate * (1.0 - rate) / len(chances))
        assert abs(np.mean(np.array(chances) <= rate) - rate) < 4.0 * spread


def test_two_runs_of_four_do_not_hide_one_another() -> None:
    assert chance_of_any((3.6, 0.4, 0.4, 0.4), CALM) < 0.002
    assert chance_of_any((3.6, 0.4, 4.0, 0.4), CALM) < 0.005
    assert chance_of((3.6, 0.4, 4.0, 0.4), CALM) > 0.05  # the mean alone does not see them


def test_order_and_level_do_not_matter() -> None:
    runs = (3.6, 0.4, 0.5, 2.0)
    assert chance_of_any(runs, CALM) == chance_of_any(runs[::-1], CALM[::-1])
    assert chance_of_any([7.0 * one for one in runs], [7.0 * one for one in CALM]
                         ) == pytest.approx(chance_of_any(runs, CALM), rel=1e-3)


def test_more_is_rarer_also_beyond_what_was_simulated() -> None:
    chances = [chance_of_any((more, 1.1 * more), CALM) for more in (0.4, 1.0, 3.0, 30.0, 3e3, 3e6)]
    assert chances == sorted(chances, reverse=True)
    assert 0.0 < chances[-1] < 1e-7
    assert chance_of_any((0.3, 0.3), CALM) > 0.5


def test_the_most_by_chance_is_as_rare_as_asked() -> None:
    most = most_by_chance((0.5, 0.6, 0.4), CALM, 0.01)
    scale = most / np.exp(np.mean(np.log((0.5, 0.6, 0.4))))
    assert chance_of(tuple(scale * one for one in (0.5, 0.6, 0.4)), CALM) == pytest.approx(0.01)
