"""What brings training back to what baseline runs keep.

Runs are few, so how an amount scatters from one to the next says little, even of a law that leaves
nothing open. But where training keeps more than baseline runs do, or pulls numbers of the sheet to
where no vehicle has them, something is missing; what is left to ask is what. A law that takes most
of that away, in runs it was fitted to and in unseen ones, needs no further support. But a wind, a
slope or a load that moves can choose its instants, so it can take away much of anything: it must
also stand out of what its force does otherwise.

References: none beyond `judging.py`, and `locate/left_over.py` and `locate/beyond_sheet.py`, which
have the tests.
Known limits: says nothing without baseline runs, nor beside a corrected instrument.
Validated with: test/diagnosis/test_quieting.py.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.fit.ranked import Ranked
from truck_blowout_sim.diagnosis.locate.beyond_sheet import chance_of_numbers
from truck_blowout_sim.diagnosis.locate.left_over import (
    NAMING_SHARE,
    chance_of_more,
    excess,
    expected_squares,
    mean_squares,
)
from truck_blowout_sim.diagnosis.name.judging import POSITIVE, at_bound, models_with

_TRIED = 3  # the largest; what explains less is no rival of these


@dataclass(frozen=True)
class Quieting:
    """What takes most of that away.

    Attributes:
        ranked: it; ``share`` that it takes.
        chance: that training keeps so much more, or pulls the sheet's numbers so far, where nothing
            is missing.
    """

    ranked: Ranked
    share: float
    chance: float


def quieting(study: Study, ranked: Sequence[Ranked]) -> list[Quieting]:
    """What takes away most of what training keeps more than baseline, largest first.

    Nothing where training keeps no more and needs no numbers that vehicles of the kind do not have.
    Nothing is named yet.
    """
    strong = [r for r in ranked if r.refitted and not at_bound(r.hypothesis)]
    if not study.baseline or not strong:
        return []
    squares = mean_squares(study, unseen=study.holdout_models)
    chance = min(chance_of_more(study, squares), chance_of_numbers(study))
    if chance > study.settings.alarms_by_rest:
        return []
    usual = expected_squares(study, squares)
    found = [Quieting(one, _taken(study, squares, usual, one), chance)
             for one in sorted(strong, key=lambda r: -r.delta)[:_TRIED] if _stands_out(one)]
    return [one for one in found if one.share >= NAMING_SHARE]


def _stands_out(one: Ranked) -> bool:
    """Not an event that its own force, as it is at other times, makes as well."""
    return one.support > POSITIVE or not one.hypothesis.effect.adds_up


def _taken(study: Study, before: Sequence[float], usual: float, one: Ranked) -> float:
    """Share of what training keeps more than usual that is gone with a hypothesis in force."""
    effects = [one.hypothesis]
    after = mean_squares(replace(study, models=models_with(study, effects)), effects)
    more = excess(study, before, usual)
    return 1.0 - excess(study, after, usual) / more if more > 0.0 else 0.0
