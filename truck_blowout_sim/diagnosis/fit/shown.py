"""What each run shows of the amount of one effect, and how likely that is for each scatter.

The likelihood of `scatter.py`, with the nuisances marginalized. A question that was asked once can
be asked again where another effect is in force, without another simulation.

References: see `scatter.py`; Birge 1932 (widths by what is left).
Known limits: see `scatter.py`.
Validated with: test/diagnosis/test_shown.py (dense Gaussian), test_scatter.py (closed forms).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.algebra.linear import Projector
from truck_blowout_sim.diagnosis.case.runs import Run

Floats = NDArray[np.float64]
# tau in standard errors of a training run, from none to more than any model is off
_SIZES: Floats = np.concatenate([[0.0], 2.0 ** np.arange(-2.0, 9.0)])
_SHARES: Floats = np.array([0.0, 0.5, 0.9])  # of tau^2 that runs have in common if driven alike
SCATTERS: Floats = np.repeat(_SIZES, _SHARES.size)
_SHARED: Floats = np.tile(_SHARES, _SIZES.size)
_ANEW = 0.25  # of the variance of single trucks: of wear, warmth and load, which change by the day
WRONG_SHEETS = 0.1  # of the numbers: see `Shown.strays`
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
        question = Question.of(projector, removed, parts, strays, bounds)
        return None if question is None else question.shown(left)

    @property
    def same_day(self) -> Floats:
        """[n, n] 1 where both runs are baseline or neither is: these may be of another day."""
        return np.asarray(np.equal.outer(self.trained, self.trained), dtype=np.float64)

    @cached_property
    def likelihoods(self) -> tuple[Floats, Floats]:
        """Log-likelihoods [k] for each scatter, without the effect and at its best amount."""
        chance = np.log([1.0 - WRONG_SHEETS, WRONG_SHEETS] if len(self.strays) > 1 else [1.0])
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


@dataclass(frozen=True, eq=False)
class Question:
    """What is asked of the runs for one amount, so that it can be asked again beside an effect.

    Attributes:
        projector: of the nuisances; ``parts``: the effect's column in each run that shows it.
        solved: [m, n] what the nuisances do in these parts, see :meth:`Projector.solve`.
        information, gradient: as :class:`Shown`, every run with its full weight.
        trained, alike, likeness, strays, bounds: as :class:`Shown`.
    """

    projector: Projector
    parts: tuple[Part, ...]
    solved: Floats
    information: Floats
    gradient: Floats
    trained: Floats
    alike: Floats
    likeness: Floats
    strays: tuple[float, ...]
    bounds: tuple[float, float]

    @staticmethod
    def of(projector: Projector, removed: Floats, parts: Sequence[Part],
           strays: tuple[float, ...], bounds: tuple[float, float]) -> Question | None:
        """None where no training run shows the effect."""
        clearest = max((part.strength for part in parts if part.trained), default=0.0)
        kept = tuple(part for part in parts if part.strength > _DIM * clearest)
        if clearest <= 0.0:
            return None
        reach = np.stack([projector.reach(part.column, part.rows) for part in kept], axis=1)
        solved = projector.solve(reach)
        return Question(projector, kept, solved,
                        np.diag([p.strength for p in kept]) - reach.T @ solved,
                        np.array([float(p.column @ removed[p.rows]) for p in kept]),
                        np.array([float(part.trained) for part in kept]), _alike(kept),
                        _likeness(kept), strays, bounds)

    def shown(self, left: Floats | None) -> Shown:
        """The answers, of runs weighed by what is ``left`` of them."""
        weight = np.array([1.0 if left is None else p.weight(left) for p in self.parts])
        return Shown(self.information * np.sqrt(np.outer(weight, weight)), self.gradient * weight,
                     self.trained, self.alike, self.likeness, self.strays, self.bounds)

    def beside(self, change: Floats, reach: Floats) -> Question:
        """The same question where something else changes the runs.

        ``change``: [rows] by how much; ``reach``: [all nuisances] its products with these.
        """
        own = np.array([float(p.column @ change[p.rows]) for p in self.parts])
        return replace(self, gradient=self.gradient - own
                       + self.solved.T @ reach[self.projector.kept])


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
