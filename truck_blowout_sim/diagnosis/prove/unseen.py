"""Drive a truck over the unseen runs: does what is to be written predict them better?

A prediction lets the numbers of the sheet follow what was named; a vehicle file has one value of
each. Only starts and mounting errors of instruments stay free.

Validated with: test/diagnosis/test_driving.py.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.fit.linear import Projector
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]
_FLAWLESS = 0.25  # of what is usually left: no prediction is better than that


@dataclass(frozen=True)
class Gain:
    """What driving one truck and not another does on unseen runs.

    Attributes:
        all_channels: log-likelihood gained, twice. The scale of each channel's error is its own:
            one that is off most does not outvote the others.
        best: logarithm by which the squares of the channel fall that gains most.
    """

    all_channels: float
    best: float


def gained(study: Study, runs: Sequence[int], before: Packed, after: Packed) -> Gain:
    """What the second truck gains over the first.

    Args:
        study: the case.
        runs: positions of the unseen runs that are asked.
        before: one truck; ``after``: the other.
    """
    least = _FLAWLESS * study.level
    gain, best = 0.0, -np.inf
    first, then = (_left(study, runs, truck) for truck in (before, after))
    for k, one, other in zip(runs, first, then, strict=True):
        count = np.isfinite(study.holdout[k].measured).sum(axis=0)
        floor = least * np.maximum(count, 1)
        fall = np.log(np.maximum(one, floor) / np.maximum(other, floor))
        gain, best = gain + float(count @ fall), max(best, float(fall.max()))
    return Gain(gain, best)


def _left(study: Study, which: Sequence[int], truck: Packed) -> list[Floats]:
    """Sum of squares that a truck leaves in each channel of some unseen runs."""
    sheet = [number.name for number in study.settings.nuisances]
    here = np.array([study.amounts.get(name, 0.0) for name in sheet])
    runs = [study.holdout[k] for k in which]
    found = []
    for k, run, model in zip(which, runs, study.simulate([(run, truck) for run in runs]),
                             strict=True):
        columns = study.holdout_columns[k]
        own = Projector.of(columns, range(len(sheet), columns.shape[1]))
        left = own.remove(run.residual(model) - columns[:, :len(sheet)] @ here)
        found.append(np.square(left.reshape(run.measured.shape)).sum(axis=0))
    return found
