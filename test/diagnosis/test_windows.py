"""An event must stand out of what its force seems to do at all other times."""

from __future__ import annotations

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.effects.base import Timing
from truck_blowout_sim.diagnosis.fit.windows import Windows

SECONDS = 14
RUNS = 5  # the first two are training


def windows(amounts: np.ndarray, sigma: float = 0.5, timing: Timing = "pulse", ambient: float = 0.5,
            low: float = -40.0, unseen: int = 0) -> Windows:
    """Seconds [runs, seconds] that show independent amounts, with the same standard error."""
    runs, seconds = amounts.shape
    information = np.eye(amounts.size) / sigma**2
    run = np.repeat(np.arange(runs), seconds)
    return Windows(information, information @ amounts.ravel(), run,
                   np.tile(np.arange(float(seconds)), runs), run < 2, run >= runs - unseen,
                   timing, (low, 40.0), ambient, 10.0)


def noise(rng: np.random.Generator, size: float, length_s: float = 0.0) -> np.ndarray:
    """Apparent amounts of a model of another form, and of the instruments."""
    apart = np.abs(np.subtract.outer(np.arange(SECONDS), np.arange(SECONDS)))
    root = np.linalg.cholesky(np.exp(-apart / length_s) if length_s else np.eye(SECONDS))
    return size * rng.normal(size=(RUNS, SECONDS)) @ root.T + rng.normal(0.0, 0.5, (RUNS, SECONDS))


def gust(amounts: np.ndarray, strength: float) -> np.ndarray:
    """The same with three seconds of wind in both training runs, at other instants."""
    moved = amounts.copy()
    moved[0, 4:7] += strength
    moved[1, 8:11] += strength
    return moved


@pytest.mark.parametrize(("size", "length_s"), [(0.0, 0.0), (2.0, 0.0), (2.0, 3.0), (2.0, 20.0)])
def test_a_restless_force_is_no_event(size: float, length_s: float) -> None:
    """Beyond 2 ln k in less than one of k cases, whatever the force does, and little on average."""
    rng = np.random.default_rng(4)
    found = np.array([windows(noise(rng, size, length_s)).support() for _ in range(50)])
    assert np.mean(found > 2.0 * np.log(50.0)) <= 0.05
    assert np.median(found) < 0.0


def test_one_run_that_the_model_is_worst_at_shows_no_event() -> None:
    """Its force wanders, and calm runs elsewhere say nothing about it."""
    rng = np.random.default_rng(13)
    found = []
    for _ in range(50):
        amounts = noise(rng, 0.3)
        amounts[0] += noise(rng, 8.0, 3.0)[0]
        found.append(windows(amounts, timing="step").support())
    assert np.mean(np.array(found) > 2.0 * np.log(50.0)) <= 0.05


def test_a_baseline_run_that_the_model_is_worst_at_hides_no_event() -> None:
    rng = np.random.default_rng(14)
    amounts = gust(noise(rng, 0.3), 4.0)
    amounts[3] += noise(rng, 8.0, 3.0)[3]
    assert windows(amounts).support() > 20.0


def test_a_gust_stands_out_of_a_calm_force_and_not_of_a_wild_one() -> None:
    rng = np.random.default_rng(5)
    calm, wild = noise(rng, 0.5), noise(rng, 8.0)
    assert windows(gust(calm, 8.0)).support() > 20.0
    assert windows(gust(wild, 8.0)).support() < 5.0


def test_wind_of_everyday_size_is_no_finding() -> None:
    """However well it shows."""
    rng = np.random.default_rng(6)
    clear = gust(0.1 * noise(rng, 0.0), 3.0)
    assert windows(clear, sigma=0.05, ambient=0.2).support() > 20.0
    assert windows(clear, sigma=0.05, ambient=2.0).support() < 5.0


def test_what_acts_all_the_time_is_no_event() -> None:
    """Nor what baseline runs show as well."""
    rng = np.random.default_rng(7)
    steady = noise(rng, 0.5)
    steady[:2] += 8.0
    assert windows(steady, timing="step").support() < 5.0
    lasting = noise(rng, 0.5)
    lasting[0, 5:] += 8.0
    lasting[1, 9:] += 8.0
    assert windows(lasting, timing="step").support() > 20.0


