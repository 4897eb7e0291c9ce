"""What is in force already where a hypothesis is asked about, in training and in unseen runs.

Validated with: test/diagnosis/test_support.py.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.case.driven import driven
from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.models import unseen_jobs

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Beside:
    """What is in force already, beside a hypothesis.

    Attributes:
        named: hypotheses; ``models``: of all runs with them in force.
        placed: the same for each unseen run, events at their instants there; empty where these are
            open. ``unseen``: models of these runs.
        columns: [rows, k] of the nuisances over all runs, unseen too, and ``gram``, their products;
            empty where no unseen run is asked.
        driven: what each run asks of the sheet, unseen ones last.
    """

    named: tuple[Hypothesis, ...]
    models: tuple[Floats, ...]
    placed: tuple[tuple[Hypothesis, ...], ...]
    unseen: tuple[Floats, ...]
    columns: Floats
    gram: Floats
    driven: tuple[Floats, ...]

    @staticmethod
    def of(study: Study, named: Sequence[Hypothesis], models: Sequence[Floats],
           placed: Sequence[Sequence[Hypothesis]] = ()) -> Beside:
        """With the holdout simulated; events are ``placed`` in each run of it, if known."""
        nothing: Floats = np.zeros((0, 0))
        manners, every = tuple(driven(study)), placed_in(study, named, placed)
        unseen = unseen_with(study, every)
        if not unseen:
            return Beside(tuple(named), tuple(models), every, (), nothing, nothing, manners)
        columns = np.concatenate([study.columns, *study.holdout_columns])
        gram = study.gram_of(range(len(study.runs) + len(study.holdout)))
        return Beside(tuple(named), tuple(models), every, unseen, columns, gram, manners)


def placed_in(study: Study, named: Sequence[Hypothesis],
              placed: Sequence[Sequence[Hypothesis]] = ()) -> tuple[tuple[Hypothesis, ...], ...]:
    """What is in force in each unseen run; nothing where the instant of an event is open there."""
    if any(h.effect.timed for h in named):
        return tuple(tuple(one) for one in placed)
    return (tuple(named),) * len(study.holdout)


def unseen_with(study: Study, placed: Sequence[Sequence[Hypothesis]]) -> tuple[Floats, ...]:
    """Models of the unseen runs with what :func:`placed_in` gives in force; none for nothing."""
    if any(placed):
        return tuple(unseen_models(study, placed))
    return tuple(study.holdout_models) if placed else ()


def unseen_models(study: Study, placed: Sequence[Sequence[Hypothesis]]) -> list[Floats]:
    """Models of the holdout with effects in force."""
    return study.simulate(unseen_jobs(study, study.packed, placed))
