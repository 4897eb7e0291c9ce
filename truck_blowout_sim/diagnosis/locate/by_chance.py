"""Chance that some runs keep more than others of the same truck, where nothing is missing.

The logarithms of what runs keep scatter normally. Runs are few, so their scatter has a prior. What
is missing acts in all runs alike, or only in those driven as it asks for: a drag of the driveline
shows while the truck coasts. So all runs together are asked, and the worst, the two worst and so
on, as far as the rest scatter. If each were held against all others alone, two that keep more
would hide one another (masking). The smallest of all these chances is compared with what it is
where nothing is missing, by simulation.

References: Student 1908; Rosner 1983 (several outliers, without masking); Satterthwaite 1946
(degrees of freedom of a sum of variances); Gelman et al. 2013, ch. 3 (a scaled inverse chi-square
prior); Besag and Clifford 1991 (chances by simulation).
Known limits: a maneuver much harder than the baseline's keeps more, too.
Validated with: test/diagnosis/test_by_chance.py (rates of simulated nulls, two runs of four).
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.special import comb
from scipy.stats import t as student

from truck_blowout_sim.diagnosis.fit.width_error import RUN_SCATTER

Floats = NDArray[np.float64]
_RUNS = 6.0  # as many runs is the prior of their scatter worth: cases seldom have more
_DRAWS = 100_000
_BLOCK = 10_000  # of these at a time
_RESOLVED = 10  # of the draws: fewer do not say how rare something is
_SEED = 1908
_MANY = 1e300  # ways: more are no number


def most_by_chance(train: Sequence[float], baseline: Sequence[float], rate: float) -> float:
    """The most that training keeps on the geometric mean, but for a share ``rate`` of cases."""
    still = np.log(baseline)
    spread, degrees = _apart(np.log(train), still, 0.0)
    return float(np.exp(still.mean() + spread * student.isf(rate, degrees)))


def chance_of(train: Sequence[float], baseline: Sequence[float]) -> float:
    """Chance that training keeps so much on the geometric mean where nothing is missing."""
    return float(_chance_of_all(np.log(train), np.log(baseline), 0.0))


def chance_of_any(train: Sequence[float], baseline: Sequence[float], guess: float = 0.0) -> float:
    """Chance that training, or some runs of it, keep so much more where nothing is missing.

    Args:
        train: mean squares of training runs; ``baseline``: of baseline runs.
        guess: 1 sigma of the logarithm of what stands for baseline runs, where there are none.
    """
    rarest = float(_rarest(np.log(train), np.log(baseline), guess))
    usual = _rarest_by_chance(len(train), len(baseline), guess)
    as_rare = int(np.searchsorted(usual, rarest, side="right"))
    if as_rare < _RESOLVED:  # Bonferroni's bound tells how far beyond the draws it is
        return min(_RESOLVED / _DRAWS, (len(train) + 1) * rarest)
    return as_rare / _DRAWS


@lru_cache(maxsize=64)
def _rarest_by_chance(train: int, baseline: int, guess: float) -> Floats:
    """[draws] of :func:`_rarest` where nothing is missing, sorted."""
    rng = np.random.default_rng(_SEED)
    found = []
    for _ in range(_DRAWS // _BLOCK):
        scatter = RUN_SCATTER * np.sqrt(_RUNS / rng.chisquare(_RUNS, (_BLOCK, 1)))
        runs = scatter * rng.standard_normal((_BLOCK, train + baseline))
        still = runs[:, train:] + guess * rng.standard_normal((_BLOCK, baseline))
        found.append(_rarest(runs[:, :train], still, guess))
    return np.sort(np.concatenate(found))


def _rarest(train: Floats, still: Floats, guess: float) -> Floats:
    """[...] smallest chance: of all of ``train`` [..., n], or of its k worst, each by itself.

    For k runs it is multiplied by the number of ways to choose these. ``still``: [..., m].
    """
    count = train.shape[-1]
    ways = np.minimum(comb(count, np.arange(1, count + 1)), _MANY)
    worst = (ways * _chances_of_worst(train, still, guess)).min(axis=-1)
    return np.minimum(_chance_of_all(train, still, guess), worst)


def _chance_of_all(train: Floats, still: Floats, guess: float) -> Floats:
    """[...] that the mean of ``train`` is so far beyond that of ``still``."""
    spread, degrees = _apart(train, still, guess)
    return np.asarray(student.sf((train.mean(axis=-1) - still.mean(axis=-1)) / spread, degrees))


def _chances_of_worst(train: Floats, still: Floats, guess: float) -> Floats:
    """[..., n] that one run is beyond ``still`` as far as the k-th is; the k worst tell no scatter.

    The other runs do, by their number, their sum and that of their squares.
    """
    usual = still.mean(axis=-1, keepdims=True)
    beyond = np.sort(train - usual, axis=-1)[..., ::-1]
    others = np.arange(train.shape[-1])[::-1]
    square = (_sum_of_later(beyond**2)
              - _sum_of_later(beyond)**2 / np.maximum(others, 1))
    degrees = _RUNS + still.shape[-1] - 1 + np.maximum(others - 1, 0)
    own = np.sum(np.square(still - usual), axis=-1, keepdims=True)
    variance = (np.maximum(square, 0.0) + own + _RUNS * RUN_SCATTER**2) / degrees
    spread, known = _with_guess(variance * (1.0 + 1.0 / still.shape[-1]), degrees, guess)
    return np.asarray(student.sf(beyond / spread, known))


def _sum_of_later(values: Floats) -> Floats:
    """[..., n] sum of all that come after each."""
    return np.asarray(np.cumsum(values[..., ::-1], axis=-1)[..., ::-1] - values)


def _apart(train: Floats, still: Floats, guess: float) -> tuple[Floats, Floats]:
    """[...] spread of the difference of two means, and its degrees of freedom."""
    squares: Floats = np.asarray(_RUNS * RUN_SCATTER**2)
    degrees = _RUNS
    for one in (train, still):
        squares = squares + np.sum(np.square(one - one.mean(axis=-1, keepdims=True)), axis=-1)
        degrees += one.shape[-1] - 1
    means = 1.0 / train.shape[-1] + 1.0 / still.shape[-1]
    return _with_guess(squares / degrees * means, np.asarray(degrees), guess)


def _with_guess(variance: Floats, degrees: Floats, guess: float) -> tuple[Floats, Floats]:
    """Spread and degrees of freedom of an estimated variance and one that is known."""
    total = variance + guess**2
    return np.asarray(np.sqrt(total)), np.asarray(degrees * np.square(total / variance))