def test_what_creeps_aside_is_found_as_a_ramp() -> None:
    rng = np.random.default_rng(9)
    creeping = noise(rng, 0.5)
    for run, first in ((0, 4), (1, 6)):
        creeping[run, first:] += 8.0 * np.clip(np.arange(SECONDS - first) / 4.0, 0.0, 1.0)
    ramp, step = (windows(creeping, timing=timing).support() for timing in ("ramp", "step"))
    assert ramp > 20.0
    assert ramp > step


def test_an_amount_beyond_its_bounds_is_no_event() -> None:
    rng = np.random.default_rng(8)
    assert windows(gust(noise(rng, 0.5), -8.0), low=-0.1).support() < 3.0


def test_where_nothing_shows_the_force_nothing_is_said() -> None:
    blind = windows(np.zeros((RUNS, SECONDS)), sigma=1e9)
    assert blind.support() < 1.0
    empty = Windows(np.zeros((2, 2)), np.zeros(2), np.array([0, 1]), np.zeros(2),
                    np.array([True, False]), np.array([False, False]), "step", (-1.0, 1.0), 0.1,
                    0.5)
    assert empty.support() == 0.0


def test_the_clearest_event_is_supported_most() -> None:
    """With it, the force is calm; without it, only a wild one explains the runs."""
    rng = np.random.default_rng(12)
    calm = noise(rng, 1.0)
    found = [windows(gust(calm, strength)).support() for strength in (3.0, 4.0, 6.0, 9.0)]
    assert (np.diff(found) > 5.0).all()


def test_an_unseen_run_with_the_event_supports_it_and_one_without_costs_little() -> None:
    """At most ln 4 a run; the amount must be that of training."""
    changes = []
    for seed in range(8):
        faint = gust(noise(np.random.default_rng(seed), 1.0), 4.0)
        with_it, other = faint.copy(), faint.copy()
        for run, first in ((3, 5), (4, 9)):
            with_it[run, first:first + 3] += 4.0
            other[run, first:first + 3] -= 4.0
        trained = windows(faint[:3]).support()
        changes.append([windows(one, unseen=2).support() - trained
                        for one in (faint, with_it, other)])
    without, acting, opposite = np.transpose(changes)
    assert without.min() > -2.0 * np.log(4.0) - 0.5
    assert np.mean(acting) > 8.0
    assert np.mean(opposite) < 0.0


@pytest.mark.parametrize(("size", "length_s", "at_most"), [
    (0.0, 0.0, 0.05), (2.0, 0.0, 0.05), (2.0, 3.0, 0.05), (2.0, 20.0, 0.1)])
def test_unseen_runs_make_no_event_of_a_restless_force(size: float, length_s: float,
                                                       at_most: float) -> None:
    """Of one that wanders for longer than a run lasts a little more often."""
    rng = np.random.default_rng(11)
    found = np.array([windows(noise(rng, size, length_s), unseen=2).support() for _ in range(50)])
    assert np.mean(found > 2.0 * np.log(50.0)) <= at_most
    assert np.median(found) < 0.0


def long_log(rng: np.random.Generator, wander: float, step: float = 0.0) -> Windows:
    """Ten minutes twice, seen every 6 s: a force that wanders so far in a minute, and a step."""
    count, apart_s = 100, 6.0
    amounts = wander * np.sqrt(apart_s / 60.0) * rng.normal(size=(2, count)).cumsum(axis=1)
    amounts += rng.normal(0.0, 0.5, (2, count))
    amounts[:, 50:] += step
    run, information = np.repeat([0, 1], count), np.eye(2 * count) / 0.25
    return Windows(information, information @ amounts.ravel(), run,
                   np.tile(apart_s * np.arange(count), 2), run < 1, run >= 1, "step", (-40.0, 40.0),
                   0.5, 10.0)


def test_an_instrument_that_drifts_through_a_long_log_shows_no_event() -> None:
    rng = np.random.default_rng(3)
    found = np.array([long_log(rng, 1.0).support() for _ in range(8)])
    assert found.max() < 2.0 * np.log(50.0)
    assert np.median(found) < 0.0
    assert long_log(rng, 0.5, 6.0).support() > 2.0 * np.log(1e6)
