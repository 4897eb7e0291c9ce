"""How small a cause these recordings would show: what the answer that nothing is missing excludes.

Had a cause acted in training with amount A, run i would show d_i' C^-1 sum_j d_j A of it, and its
support would grow with A. The smallest A is that at which it reaches what is asked of a name. Half
of such causes would be named: noise adds as often as it takes away.

References: Neyman and Pearson 1933 (power); see `fit/scatter.py` for the support.
Known limits: linear in the amount; training alone is asked, and unseen runs that show a cause make
smaller ones visible; what begins at an instant is not asked.
Validated with: test/diagnosis/test_showing.py.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.scatter import Chance
from truck_blowout_sim.diagnosis.fit.shown import Question, Shown
from truck_blowout_sim.diagnosis.fit.width_error import degrees_of, most_supported
from truck_blowout_sim.diagnosis.result import Showing

_HALVINGS = 8  # of the range of amounts, on a log scale: to 3 percent
_LEAST = 1e-3  # of that range


def would_show(study: Study, chance: Chance | None) -> tuple[Showing, ...]:
    """Of each steady cause that has a name, the place at which the smallest amount would show.

    Empty where no search was made.
    """
    if chance is None:
        return ()
    residual, degrees = study.residual(), degrees_of(len(study.baseline or study.train))
    best: dict[str, tuple[float, Showing]] = {}
    for hypothesis, question in chance.questions:
        if not hypothesis.effect.listed:
            continue
        shown = question.shown(question.projector.remove(residual))
        ends = smallest(shown, chance, question, degrees)
        size = min((abs(end) for end in ends if end is not None), default=np.inf)
        name = hypothesis.effect.name
        if name not in best or size < best[name][0]:
            best[name] = size, _reported(hypothesis, ends)
    return tuple(one for _, one in sorted(best.values(), key=lambda pair: pair[1].name))


def smallest(shown: Shown, chance: Chance, question: Question, degrees: float
             ) -> tuple[float | None, float | None]:
    """Smallest amount below and above none that would be supported enough; None up to the end."""
    trained = shown.trained
    clear = float(trained @ shown.information @ trained)

    def enough(amount: float) -> bool:
        told = replace(shown, gradient=shown.information @ trained * amount)
        support = min(chance.scatter.support(told), most_supported(amount**2 * clear, degrees))
        return support >= chance.asked

    low, high = (_least_of(enough, end) for end in question.bounds)
    return low, high


def _least_of(enough: Callable[[float], bool], end: float) -> float | None:
    """Smallest amount toward an end for which something holds that holds beyond it, too."""
    if end == 0.0 or not np.isfinite(end) or not enough(end):
        return None
    low, high = np.log(_LEAST), 0.0
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if enough(end * float(np.exp(middle))) else (middle, high)
    return end * float(np.exp(high))


def _reported(hypothesis: Hypothesis, ends: tuple[float | None, float | None]) -> Showing:
    """In the unit and on the scale of the effect's amount."""
    amount, at = hypothesis.effect.amount, hypothesis.amount
    told = [None if end is None else amount.report(at + end) for end in ends]
    return Showing(hypothesis.effect.name, hypothesis.place, amount.name, amount.unit, *told)
