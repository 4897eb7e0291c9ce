"""Support of an effect whose apparent amount scatters from run to run."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest
from scipy.stats import chi2

from truck_blowout_sim.diagnosis.algebra.linear import Projector
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.scatter import Chance, Scatter, independent
from truck_blowout_sim.diagnosis.fit.shown import SCATTERS, Part, Question, Shown

ROLES = np.array([1.0, 1.0, 1.0, 0.0, 0.0])  # three training runs, two baseline runs
CERTAIN = Scatter(np.eye(SCATTERS.size)[0])  # no scatter at all


def shown(amounts: np.ndarray, sigma: float = 0.1, strays: tuple[float, ...] = (0.0,)) -> Shown:
    """Runs that show independent amounts, each with the same standard error."""
    information = np.eye(amounts.size) / sigma**2
    alike = np.ones((amounts.size, amounts.size))
    return Shown(information, information @ amounts, ROLES[:amounts.size], alike,
                 np.eye(amounts.size), strays)


def test_without_scatter_the_support_is_the_fall_of_the_sum_of_squares() -> None:
    """Closed form: the squared sum of the gradient over the information, training runs only."""
    amounts = np.array([0.3, 0.5, 0.4, 0.0, 0.1])
    assert CERTAIN.support(shown(amounts)) == pytest.approx(3 * 0.4**2 / 0.1**2)


def test_the_same_mean_is_supported_less_where_runs_scatter() -> None:
    """Three runs that agree say more than one that shows all of it."""
    cases = [shown(np.array(a)) for a in ([0.4, 0.4, 0.4, 0.0, 0.0], [1.2, 0.0, 0.0, 0.0, 0.0])]
    scatter = Scatter.of(cases)
    agree, one = (scatter.support(case) for case in cases)
    assert CERTAIN.support(cases[0]) == pytest.approx(CERTAIN.support(cases[1]))
    assert agree > 3.0 * one


def test_what_baseline_runs_show_too_is_the_truck() -> None:
    """A truck that strays from its sheet strays in every run."""
    everywhere, here = np.full(5, 1.2), np.array([1.2, 1.2, 1.2, 0.0, 0.0])
    assert CERTAIN.support(shown(here, strays=(0.3,))) > 15.0
    assert CERTAIN.support(shown(everywhere, strays=(0.3,))) < 8.0


def test_a_truck_is_not_the_same_from_day_to_day() -> None:
    """Baseline runs of another day leave open half of what trucks of a kind differ by."""
    for amount, known in ((0.3, False), (1.5, True)):
        here = np.array([amount, amount, amount, 0.0, 0.0])
        assert (CERTAIN.support(shown(here, sigma=0.01, strays=(0.3,))) > 11.0) is known


def test_runs_driven_alike_say_the_same_twice() -> None:
    """What a model is off by in one maneuver it is off by again: no second witness."""
    half = np.zeros(SCATTERS.size)
    half[13] = 1.0  # tau of two standard errors, half of it shared by runs driven alike
    own = shown(np.array([0.5, 0.5, 0.5, 0.0, 0.0]))
    alike = np.eye(5)
    alike[:3, :3] = 1.0
    witnesses, echoes = Scatter(half).support(own), Scatter(half).support(
        replace(own, likeness=alike))
    assert witnesses > 1.5 * echoes


def test_without_baseline_a_truck_may_stray() -> None:
    """Twice what trucks of a kind differ by is no finding, ten times is, but where a sheet errs."""
    usual, sheet = ([CERTAIN.support(shown(np.full(3, k * 0.2), sigma=0.01, strays=strays))
                     for k in (2.0, 10.0)] for strays in ((0.2,), (0.2, 0.8)))
    assert usual == pytest.approx([4.0, 100.0], rel=0.01)
    assert sheet[0] < 4.0
    assert 4.0 < sheet[1] < 20.0


def test_a_free_instant_costs_against_noise_and_not_against_scatter() -> None:
    """What a model is off by chose its instants as freely as the event did."""
    own = shown(np.array([0.4, 0.4, 0.4, 0.0, 0.0]))
    cost = 2.0 * np.log(400.0)
    assert CERTAIN.support(own, np.log(400.0)) == pytest.approx(CERTAIN.support(own) - cost)
    scattered = np.zeros(SCATTERS.size)
    scattered[-1] = 1.0
    certain = Scatter(scattered)
    assert certain.support(own, np.log(400.0)) == pytest.approx(certain.support(own))


def test_an_amount_beyond_its_bounds_is_not_supported() -> None:
    """A tire cannot have less than no loss of grip."""
    free = shown(np.full(5, -0.4) * ROLES)
    bounded = replace(free, bounds=(0.0, 1.0))
    assert CERTAIN.support(free) > 30.0
    assert CERTAIN.support(bounded) == pytest.approx(0.0)


@pytest.mark.parametrize("spread", [0.0, 0.3, 2.0])
def test_chance_is_stated_about_right_where_nothing_is_missing(spread: float) -> None:
    """12 idle hypotheses, five runs, any scatter: at most twice the stated false alarms."""
    rng, found = np.random.default_rng(5), []
    for _ in range(400):
        cases = [shown(rng.normal(0.0, np.hypot(0.1, spread), 5)) for _ in range(12)]
        chance = Chance(Scatter.of(cases), 12.0, 0.02)
        found.append(chance.p_value(max(chance.scatter.support(one) for one in cases)))
    for stated in (0.02, 0.1, 0.5):
        assert np.mean(np.array(found) < stated) < 2.0 * stated + 0.01
    assert 0.3 < np.median(found) < 0.7


def written_out(hypotheses: Sequence[Shown]) -> np.ndarray:
    """Shares of the weights, one hypothesis after the other."""
    prior = np.full(SCATTERS.size, 1.0 / SCATTERS.size)
    weights, idle = prior, -np.log(max(len(hypotheses), 1))
    for _ in range(50):
        total = prior
        for one in hypotheses:
            without, best = one.likelihoods
            either = np.logaddexp(without, best - 2.0 + idle)
            share = weights * np.exp(either - either.max())
            total = total + share / share.sum()
        weights = total / total.sum()
    return weights


@pytest.mark.parametrize("hypotheses", [0, 1, 2, 9, 150])
def test_all_hypotheses_at_once_weigh_as_one_after_the_other(hypotheses: int) -> None:
    """To the last bit: a verdict may hang on a support that is just enough."""
    rng = np.random.default_rng(hypotheses)
    cases = [shown(rng.normal(0.0, size, 5), strays=(stray,)) for size, stray in zip(
        rng.choice([0.1, 1.0, 5.0], hypotheses), rng.choice([0.0, 0.3], hypotheses), strict=True)]
    np.testing.assert_array_equal(Scatter.of(cases).weights, written_out(cases))


def test_chance_asks_for_more_where_more_is_tried() -> None:
    """One hypothesis: the quantile of a squared normal; a hundred: of the largest of them."""
    one, many = (Chance(CERTAIN, n, 0.02) for n in (1.0, 100.0))
    assert one.asked == pytest.approx(chi2.isf(0.02, 1))
    assert many.asked == pytest.approx(chi2.isf(-np.expm1(np.log(0.98) / 100.0), 1))
    assert many.p_value(many.asked) == pytest.approx(0.02)
    assert many.p_value(0.0) == pytest.approx(1.0)
    none = Chance(CERTAIN, 0.0, 0.02)  # every name was excluded
    assert (none.asked, none.p_value(0.0)) == (one.asked, one.p_value(0.0))
    # two amounts of 4950 pairs: the square of two white numbers exceeds x with exp(-x/2)
    assert many.asked_of_two == pytest.approx(-2.0 * np.log(-np.expm1(np.log(0.98) / 4950.0)))


def test_a_further_cause_is_asked_for_more_than_chance() -> None:
    one, more = Chance(CERTAIN, 20.0, 0.02), Chance(CERTAIN, 20.0, 0.02, further=6.0)
    assert more.asked == pytest.approx(one.asked + 6.0)
    assert more.p_value(15.0) == one.p_value(15.0)


def test_alike_columns_ask_one_question() -> None:
    """Twins count once, strangers each."""
    rng = np.random.default_rng(2)
    columns, nuisances = rng.normal(size=(4000, 6)), Projector.of(rng.normal(size=(4000, 3)))
    assert independent(columns, nuisances) == pytest.approx(6.0, abs=0.7)
    assert independent(np.repeat(columns[:, :1], 6, axis=1), nuisances) == pytest.approx(1.0)


def test_where_a_tire_is_lost_a_truck_strays_anew() -> None:
    """Baseline runs on sound tires do not say how the truck strays from its model on a flat one."""
    projector, ones = Projector.of(np.zeros((50, 1))), np.ones(10)
    residual = np.repeat([1.0, 1.0, 1.0, 0.0, 0.0], 10)

    def support(blown: bool) -> float:
        parts = [Part(slice(10 * k, 10 * k + 10), ones, k < 3, blown and k < 3) for k in range(5)]
        found = Shown.of(projector, residual, parts, strays=(0.5,))
        assert found is not None
        return CERTAIN.support(found)
    assert support(blown=False) > 5.0
    assert support(blown=True) < 4.0


def test_what_one_effect_moves_is_no_scatter_of_the_others() -> None:
    """Columns that look alike: the one that is there explains what the others seem to scatter."""
    rng = np.random.default_rng(7)
    own = rng.normal(size=60)
    alike = [0.7 * own + 0.3 * rng.normal(size=60) for _ in range(20)]
    acting = np.arange(60) < 40  # two training runs of three
    residual = rng.normal(size=60) + 12.0 * own * acting
    projector = Projector.of(np.zeros((60, 1)))

    def question(column: np.ndarray, left: np.ndarray) -> Question:
        parts = [Part(slice(20 * k, 20 * k + 20), column[20 * k:20 * k + 20], k < 2)
                 for k in range(3)]
        found = Question.of(projector, left, parts, (0.0,), (-np.inf, np.inf))
        assert found is not None
        return found

    def named(name: str, place: str = "") -> Hypothesis:
        return cast(Hypothesis, SimpleNamespace(key=(name, place)))

    asked = [(named("other", str(k)), question(one, residual)) for k, one in enumerate(alike)]
    truth = question(own, residual)
    at_first = Scatter.of([one.shown(None) for _, one in asked] + [truth.shown(None)])
    change = 12.0 * own * acting
    chance = Chance(at_first, 5.0, 0.02, (*asked, (named("own"), truth)))
    beside = chance.beside(("own", ""), change, np.zeros(1), residual - change)
    afresh = Scatter.of([question(one, residual - change).shown(residual - change)
                         for one in alike])
    np.testing.assert_allclose(beside.weights, afresh.weights, atol=1e-9)
    assert beside.support(truth.shown(None)) > at_first.support(truth.shown(None)) + 3.0
