"""Linear algebra of the diagnosis: nuisances with priors are projected out, candidates scored.

With whitened residual r, nuisance columns J (prior sigma 1 each, after scaling) and a candidate
column d, the fall of chi-square that the candidate buys is (d'r*)^2 / (d'd*), where * removes what
the nuisances can explain: v* = v - J (I + J'J)^-1 J'v. This equals the score test of a Gaussian
model with the nuisances marginalised.

References: Rao's score test; Kennedy and O'Hagan 2001 for the marginalised view.
Known limits: linear; the nonlinear refit follows.
Validated with: test/diagnosis/test_linear.py (against dense marginal likelihood, null p-values).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Projector:
    """Removes from a whitened vector what nuisances with unit priors explain.

    Attributes:
        columns: [n, k] of all nuisances, each scaled by its prior sigma.
        kept: [m] which of them are removed; the matrix is large and never copied.
        factor: of their information, priors included.
    """

    columns: Floats
    kept: NDArray[np.int64]
    factor: tuple[Floats, bool]

    @staticmethod
    def of(columns: Floats, kept: Sequence[int] | None = None, gram: Floats | None = None
           ) -> Projector:
        """A projector for nuisance columns [n, k], or those of them in ``kept``.

        ``gram``: all columns' columns, if known.
        """
        gram = columns.T @ columns if gram is None else gram
        which = np.arange(columns.shape[1]) if kept is None else np.array(kept, dtype=np.int64)
        return Projector(columns, which, cho_factor(
            np.eye(which.size) + gram[np.ix_(which, which)]))

    def reach(self, matrix: Floats, rows: slice = slice(None)) -> Floats:
        """What a vector or columns over some rows have in common with each nuisance kept."""
        return np.asarray((self.columns[rows].T @ matrix)[self.kept])

    def solve(self, reach: Floats) -> Floats:
        """What :meth:`reach` gives, divided by the information on the nuisances kept."""
        return np.asarray(cho_solve(self.factor, reach))

    def amounts(self, vector: Floats) -> Floats:
        """Posterior mean of the nuisances, in prior sigmas."""
        return self.solve(self.reach(vector))

    def amounts_within(self, vector: Floats, low: Floats, high: Floats) -> Floats:
        """The same with each kept between bounds [m]: those at a bound stay, the others follow.

        One that has reached its bound is not let go again.
        """
        common, held = self.reach(vector), np.zeros(self.kept.size, dtype=np.bool_)
        found = self.solve(common)
        upper = np.triu(self.factor[0])
        information = upper.T @ upper
        while np.any(beyond := ~held & ((found < low) | (found > high))):
            held |= beyond
            found = np.clip(found, low, high)
            free = ~held
            rest = common[free] - information[np.ix_(free, held)] @ found[held]
            found[free] = np.linalg.solve(information[np.ix_(free, free)], rest)
        return found

    def explained(self, amounts: Floats) -> Floats:
        """What the nuisances kept do at these amounts, or at each column of them."""
        everything = np.zeros((self.columns.shape[1], *amounts.shape[1:]))
        everything[self.kept] = amounts
        return np.asarray(self.columns @ everything)

    def covariance(self) -> Floats:
        """Posterior covariance of the nuisances, in prior sigmas squared."""
        return self.solve(np.eye(self.kept.size))

    def remove(self, vector: Floats) -> Floats:
        """C^-1 vector, or each column of a matrix; C is noise plus marginalized nuisances."""
        return np.asarray(vector - self.explained(self.amounts(vector)))

    def information(self, columns: Floats) -> Floats:
        """Columns' C^-1 columns: what is known of amounts fitted together, nuisances removed.

        Of one vector, a number.
        """
        common = self.reach(columns)
        return np.asarray(columns.T @ columns - common.T @ self.solve(common))

    def chi2(self, vector: Floats) -> float:
        """Vector' C^-1 vector: the sum of squares left, priors included."""
        return float(self.information(vector))


@dataclass(frozen=True)
class Score:
    """What one column buys: amount (of the column), its standard error, fall of chi-square."""

    amount: float
    sigma: float
    delta: float


def score(projector: Projector, removed: Floats, column: Floats, low: float = -np.inf,
          high: float = np.inf, clean: Floats | None = None) -> Score:
    """Score of a candidate column; ``removed`` is what :meth:`Projector.remove` leaves.

    The amount is limited to [low, high]; the fall is that of the limited amount. ``clean``: what
    the projector leaves of the column, if known.
    """
    information = projector.chi2(column) if clean is None else float(column @ clean)
    if information < 1e-12:
        return Score(0.0, np.inf, 0.0)
    gradient = float(column @ removed)
    amount = float(np.clip(gradient / information, low, high))
    return Score(amount, information ** -0.5, 2.0 * amount * gradient - amount**2 * information)


def joint_score(projector: Projector, removed: Floats, columns: Floats) -> tuple[Floats, Floats]:
    """Amounts and covariance of several columns [n, k] fitted together."""
    information = projector.information(columns)
    ridge = 1e-9 * np.trace(information) / max(information.shape[0], 1)
    factor = cho_factor(information + (ridge + 1e-12) * np.eye(information.shape[0]))
    return (np.asarray(cho_solve(factor, columns.T @ removed)),
            np.asarray(cho_solve(factor, np.eye(information.shape[0]))))
