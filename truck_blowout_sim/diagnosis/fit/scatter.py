"""What speaks for an effect when its apparent amount scatters from run to run.

No model is exact, so an amount fitted to one run alone differs from that of the next by more than
noise explains. What is missing acts in every training run alike and in no baseline run; what two
good models differ by does neither. So the residual is taken as

    r = J phi + sum_i d_i (a_i + u + A [run i is training]) + e,   a_i ~ N(0, tau^2), u ~ N(0, s^2)

with the nuisances J phi, the effect's column d_i in run i, its scatter tau, and what single trucks
stray by, s; on a tire that was lost it strays anew, and a part of s^2 is new from day to day. A
part of tau^2 is common to runs that are driven alike (`driven.py`). The likelihood ratio of A free
against A = 0 is the support; tau and its common part are integrated over a grid whose weights all
hypotheses of the case share (empirical Bayes). Where runs scatter much, as with a rough log or a
model of another form, the same fall of the sum of squares says less. A run that nothing explains
weighs less. Of a long run each episode counts as a run.

References: Laird and Ware 1982 (random effects); DerSimonian and Laird 1986 (several studies of one
effect); Kennedy and O'Hagan 2001 (a model's error as a function of its inputs); Efron 2010, ch. 1
(empirical Bayes); Edwards 1972 (support); Li and Ji 2005 (how many of correlated tests are
independent); Birge 1932 (widths by what is left).
Known limits: linear in the amount, at the amount fitted; a run is one sample of what models differ
by, so few runs support little; where five runs scatter much, chance is stated up to half too low;
how much of a truck's stray changes by the day is a judgement, no measurement.
Validated with: test/diagnosis/test_scatter.py (closed forms; false alarms of simulated nulls).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.stats import chi2

from truck_blowout_sim.diagnosis.case.runs import Run
from truck_blowout_sim.diagnosis.fit.independent import independent_among
from truck_blowout_sim.diagnosis.fit.linear import Projector

Floats = NDArray[np.float64]
# tau in standard errors of a training run, from none to more than any model is off
_SIZES: Floats = np.concatenate([[0.0], 2.0 ** np.arange(-2.0, 9.0)])
_SHARES: Floats = np.array([0.0, 0.5, 0.9])  # of tau^2 that runs have in common if driven alike
SCATTERS: Floats = np.repeat(_SIZES, _SHARES.size)
_SHARED: Floats = np.tile(_SHARES, _SIZES.size)
_ANEW = 0.25  # of the variance of single trucks: of wear, warmth and load, which change by the day
_WRONG_SHEETS = 0.1  # of its numbers
_PRIOR_WORTH = 5.0  # hypotheses that equal weights count as
_ROUNDS = 50
_DIM = 1e-4  # of what the clearest training run shows of an effect: less is nothing


@dataclass(frozen=True, eq=False)
class Part:
    """An effect's column in one run, or one episode of a long one.

    Attributes:
        rows: where; ``column``: over these, per unit of the amount.
        trained: whether the effect may act in the run; ``blown``: whether a tire was lost in it.
        driven: unit vector, what the run asks of the sheet; None: unlike every other.
    """

    rows: slice
    column: Floats
    trained: bool
    blown: bool = False
    driven: Floats | None = None

    @property
    def strength(self) -> float:
        """Sum of its squares."""
        return float(self.column @ self.column)

    def weight(self, left: Floats) -> float:
        """1, less where the run is left with more than its widths allow (Birge 1932)."""
        return 1.0 / max(float(np.mean(np.square(left[self.rows]))), 1.0)


def parts_of(run: Run, first: int, column: Floats, trained: bool, least_s: float,
             driven: Floats | None = None) -> list[Part]:
    """What a hypothesis changes in a run whose rows begin at ``first``, a part for each episode.

    ``column`` is over the rows of the run.
    """
    return [Part(rows, column[rows.start - first:rows.stop - first], trained, run.has_blowout,
                 driven)
            for rows in run.episodes(first, least_s)]


@dataclass(frozen=True, eq=False)
class Shown:
    """What each run shows of one amount, the nuisances marginalized.

    Attributes:
        information: [n, n] d_i' C^-1 d_j; ``gradient``: [n] d_i' C^-1 r.
        trained: [n] 1 where the effect may act, else 0.
        alike: [n, n] 1 where two runs share what the truck strays by, else 0.
        likeness: [n, n] how alike two runs were driven, from 0 to 1.
        strays: 1 sigma by which single trucks differ in this amount, and, one in ten, where the
            sheet is wrong.
        bounds: between which the amount lies.
    """

    information: Floats
    gradient: Floats
    trained: Floats
    alike: Floats
    likeness: Floats
    strays: tuple[float, ...] = (0.0,)
    bounds: tuple[float, float] = (-np.inf, np.inf)

    @staticmethod
    def of(projector: Projector, removed: Floats, parts: Sequence[Part],
           strays: tuple[float, ...] = (0.0,), bounds: tuple[float, float] = (-np.inf, np.inf),
           left: Floats | None = None) -> Shown | None:
        """From each run's part of the effect's column; None where no training run shows it.

        ``removed``: what :meth:`Projector.remove` leaves of the residual, ``left`` of what the
        effect at its best leaves of it.
        """
        clearest = max((part.strength for part in parts if part.trained), default=0.0)
        kept = [part for part in parts if part.strength > _DIM * clearest]
        if clearest <= 0.0:
            return None
        reach = np.stack([projector.reach(part.column, part.rows) for part in kept], axis=1)
        information = np.diag([p.strength for p in kept]) - reach.T @ projector.solve(reach)
        gradient = np.array([float(p.column @ removed[p.rows]) for p in kept])
        weight = np.array([1.0 if left is None else p.weight(left) for p in kept])
        return Shown(information * np.sqrt(np.outer(weight, weight)), gradient * weight,
                     np.array([float(part.trained) for part in kept]), _alike(kept),
                     _likeness(kept), strays, bounds)

    @property
    def same_day(self) -> Floats:
        """[n, n] 1 where both runs are baseline or neither is: these may be of another day."""
        return np.asarray(np.equal.outer(self.trained, self.trained), dtype=np.float64)

    @cached_property
    def likelihoods(self) -> tuple[Floats, Floats]:
        """Log-likelihoods [k] for each scatter, without the effect and at its best amount."""
        chance = np.log([1.0, _WRONG_SHEETS][:len(self.strays)])
        both = [[more + part for part in self._likelihood(stray)]
                for more, stray in zip(chance, self.strays, strict=True)]
        without, best = np.logaddexp.reduce(np.array(both), axis=0)
        return without, best

    def _likelihood(self, stray: float) -> tuple[Floats, Floats]:
        """Log-likelihoods [k] for each scatter and one stray."""
        trained, n = self.trained, self.trained.size
        scale = trained.sum() / max(float(np.diag(self.information) @ trained), 1e-12)
        shared = _SHARED[:, None, None]
        spread = (np.square(SCATTERS)[:, None, None] * scale
                  * ((1.0 - shared) * np.eye(n) + shared * self.likeness)
                  + self.alike * (stray**2 - (1.0 - self.same_day) * _ANEW * self.strays[0]**2))
        widened = np.eye(n) + self.information @ spread
        taken = spread @ np.linalg.inv(widened)
        common = self.information @ trained
        slope = trained @ self.gradient - (common @ taken) @ self.gradient
        bend = np.maximum(trained @ common - (common @ taken) @ common, 1e-12)
        without = 0.5 * ((self.gradient @ taken) @ self.gradient - np.linalg.slogdet(widened)[1])
        amount = np.clip(slope / bend, *self.bounds)
        return without, without + amount * slope - 0.5 * np.square(amount) * bend


def _alike(parts: Sequence[Part]) -> Floats:
    """1 where both runs lost a tire, or neither did."""
    blown = np.array([part.blown for part in parts])
    return np.asarray(blown[:, None] == blown, dtype=np.float64)


def _likeness(parts: Sequence[Part]) -> Floats:
    """Cosines between what the runs ask of the sheet; 1 with itself."""
    found = np.eye(len(parts))
    for i, one in enumerate(parts):
        for j, other in enumerate(parts[:i]):
            if one.driven is not None and other.driven is not None:
                found[i, j] = found[j, i] = float(one.driven @ other.driven)
    return found


@dataclass(frozen=True, eq=False)
class Scatter:
    """How likely each scatter is in a case.

    Attributes:
        weights: [k] that sum to 1.
    """

    weights: Floats

    @staticmethod
    def of(hypotheses: Sequence[Shown]) -> Scatter:
        """Weights that a case's hypotheses share, most of them taken to be idle."""
        prior = np.full(SCATTERS.size, 1.0 / SCATTERS.size)
        weights, idle = prior, -np.log(max(len(hypotheses), 1))
        pairs = [one.likelihoods for one in hypotheses]
        for _ in range(_ROUNDS):
            total = _PRIOR_WORTH * prior
            for without, best in pairs:
                # as likely to act as one in all, its amount worth two parameters (Akaike 1974)
                either = np.logaddexp(without, best - 2.0 + idle)
                share = weights * np.exp(either - either.max())
                total = total + share / share.sum()
            weights = total / total.sum()
        return Scatter(weights)

    def support(self, shown: Shown) -> float:
        """Twice the log of the likelihood ratio for the effect, any scatter allowed."""
        without, best = shown.likelihoods
        log = np.log(np.maximum(self.weights, 1e-300))
        return float(2.0 * (np.logaddexp.reduce(log + best) - np.logaddexp.reduce(log + without)))


@dataclass(frozen=True, eq=False)
class Chance:
    """What chance reaches in a search where nothing is missing.

    Attributes:
        scatter: of the case; ``independent``: how many independent hypotheses were tried.
        rate: share of such searches in which anything may be named.
    """

    scatter: Scatter
    independent: float
    rate: float

    @property
    def asked(self) -> float:
        """Support that chance reaches in ``rate`` of the searches."""
        return float(chi2.isf(-np.expm1(np.log1p(-self.rate) / self.independent), 1))

    def p_value(self, support: float) -> float:
        """Chance that the best of a search is supported so much where nothing is missing."""
        alone = float(chi2.sf(max(support, 0.0), 1))
        return float(-np.expm1(self.independent * np.log1p(-min(alone, 1.0 - 1e-15))))


def independent(columns: Floats, projector: Projector) -> float:
    """How many independent questions correlated columns [rows, k] ask (Li and Ji 2005)."""
    reach = projector.reach(columns)
    return independent_among(columns.T @ columns - reach.T @ projector.solve(reach))
