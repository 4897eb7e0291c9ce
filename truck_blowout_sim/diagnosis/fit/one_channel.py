"""A change of one channel alone, as by a body that stands turned, asked of the runs like an effect.

References, known limits: see `scatter.py`.
Validated with: test/diagnosis/test_posture.py, test/diagnosis/test_lagging.py.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.stats import chi2

from truck_blowout_sim.diagnosis.algebra.linear import Projector, Score, score
from truck_blowout_sim.diagnosis.case.driven import driven
from truck_blowout_sim.diagnosis.case.runs import Run
from truck_blowout_sim.diagnosis.case.study import Study, row_ranges
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.run_weights import run_weights, weighed
from truck_blowout_sim.diagnosis.fit.scatter import Scatter
from truck_blowout_sim.diagnosis.fit.shown import Shown, parts_of

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class ChannelChange:
    """What speaks for a change of one channel in training.

    Attributes:
        score: amount, standard error and fall of the sum of squares.
        support: see :meth:`Scatter.support`; baseline runs are asked, too.
    """

    score: Score
    support: float


@dataclass(frozen=True, eq=False)
class Weighed:
    """What is left of the runs; one that nothing explains weighs less, as it shows no one channel.

    Attributes:
        size: [rows] square root of each row's weight; ``projector`` of the nuisances and
            ``removed``, what it leaves of the residual, over rows so multiplied.
    """

    size: Floats
    projector: Projector
    removed: Floats

    @staticmethod
    def of(study: Study, named: Sequence[Hypothesis]) -> Weighed:
        """Study's models have ``named`` in force."""
        plain, residual = study.projector(named), study.residual()
        weights = run_weights(study, plain, residual)
        size, projector = np.sqrt(weights), weighed(study, plain, weights)
        return Weighed(size, projector, projector.remove(residual * size))


def ask_channel(study: Study, left: Weighed, scatter: Scatter, channel: str,
                change: Callable[[Run, Floats], Floats], stray: float) -> ChannelChange | None:
    """What a change of one channel buys in training; None where no training run shows it.

    Args:
        left: of the runs, with everything named in force.
        change: by run and its bin means of the channel, what these would change by for each unit
            of the amount.
        stray: 1 sigma by which single vehicles have some of it.
    """
    projector, removed, rows = left.projector, left.removed, row_ranges(study)
    columns = [_column(run, channel, change) * left.size[rows[i]]
               for i, run in enumerate(study.runs)]
    column = study.stack({i: columns[i] for i in study.train})
    clean = projector.remove(column)
    found = score(projector, removed, column, clean=clean)
    parts = [part for i, (run, manner) in enumerate(zip(study.runs, driven(study), strict=False))
             for part in parts_of(run, rows[i].start, columns[i], i in study.train,
                                  study.settings.episode_s, manner)]
    shown = Shown.of(projector, removed, parts, (stray,), left=removed - found.amount * clean)
    return None if shown is None else ChannelChange(found, scatter.support(shown))


def score_channel(study: Study, projector: Projector, removed: Floats, channel: str,
                  change: Callable[[Run, Floats], Floats]) -> Score:
    """The first alone: what the change buys, whatever scatters."""
    return score(projector, removed, study.stack(
        {i: _column(study.runs[i], channel, change) for i in study.train}))


def asked_of(rate: float, questions: int) -> float:
    """Support that chance gives one of so many questions in a share ``rate`` of cases."""
    return float(chi2.isf(rate / max(questions, 1), 1))


def _column(run: Run, channel: str, change: Callable[[Run, Floats], Floats]) -> Floats:
    """[rows] whitened change of a run for each unit of the amount."""
    column = np.zeros(run.measured.shape)
    if channel in run.channels:
        k = run.channels.index(channel)
        column[:, k] = change(run, run.measured[:, k])
    return run.change(column, np.zeros(column.shape))
