"""What speaks for an effect when its apparent amount scatters from run to run.

No model is exact, so an amount fitted to one run alone differs from that of the next by more than
noise explains. What is missing acts in every training run alike and in no baseline run; what two
good models differ by does neither. So the residual is taken as

    r = J phi + sum_i d_i (a_i + u + A [run i is training]) + e,   a_i ~ N(0, tau^2), u ~ N(0, s^2)

with the nuisances J phi, the effect's column d_i in run i, its scatter tau, and what single trucks
stray by, s; on a tire that was lost it strays anew, and a part of s^2 is new from day to day. A
part of tau^2 is common to runs that are driven alike (`driven.py`). The likelihood ratio of A free
against A = 0 is the support; tau and its common part are integrated over a grid whose weights all
hypotheses of the case share (empirical Bayes). What acts moves the amounts of its look-alikes, too:
so a hypothesis is weighed by what all others scatter once it is in force. Where they still do, as
with a rough log or a model of another form, the same fall of the sum of squares says less. A run
that nothing explains weighs less. Of a long run each episode counts as a run.

References: Laird and Ware 1982 (random effects); DerSimonian and Laird 1986 (several studies of one
effect); Kennedy and O'Hagan 2001 (a model's error as a function of its inputs); Efron 2010, ch. 1
(empirical Bayes); Kass and Wasserman 1995 (unit information); Edwards 1972 (support); Li and Ji
2005 (how many of correlated tests are independent); Birge 1932 (widths by what is left).
Known limits: linear in the amount, at the amount fitted; a run is one sample of what models differ
by, so few runs support little; where five runs scatter much, chance is stated up to half too low;
how much of a truck's stray changes by the day is a judgement, no measurement.
Validated with: test/diagnosis/test_scatter.py (closed forms; false alarms of simulated nulls).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.stats import chi2

from truck_blowout_sim.diagnosis.algebra.independent import in_any, independent_among
from truck_blowout_sim.diagnosis.algebra.linear import Projector
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.shown import SCATTERS, Question, Shown

Floats = NDArray[np.float64]
_PRIOR_WORTH = 1.0  # hypotheses that equal weights count as: unit information
_ROUNDS = 50


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
        both = np.array([one.likelihoods for one in hypotheses]).reshape(-1, 2, SCATTERS.size)
        # as likely to act as one in all, its amount worth two parameters (Akaike 1974; judgement)
        idle = -np.log(max(len(hypotheses), 1))
        either = np.logaddexp(both[:, 0], both[:, 1] - 2.0 + idle)
        likely, weights = np.exp(either - either.max(axis=1, keepdims=True)), prior
        for _ in range(_ROUNDS):
            shares = weights * likely
            total = np.concatenate([[_PRIOR_WORTH * prior],
                                    shares / shares.sum(axis=1, keepdims=True)]).sum(axis=0)
            weights = total / total.sum()
        return Scatter(weights)

    def support(self, shown: Shown, log_choices: float = 0.0) -> float:
        """Twice the log of the likelihood ratio for the effect, any scatter allowed.

        ``log_choices``: log of how many instants the best was taken from. What scatters chose its
        own as freely, noise alone did not.
        """
        without, best = shown.likelihoods
        log = np.log(np.maximum(self.weights, 1e-300))
        idle = log + without - np.where(SCATTERS > 0.0, log_choices, 0.0)
        return float(2.0 * (np.logaddexp.reduce(log + best) - log_choices
                            - np.logaddexp.reduce(idle)))


@dataclass(frozen=True, eq=False)
class Chance:
    """What chance reaches in a search where nothing is missing.

    Attributes:
        scatter: of the case; ``independent``: how many independent hypotheses were tried.
        rate: share of such searches in which anything may be named.
        questions: what was asked, each with its hypothesis.
        further: support asked beyond chance, beside a correction or in one log (`search.py`).
    """

    scatter: Scatter
    independent: float
    rate: float
    questions: Sequence[tuple[Hypothesis, Question]] = ()
    further: float = 0.0

    def beside(self, key: tuple[str, str], change: Floats, reach: Floats, left: Floats) -> Scatter:
        """What scatters where a hypothesis acts: all other amounts, with its ``change`` removed.

        See :meth:`Question.beside`; ``left`` is what then remains of each run.
        """
        if not self.questions:
            return self.scatter
        return Scatter.of([one.beside(change, reach).shown(left)
                           for other, one in self.questions if other.key != key])

    @property
    def _questions(self) -> float:
        """At least one, also where every name was excluded."""
        return max(self.independent, 1.0)

    @property
    def asked(self) -> float:
        """Support that chance reaches in ``rate`` of the searches, and what is asked beyond it."""
        chance = float(chi2.isf(-np.expm1(np.log1p(-self.rate) / self._questions), 1))
        return chance + self.further

    @property
    def alone(self) -> Chance:
        """The same for a hypothesis that was not chosen from many."""
        return replace(self, independent=1.0)

    @property
    def asked_of_two(self) -> float:
        """Support of two hypotheses together that chance reaches in ``rate`` of the searches."""
        pairs = max(0.5 * self._questions * (self._questions - 1.0), 1.0)
        return float(chi2.isf(-np.expm1(np.log1p(-self.rate) / pairs), 2))

    def p_value(self, support: float) -> float:
        """Chance that the best of a search is supported so much where nothing is missing."""
        alone = float(chi2.sf(max(support, 0.0), 1))
        return in_any(alone, self._questions)


def independent(columns: Floats, projector: Projector) -> float:
    """How many independent questions correlated columns [rows, k] ask (Li and Ji 2005)."""
    reach = projector.reach(columns)
    return independent_among(columns.T @ columns - reach.T @ projector.solve(reach))
