"""Which hubs sink: wheels that turn faster from an instant on, as where a tire has lost its air.

The radius of a hub falls when a tire of it goes flat or leaves its load to its twin, and its speed
rises by as much. What is left of a hub's speed is fitted with a share of that speed from an instant
on, run by run, at each instant tried; the nuisances are projected out. This names nothing: it says
at which hubs a lost tire is worth simulating.

References: the score test of `linear.py`; a step at an unknown instant costs the logarithm of the
instants tried (Hawkins 1977).
Known limits: hubs whose speed was not recorded are not seen; a wheel that spins under power, or
slips under brakes, counts as its model has it.
Validated with: test/diagnosis/test_sinking.py.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.case.runs import Run
from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects import secondary_blowout
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.instants import grid_of
from truck_blowout_sim.diagnosis.fit.one_channel import score_channel

Floats = NDArray[np.float64]


def sinking_hubs(study: Study, named: Sequence[Hypothesis], asked: float,
                 hubs: Collection[str]) -> frozenset[str]:
    """Which of some hubs turn faster from an instant on, in the training runs together.

    Study's models have ``named`` in force.

    Args:
        study: the case; ``named``: what is in force.
        asked: fall of the sum of squares that chance may reach.
        hubs: that are in question.
    """
    recorded = {channel for i in study.train for channel in study.runs[i].channels}
    seen = [hub for hub in hubs if f"hub_speed_{hub}_radps" in recorded]
    if not seen:
        return frozenset()
    projector = study.projector(named)
    removed = projector.remove(study.residual())

    def rise(hub: str, which: int, at_s: float) -> float:
        one = score_channel(study, projector, removed, f"hub_speed_{hub}_radps",
                            lambda run, mean: mean * _from(run, study.runs[which], at_s))
        return one.delta if one.amount > 0.0 else 0.0

    def evidence(hub: str) -> float:
        total = 0.0
        for which in study.train:
            instants = grid_of(study.runs[which], secondary_blowout.EFFECT).tolist()
            best = max((rise(hub, which, at_s) for at_s in instants), default=0.0)
            total += max(best - 2.0 * float(np.log(max(len(instants), 1))), 0.0)
        return total

    return frozenset(hub for hub in seen if evidence(hub) > asked)


def _from(run: Run, which: Run, at_s: float) -> Floats:
    """1 in the bins of a run from an instant on; 0 in all others and in other runs."""
    return np.asarray((run.edges_s[:-1] >= at_s) * float(run is which))
