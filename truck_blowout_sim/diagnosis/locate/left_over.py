"""Whether training keeps more than the same truck's baseline runs, where nothing is missing.

Two good models of one truck differ more or less, depending on the truck and on how it is driven, so
no level of what is left says that something is missing. But baseline runs show what this model
leaves of this truck. So the mean squares that each run keeps are compared by the test of
`by_chance.py`; unseen runs count with training.
Without baseline runs, training is held against the widths as they were guessed: these are what good
models of any such truck differ by. A guess errs by a factor of its own: instruments that drift and
tremble leave as much as a worse model.

References: see `by_chance.py`.
Known limits: a maneuver much harder than the baseline's leaves more, too; without baseline runs
only a gross mismatch shows.
Validated with: test/diagnosis/test_left_over.py.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve

from truck_blowout_sim.diagnosis.case.study import Study, row_ranges
from truck_blowout_sim.diagnosis.case.trust import comparable_rows
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.locate.by_chance import chance_of_any

Floats = NDArray[np.float64]
_LEAST = 1e-6
GUESSED = 1.0  # squares a row, where the widths are what two good models differ by
# Noise that lasts: of ten samples in a bin, as at 100 Hz, one to all are new.
_LASTING = np.log(10.0)
# 1 sigma of their logarithm: a guess errs by half (a judgement), and how long noise lasts is open
_GUESS = float(np.hypot(2.0 * np.log(1.5), _LASTING / np.sqrt(12.0)))
NAMING_SHARE = 0.5  # of what training keeps more than usual: what explains less is no name for it


def mean_squares(study: Study, named: Sequence[Hypothesis] = (),
                 unseen: Sequence[Floats] = ()) -> tuple[float, ...]:
    """Squares a row that each run keeps beside the (other) baseline runs, in units of the widths.

    It is what a run costs more than they do alone, its pull on the sheet's numbers included: by the
    chain rule of a Gaussian never negative, and one a row where the model is right. Of a run in
    which only training lost a tire, the rows up to then. Without baseline runs it is what the fit
    leaves, in the widths as they were guessed.

    ``unseen``: models of the unseen runs with ``named`` in force. These come last; what is missing
    acts in them, too, and nothing was fitted to them.
    """
    if not study.baseline:
        return _in_guessed_widths(study, named)
    kept, rows, residual = study.kept(named), row_ranges(study), study.residual()
    held = list(zip(study.holdout, study.holdout_columns, unseen, strict=False))
    runs = [*study.runs, *(run for run, _, _ in held)]
    columns = [*(study.columns[r] for r in rows), *(every for _, every, _ in held)]
    left = [*(residual[r] for r in rows), *(run.residual(model) for run, _, model in held)]
    seen = [comparable_rows(study, run) for run in runs]
    parts = [_Sums.of(every[:, kept] * one[:, None], rest * one)
             for every, rest, one in zip(columns, left, seen, strict=True)]
    found = []
    for i, (run, part, one) in enumerate(zip(runs, parts, seen, strict=True)):
        others = sum((parts[k] for k in study.baseline if k != i), _Sums.none(len(kept)))
        count = max(int(np.isfinite(run.measured.ravel()[one > 0.0]).sum()), 1)
        found.append(max(((others + part).chi2() - others.chi2()) / count, _LEAST))
    return tuple(found)


def _in_guessed_widths(study: Study, named: Sequence[Hypothesis]) -> tuple[float, ...]:
    left = study.projector(named).remove(study.residual())
    parts = [(run, run.color.colored(left[rows].reshape(run.measured.shape)))
             for run, rows in zip(study.runs, row_ranges(study), strict=True)]
    return tuple(max(float(np.mean(np.square(z[np.isfinite(run.measured)]))), _LEAST)
                 for run, z in parts)


@dataclass(frozen=True, eq=False)
class _Sums:
    """Of the rows of some runs: products of the nuisances' columns, with the residual, its own."""

    gram: Floats
    common: Floats
    own: float

    @staticmethod
    def of(columns: Floats, residual: Floats) -> _Sums:
        return _Sums(columns.T @ columns, columns.T @ residual, float(residual @ residual))

    @staticmethod
    def none(count: int) -> _Sums:
        return _Sums(np.zeros((count, count)), np.zeros(count), 0.0)

    def __add__(self, other: _Sums) -> _Sums:
        return _Sums(self.gram + other.gram, self.common + other.common, self.own + other.own)

    def chi2(self) -> float:
        """What the nuisances, with unit priors, leave of these rows."""
        factor = cho_factor(np.eye(self.common.size) + self.gram)
        return self.own - float(self.common @ cho_solve(factor, self.common))


def expected_squares(study: Study, squares: Sequence[float]) -> float:
    """Squares a row that a run with nothing missing keeps; one where no baseline run tells."""
    return float(np.exp(np.mean(np.log(_still(study, squares)))))


def _still(study: Study, squares: Sequence[float]) -> list[float]:
    """What baseline runs keep, or one in their stead."""
    return [squares[i] for i in study.baseline] or [GUESSED]


def excess(study: Study, squares: Sequence[float], usual: float) -> float:
    """Sum of squares that training keeps more than usual."""
    return sum((squares[i] - usual) * study.runs[i].measured.size for i in study.train)


def excess_of_all(study: Study, squares: Sequence[float], usual: float) -> float:
    """The same, of the unseen runs, too."""
    unseen = zip(study.holdout, squares[len(study.runs):], strict=False)
    return excess(study, squares, usual) + sum(
        (square - usual) * run.measured.size for run, square in unseen)


def chance_of_more(study: Study, squares: Sequence[float]) -> float:
    """Chance that training, or some runs of it, keep so much more where nothing is missing."""
    train = [squares[i] for i in study.train] + list(squares[len(study.runs):])
    return chance_of_any(train, _still(study, squares), 0.0 if study.baseline else _GUESS)


def keeps_more(study: Study, squares: Sequence[float]) -> bool:
    """Whether training keeps more than chance lets it, at its share of false alarms."""
    return chance_of_more(study, squares) <= study.settings.alarms_by_rest
