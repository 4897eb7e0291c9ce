"""Look for what is missing, one effect after another, until nothing passes.

What a hypothesis must pass is in `judging.py`, what holds only together in `pairing.py`.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.case.study import Progress, Study
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.attribute import Ranked
from truck_blowout_sim.diagnosis.fit.scatter import Chance
from truck_blowout_sim.diagnosis.name.judging import (
    Found,
    can_judge,
    excess_of,
    note,
    predict_with,
    predicts_better,
    slack,
    weakness,
    worth,
)
from truck_blowout_sim.diagnosis.name.pairing import Pair, pair_with, settled
from truck_blowout_sim.diagnosis.name.shortlist import Round, shortlist
from truck_blowout_sim.diagnosis.name.trial import Fate, Trial
from truck_blowout_sim.diagnosis.prove.holdout import Prediction, predict

Floats = NDArray[np.float64]
_MOST_EFFECTS = 3
_MOST = 0.5  # of what a stronger effect left beyond the usual


def search(study: Study, progress: Progress | None = None, most: int = _MOST_EFFECTS) -> Found:
    """Find up to ``most`` effects; leaves the study's training models with them in force."""
    projector = study.projector()
    found = Found()
    residual = study.residual()
    found.models_null = list(study.models)
    found.chi2_null = found.chi2_after = projector.chi2(residual)
    found.before = found.after = predict(study, residual, ())
    rounds: list[Sequence[Ranked]] = []
    while len(found.named) < most:
        named = [r.hypothesis for r in found.named]
        this = shortlist(study, named, progress)
        ranked, found.chance = this.ranked, found.chance or this.chance
        if not rounds:
            found.tried = [Trial(r, Fate("refit", r.promise)) for r in ranked]
        best, disbelieved = _accept(study, found, this, named)
        if best is not None:
            rounds.append(ranked)
            settled(study, found)
            continue
        pair = pair_with(study, found, disbelieved, this.chance, most, progress)
        if pair is None:
            break
        rounds += [ranked, pair.ranked][:_take(study, found, pair, this.chance)]
    left = excess_of(study, found)
    taken = {r.hypothesis.key for r in found.named}
    found.rivals = [_rivals(best, [r for r in ranked if r.hypothesis.key not in taken],
                            slack(best, left))
                    for best, ranked in zip(found.named, rounds, strict=True)]
    return found


def _accept(study: Study, found: Found, this: Round, named: Sequence[Hypothesis]
            ) -> tuple[Ranked | None, list[Ranked]]:
    """Take the best hypothesis that passes every test; record why others fell.

    Among those that training cannot tell apart, the one that predicts the holdout best is taken.

    Returns:
        It, and those that fell only because they do not predict the holdout better.
    """
    disbelieved: list[Ranked] = []
    strongest = max((r.evidence for r in found.named), default=0.0)
    excess = excess_of(study, found)
    passing: list[tuple[Ranked, float, list[Floats], tuple[Prediction, ...]]] = []
    for one in this.ranked:
        # what explains most of the rest is no leftover of a stronger effect's inexactness
        fate = weakness(one, this.chance, strongest if one.delta < _MOST * excess else 0.0)
        most = max((worth(p[0]) for p in passing), default=0.0)
        if fate is None and passing and worth(one) < most - slack(passing[0][0]):
            fate = Fate("explains", worth(one), most)
        elif fate is None:
            models, after = predict_with(study, [*named, one.hypothesis])
            gain = sum(p.chi2 for p in found.after) - sum(p.chi2 for p in after)
            better = predicts_better(study, found.after, after)
            if study.holdout and better <= 0.0 and can_judge(study, one.hypothesis):
                fate = Fate("holdout", better)
                disbelieved.append(one)
            else:
                passing.append((one, worth(one) + gain, models, after))
                fate = Fate("predicts", worth(one) + gain)
        note(found, one, fate)
    if not passing:
        return None, disbelieved
    best, _, study.models, found.after = max(passing, key=lambda p: p[1])
    found.named.append(best)
    found.chi2_after -= best.delta
    note(found, best, Fate("accepted", best.support, this.chance.asked))
    return best, disbelieved


def _take(study: Study, found: Found, pair: Pair, chance: Chance) -> int:
    """Name what holds only together; the number of effects that were added."""
    added = len(pair.named) - len(found.named)
    found.named, study.models, found.after = pair.named, pair.models, pair.after
    found.chi2_after = pair.chi2
    for one in pair.named[-added:]:
        note(found, one, Fate("accepted", one.support, chance.asked))
    return added


def _rivals(best: Ranked, ranked: Sequence[Ranked], room: float) -> tuple[Ranked, ...]:
    """The alias set, best first: what is not named itself and explains nearly as much."""
    others = [r for r in ranked if r.delta > best.delta - room and r.refitted]
    return (best, *others)
