"""Two effects that hold only together: each alone has a wrong amount, or too little speaks for it.

Where much speaks for a hypothesis in training and only the holdout speaks against it, its amount
may make up for another effect that is not named yet. It is fitted together with what is named
already, then with each of the next best; all together must predict the holdout better.

Where nothing is named and nothing is supported enough, two effects may hide each other: what one of
them explains, the other leaves over, and the runs scatter. The best supported is fitted together
with each of the next. Each must be supported enough beside the other, and the two together beyond
what chance reaches among all pairs: `chi2` with two degrees of freedom, `n (n - 1) / 2` questions.

References: Wilks 1938 (two amounts at once); else none beyond `judging.py`.
Known limits: pairs are built on the strongest hypothesis that was disbelieved or is best supported,
and on two or three others; two that hide each other wholly are not found.
Validated with: test/diagnosis/test_together.py, test/diagnosis/test_pairing.py.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.case.study import Progress, Study
from truck_blowout_sim.diagnosis.fit.beside import Beside
from truck_blowout_sim.diagnosis.fit.ranked import Ranked
from truck_blowout_sim.diagnosis.fit.scatter import Chance
from truck_blowout_sim.diagnosis.fit.support import supported
from truck_blowout_sim.diagnosis.fit.together import fit_together
from truck_blowout_sim.diagnosis.name.judging import (
    ODDS,
    Found,
    at_bound,
    predict_with,
    predicts_better,
    weakness,
    worth,
)
from truck_blowout_sim.diagnosis.name.shortlist import shortlist
from truck_blowout_sim.diagnosis.prove.holdout import Prediction

Floats = NDArray[np.float64]
_MUCH = 2.0  # times what chance may reach: so much must support what the holdout speaks against
_SECONDS = 2  # how many others are tried beside it
_BESIDE_BEST = 3  # the same, where nothing is supported enough
_HALF = 0.5  # of what is asked of two together, they must have alone: else a trial is not worth it


@dataclass(frozen=True, eq=False)
class Pair:
    """What is named once something holds together with it.

    Attributes:
        named: everything, with the new ones last; ``ranked``: the round of the last one.
        models: training models with all in force; ``after`` the holdout's predictions.
        chi2: sum of squares left.
    """

    named: list[Ranked]
    ranked: Sequence[Ranked]
    models: list[Floats]
    after: tuple[Prediction, ...]
    chi2: float


def settled(study: Study, found: Found) -> None:
    """Fit everything that is named together, where that is more than one effect."""
    if len(found.named) > 1:
        found.named, chi2 = fit_together(study, found.named)
        found.chi2_after = min(found.chi2_after, chi2)
        study.models, found.after = predict_with(study, [r.hypothesis for r in found.named])


def pair_with(study: Study, found: Found, disbelieved: Sequence[Ranked], chance: Chance, most: int,
              progress: Progress | None) -> Pair | None:
    """The strongest of the disbelieved with what is named, and if need be with one more."""
    strong = [one for one in disbelieved if one.support > _MUCH * chance.asked]
    if not strong:
        return None
    chance = replace(chance, further=ODDS)
    first = max(strong, key=worth)
    pair = _holds(study, found, [*found.named, first], (), chance) if found.named else None
    if pair is not None or len(found.named) + 2 > most:
        return pair
    before = study.models
    named = [*(r.hypothesis for r in found.named), first.hypothesis]
    study.models, after = predict_with(study, named)
    ranked = shortlist(study, named, progress, placed=[run.named for run in after]).ranked
    study.models = before
    seconds = [one for one in ranked if not weakness(one, chance)]
    for second in sorted(seconds, key=worth, reverse=True)[:_SECONDS]:
        pair = _holds(study, found, [*found.named, first, second], ranked, chance)
        if pair is not None:
            return pair
    return None


def masked_pair(study: Study, found: Found, ranked: Sequence[Ranked], chance: Chance
                ) -> Pair | None:
    """The best supported hypothesis with one of the next, where none is supported enough alone."""
    weak = [one for one in ranked if one.refitted and not one.hypothesis.times
            and not at_bound(one.hypothesis) and one.support < chance.asked]
    best, asked = sorted(weak, key=lambda one: -one.support), chance.asked_of_two
    for second in best[1:1 + _BESIDE_BEST]:
        first = best[0]
        if first.support + second.support < _HALF * asked:
            break
        pair = _holds(study, found, [first, second], ranked, chance)
        if pair is not None and asked < max(first.support + pair.named[1].support,
                                            second.support + pair.named[0].support):
            return pair
    return None


def _holds(study: Study, found: Found, named: list[Ranked], ranked: Sequence[Ranked],
           chance: Chance) -> Pair | None:
    """Everything fitted together, if each stays what it was named and the holdout gains."""
    fitted, chi2 = fit_together(study, named)
    fitted = _each_supported(study, fitted, chance, found.chi2_after - chi2)
    if any(weakness(one, chance) for one in fitted):
        return None
    models, after = predict_with(study, [one.hypothesis for one in fitted])
    if predicts_better(found.after, after) <= 0.0:
        return None
    return Pair(fitted, ranked, models, after, chi2)


def _each_supported(study: Study, fitted: Sequence[Ranked], chance: Chance, together: float
                    ) -> list[Ranked]:
    """Each with its support beside all the others.

    ``together``: fall of the sum of squares that the new ones bring, each of which may explain
    little alone.
    """
    found = []
    for k, one in enumerate(fitted):
        others = [r.hypothesis for j, r in enumerate(fitted) if j != k]
        models, after = predict_with(study, others)
        beside = Beside.of(study, others, models, [run.named for run in after])
        joint = replace(one, evidence=max(one.evidence, together))
        found.append(replace(one, support=supported(study, joint, beside, chance).support))
    return found
