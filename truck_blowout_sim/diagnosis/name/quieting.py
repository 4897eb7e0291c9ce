"""What brings training back to what baseline runs keep.

Runs are few, so how an amount scatters from one to the next says little, even of a law that leaves
nothing open. But where training keeps more than baseline runs do, something is missing; what is
left to ask is what. A law that takes most of that away, in runs it was fitted to and in unseen
ones, needs no further support.

References: none beyond `judging.py` and `locate/left_over.py`, which has the test.
Known limits: says nothing without baseline runs, nor beside a corrected instrument.
Validated with: test/diagnosis/test_quieting.py.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.attribute import Ranked
from truck_blowout_sim.diagnosis.locate.comparable import Left
from truck_blowout_sim.diagnosis.locate.left_over import expected_squares, keeps_more, mean_squares
from truck_blowout_sim.diagnosis.locate.wrench import enough, missing_wrench
from truck_blowout_sim.diagnosis.name.judging import at_bound, models_with

MOST = 0.5  # of what training keeps more: what explains less is no name for it
_TRIED = 3  # the largest; what explains less is no rival of these


@dataclass(frozen=True)
class Quieting:
    """What takes most of that away: it, and its ``share`` of it."""

    ranked: Ranked
    share: float


def quieting(study: Study, ranked: Sequence[Ranked], named: Sequence[Hypothesis]
             ) -> list[Quieting]:
    """What takes away most of what training keeps more than baseline, largest first.

    Nothing where training keeps no more. What is ``named`` is in force in the study's models.
    """
    squares = mean_squares(study, named)
    usual = expected_squares(study, squares)
    strong = [r for r in ranked if r.refitted and not at_bound(r.hypothesis)]
    if usual is None or not strong:
        return []
    found = [Quieting(one, _taken(study, squares, usual, [*named, one.hypothesis]))
             for one in sorted(strong, key=lambda r: -r.delta)[:_TRIED]]
    found = [one for one in found if one.share >= MOST]
    return found if found and (keeps_more(study, squares) or _pushed(study, named)) else []


def _taken(study: Study, before: Sequence[float], usual: float, effects: Sequence[Hypothesis]
           ) -> float:
    """Share of what training keeps more than usual that is gone with the effects in force."""
    after = mean_squares(replace(study, models=models_with(study, effects)), effects)
    rows = {i: study.runs[i].measured.size for i in study.train}
    excess = sum(n * (before[i] - usual) for i, n in rows.items())
    gone = sum(n * (before[i] - after[i]) for i, n in rows.items())
    return gone / excess if excess > 0.0 else 0.0


def _pushed(study: Study, named: Sequence[Hypothesis]) -> bool:
    """Whether a force on one body alone would explain more than models differ by."""
    left = Left.of(study, study.models, named, comparable=True)
    worst = left.worst(study)
    forces = (missing_wrench(study, worst, body, study.models, named, None, left)
              for body in study.packed.vehicle.units)
    return any(one.delta - 2.0 * one.degrees > enough(study) for one in forces)
