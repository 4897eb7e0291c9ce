"""Look for what is missing, one effect after another, until nothing passes.

What a hypothesis must pass is in `judging.py`, what holds only together in `pairing.py`.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.case.study import Progress, Study
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.ranked import Ranked
from truck_blowout_sim.diagnosis.fit.scatter import Chance
from truck_blowout_sim.diagnosis.fit.support import asks_unseen, support_of_unseen
from truck_blowout_sim.diagnosis.locate.left_over import NAMING_SHARE
from truck_blowout_sim.diagnosis.name.judging import (
    ODDS,
    POSITIVE,
    Found,
    can_judge,
    excess_of,
    imitates,
    note,
    predict_with,
    predicts_better,
    slack,
    strongest_of,
    weakness,
    worth,
)
from truck_blowout_sim.diagnosis.name.pairing import Pair, masked_pair, pair_with, settled
from truck_blowout_sim.diagnosis.name.quieting import quieting
from truck_blowout_sim.diagnosis.name.shortlist import Round, shortlist
from truck_blowout_sim.diagnosis.name.trial import Fate, Trial
from truck_blowout_sim.diagnosis.prove.holdout import Prediction, predict

Floats = NDArray[np.float64]
_MOST_EFFECTS = 3
_MOST = 0.5  # of what a stronger effect left beyond the usual


def search(study: Study, progress: Progress | None = None, most: int = _MOST_EFFECTS,
           sound: bool = True) -> Found:
    """Find up to ``most`` effects; leaves the study's training models with them in force.

    ``sound``: no instrument was corrected, so that what training keeps can be compared.
    """
    projector = study.projector()
    found = Found()
    residual = study.residual()
    found.models_null = list(study.models)
    found.chi2_null = found.chi2_after = projector.chi2(residual)
    found.before = found.after = predict(study, residual, ())
    rounds: list[_Tried] = []
    while len(found.named) < most:
        named = [r.hypothesis for r in found.named]
        this = shortlist(study, named, progress, _further(study, sound),
                         [one.named for one in found.after])
        ranked, found.chance = this.ranked, found.chance or this.chance
        if not rounds:
            found.tried = [Trial(r, Fate("refit", r.promise)) for r in ranked]
            found.strongest = strongest_of(ranked)
        best, disbelieved = _accept(study, found, this, named)
        if best is None and sound and not named:  # a law that is named leaves some of its own
            best = _accept_quieting(study, found, this)
        if best is not None:
            rounds.append(_Tried(ranked, this.chance.asked))
            settled(study, found)
            continue
        pair = pair_with(study, found, disbelieved, this.chance, most, progress)
        if pair is None and not found.named and most > 1:
            pair = masked_pair(study, found, ranked, this.chance)
        if pair is None:
            break
        rounds += [_Tried(one, this.chance.asked) for one in (ranked, pair.ranked)
                   ][:_take(study, found, pair, this.chance)]
    left = excess_of(study, found)
    taken = {r.hypothesis.key for r in found.named}
    found.rivals = [one.rivals(best, taken, slack(best, left))
                    for best, one in zip(found.named, rounds, strict=True)]
    return found


def _further(study: Study, sound: bool) -> float:
    """Support asked beyond chance: 2 ln 20 beside a corrected instrument, positive in one log.

    No correction is exact. The parts of one log share what the model's form lacks as they share
    what the truck lacks, so where no other run stands beside it they agree on either.
    """
    if not sound:
        return ODDS
    return POSITIVE if study.parts_of_one_log else 0.0


@dataclass(frozen=True, eq=False)
class _Tried:
    """What one round of the search tried, and the support that it asked for."""

    ranked: Sequence[Ranked]
    support: float

    def rivals(self, best: Ranked, taken: Collection[tuple[str, str]], room: float
               ) -> tuple[Ranked, ...]:
        """The alias set of what was named, best first: what explains nearly as much.

        Also a steady cause that could have been named and is supported as well: one that explains
        more is named instead of it. ``taken``: keys of all that is named.
        """
        least = max(best.support, self.support)
        return (best, *(r for r in self.ranked if r.refitted and r.hypothesis.key not in taken
                        and (r.delta > best.delta - room
                             or (r.support >= least and not r.hypothesis.times))))


@dataclass(frozen=True, eq=False)
class _Believed:
    """A hypothesis that passed every test.

    Attributes:
        worth: what it explains, and how much better the holdout is predicted.
        models: of training with it in force; ``after``: the predictions.
    """

    ranked: Ranked
    worth: float
    models: list[Floats]
    after: tuple[Prediction, ...]


def _accept(study: Study, found: Found, this: Round, named: Sequence[Hypothesis]
            ) -> tuple[Ranked | None, list[Ranked]]:
    """Take the best hypothesis that passes every test; record why others fell.

    Among those that training cannot tell apart, the one that predicts the holdout best is taken.

    Returns:
        It, and those that fell only because they do not predict the holdout better.
    """
    disbelieved: list[Ranked] = []
    ended: list[Ranked] = []  # beyond chance, but at the end of the search
    left = study.settings.law_leaves * max((r.evidence for r in found.named), default=0.0)
    excess = excess_of(study, found)
    passing: list[_Believed] = []
    aside = 0.0
    for one in this.ranked:
        # what explains most of the rest is no leftover of a stronger effect's inexactness
        fate = weakness(one, this.chance, left if one.delta < _MOST * excess else 0.0)
        most = max((worth(p.ranked) for p in passing), default=0.0)
        if fate is not None and fate.rule == "bound":
            ended.append(one)
        if fate is None and imitates(one, this.ranked, this.chance):
            fate, aside = Fate("imitates"), max(aside, worth(one))
        elif fate is None and passing and worth(one) < most - slack(passing[0].ranked):
            fate = Fate("explains", worth(one), most)
        elif fate is None:
            believed = _believed(study, found, this, one)
            if isinstance(believed, Fate):
                fate = believed
                disbelieved.append(one)
            else:
                passing.append(believed)
                fate = Fate("predicts", believed.worth)
        if not named:  # beside what is named, its look-alikes explain nothing more
            note(found, one, fate)
    beyond = [p.ranked for p in passing] or ended
    if beyond:
        passing += _explaining_more(study, found, this, beyond, aside)
    if not passing:
        return None, disbelieved
    best = max(passing, key=lambda p: p.worth)
    fate = Fate("accepted", best.ranked.support, this.chance.asked)
    return _named(study, found, best, fate), disbelieved


def _accept_quieting(study: Study, found: Found, this: Round) -> Ranked | None:
    """Take what brings training back to what baseline runs keep, if unseen runs agree."""
    tried = [(_believed(study, found, this, one.ranked), one)
             for one in quieting(study, this.ranked)]
    believed = [(one, quiets) for one, quiets in tried if isinstance(one, _Believed)]
    if not believed:
        return None
    best, quiets = max(believed, key=lambda pair: pair[0].worth)
    found.more_by_chance = quiets.chance
    return _named(study, found, best, Fate("quiets", quiets.share, NAMING_SHARE))


def _named(study: Study, found: Found, best: _Believed, fate: Fate) -> Ranked:
    """Put it in force."""
    study.models, found.after = best.models, best.after
    found.named.append(best.ranked)
    found.chi2_after -= best.ranked.delta
    note(found, best.ranked, fate)
    return best.ranked


def _explaining_more(study: Study, found: Found, this: Round,
                     beyond: Sequence[Ranked], aside: float) -> list[_Believed]:
    """Causes that explain more than all that are beyond chance, as single questions.

    And more than ``aside``, what a wind explains that was set aside: else they may only be traces
    of it, and it is asked again beside what is named.

    That something is missing is shown by then, also where all of them ran to the end of the search;
    what explains less shall not be named only because another cause was asked among many. A wind, a
    slope or a load that moves explains more by the instants that it chose; a lost tire and a loss
    of grip have paid for theirs.
    """
    most = max(aside, *(worth(one) for one in beyond))
    more = [one for one in this.ranked if worth(one) > most
            and not (one.hypothesis.times and one.hypothesis.effect.adds_up)
            and weakness(one, this.chance.alone) is None]
    tried = [_believed(study, found, this, one) for one in more]
    return [one for one in tried if isinstance(one, _Believed)]


def _believed(study: Study, found: Found, this: Round, one: Ranked) -> _Believed | Fate:
    """With what it predicts; its fate where unseen runs speak against it.

    Those of which its support knows nothing must be predicted better.
    """
    models, after = predict_with(study, [*this.beside.named, one.hypothesis])
    against = _against(study, found, this, one, after)
    if against is not None:
        return against
    gain = sum(p.chi2 for p in found.after) - sum(p.chi2 for p in after)
    return _Believed(one, worth(one) + gain, models, after)


def _against(study: Study, found: Found, this: Round, one: Ranked, after: Sequence[Prediction]
             ) -> Fate | None:
    """Its fate where unseen runs speak against a hypothesis.

    Of a cause that is always there its support knows them: then only odds of 20 to 1 against it
    count, and only those that are left where a supported amount may scatter from run to run.
    """
    better = predicts_better(found.after, after)
    known = asks_unseen(one.hypothesis, this.beside)
    if better > (-ODDS if known else 0.0) or not can_judge(study, one.hypothesis):
        return None
    scatters = known and one.support > ODDS and (
        support_of_unseen(study, one, this.beside, this.chance) > -ODDS)
    return None if scatters else Fate("holdout", better)


def _take(study: Study, found: Found, pair: Pair, chance: Chance) -> int:
    """Name what holds only together; the number of effects that were added."""
    added = len(pair.named) - len(found.named)
    found.named, study.models, found.after = pair.named, pair.models, pair.after
    found.chi2_after = pair.chi2
    for one in pair.named[-added:]:
        note(found, one, Fate("accepted", one.support, chance.asked))
    return added
