"""What a hypothesis must pass to be named, and where the search keeps what it found.

Its support must be beyond what chance reaches in the whole search, and it must predict the holdout
runs better.

References: Kass and Raftery 1995 (from which odds on evidence is positive).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.models import models_of
from truck_blowout_sim.diagnosis.fit.ranked import Ranked
from truck_blowout_sim.diagnosis.fit.scatter import Chance
from truck_blowout_sim.diagnosis.name.trial import Fate, Trial
from truck_blowout_sim.diagnosis.prove.holdout import Prediction, predict
from truck_blowout_sim.diagnosis.sensors import GateResult, SensorFinding

Floats = NDArray[np.float64]
_LAW = 0.5  # of what is left unexplained: how far inexact laws may change places
ODDS = 2.0 * np.log(20.0)  # support by which an explanation is 20 times as likely as another
POSITIVE = 2.0  # support from which on evidence is worth more than a bare mention
ALIAS_SHARE = 0.6  # of the evidence of the best: what explains less is no alias
_AT_BOUND = 0.002  # of the range
_EVENT_WORTH = 0.8


@dataclass(eq=False)
class Found:
    """What the search ends with.

    Attributes:
        named: accepted effects, in order, each with its rivals (itself first).
        tried: every candidate of the first round, best first, and what became of it.
        chi2_null, chi2_after: sums of squares without and with the named effects.
        models_null: training models before anything was named.
        before, after: holdout predictions without and with them.
        chance: what chance reaches in the first round.
        strongest: largest support in the first round.
        more_by_chance: chance that training keeps so much more than baseline runs, where what is
            named rests on that.
    """

    named: list[Ranked] = field(default_factory=list)
    rivals: list[tuple[Ranked, ...]] = field(default_factory=list)
    tried: list[Trial] = field(default_factory=list)
    chi2_null: float = 0.0
    chi2_after: float = 0.0
    models_null: list[Floats] = field(default_factory=list)
    before: tuple[Prediction, ...] = ()
    after: tuple[Prediction, ...] = ()
    chance: Chance | None = None
    strongest: float = 0.0
    more_by_chance: float = 1.0

    @property
    def p_value(self) -> float:
        """Chance that a search where nothing is missing is led so far; 1 where none was made."""
        searched = 1.0 if self.chance is None else self.chance.p_value(self.strongest)
        return min(searched, self.more_by_chance)


def strongest_of(ranked: Sequence[Ranked]) -> float:
    """Largest support of what could be named: fitted steady causes, and events that add up."""
    return max((one.support for one in ranked if one.refitted or one.hypothesis.effect.adds_up),
               default=0.0)


def excess_of(study: Study, found: Found) -> float:
    """What is left beyond the usual; nothing where less is left."""
    return max(found.chi2_after - study.level * study.columns.shape[0], 0.0)


def predicts_better(before: Sequence[Prediction], after: Sequence[Prediction]) -> float:
    """Log-likelihood gained on the holdout, twice, each run's own scale of error unknown.

    Squares alone would let the one run in which a law is least exact outvote all others.
    """
    return sum(_surprise(b) - _surprise(a) for b, a in zip(before, after, strict=True))


def _surprise(one: Prediction) -> float:
    """Twice the negative log-likelihood of a run, its scale 1 or larger, but for a constant.

    No smaller: rows that go together are calmer than their widths, and less alone.
    """
    seen = max(int(np.isfinite(one.run.measured).sum()), 1)
    return one.chi2 if one.chi2 <= seen else seen * (1.0 + float(np.log(one.chi2 / seen)))


def worth(one: Ranked) -> float:
    """Evidence, less a share where instants were free to choose: steady causes come first."""
    return one.delta * (_EVENT_WORTH if one.hypothesis.times else 1.0)


def slack(best: Ranked, left: float = 0.0) -> float:
    """Evidence within which training does not tell explanations apart.

    What makes one 20 times as likely as another, in units of the sum of squares: where runs
    scatter, more of these go into one unit of support. ``left`` is what even the best explanations
    leave beyond the usual: laws that inexact may change places by half of it, though never with
    what explains less than three fifths.
    """
    room = ODDS * max(best.delta / max(best.support, 1.0), 1.0)
    return min(room + _LAW * left, (1.0 - ALIAS_SHARE) * best.delta)


def can_judge(study: Study, hypothesis: Hypothesis) -> bool:
    """Whether any holdout run could show the effect at all."""
    return any(run.shows(hypothesis.effect.applies) for run in study.holdout)


def weakness(one: Ranked, chance: Chance, left: float = 0.0) -> Fate | None:
    """Why a hypothesis is too weak to name; None if it is not.

    ``left``: what the inexact law of a stronger effect may leave to another.
    """
    h, event = one.hypothesis, bool(one.hypothesis.times)
    if not one.refitted:
        return Fate("refit", one.promise)
    if one.support < chance.asked:
        return Fate("instant" if event else "support", one.support, chance.asked)
    if at_bound(h):
        return Fate("bound", h.amount, nearer_bound(h))
    return Fate("remainder", one.evidence, left) if one.evidence < left else None


def nearer_bound(h: Hypothesis) -> float:
    """The end of the search that the amount is nearer to."""
    low, high = h.effect.amount.low, h.effect.amount.high
    return low if h.amount - low < high - h.amount else high


def at_bound(h: Hypothesis) -> bool:
    """Whether the amount ran to the end of the search, and not to a limit that nature reaches."""
    low, high = h.effect.amount.low, h.effect.amount.high
    above = np.inf if h.effect.amount.at_low else h.amount - low
    below = np.inf if h.effect.amount.at_high else high - h.amount
    return bool(min(above, below) < _AT_BOUND * (high - low))


def imitates(one: Ranked, ranked: Sequence[Ranked], chance: Chance) -> bool:
    """Whether a wind may be only the trace of a cause that is always there, which passes too.

    Its free instants explain more of what a steady cause leaves, so it must be 20 times as likely.
    """
    return one.hypothesis.effect.timing == "pulse" and any(
        other.support > one.support - ODDS and weakness(other, chance) is None
        for other in ranked if not other.hypothesis.effect.timed)


def note(found: Found, one: Ranked, fate: Fate) -> None:
    """Keep the fate beside the first-round entry of the hypothesis."""
    found.tried = [Trial(one, fate) if trial.ranked.hypothesis.key == one.hypothesis.key else trial
                   for trial in found.tried]


def models_with(study: Study, named: Sequence[Hypothesis]) -> list[Floats]:
    """The study's models, those of training with effects in force."""
    changed = models_of(study, [named])[0]
    return [changed.get(i, model) for i, model in enumerate(study.models)]


def predict_with(study: Study, named: Sequence[Hypothesis]
                  ) -> tuple[list[Floats], tuple[Prediction, ...]]:
    """Training models and holdout predictions with effects in force."""
    models = models_with(study, named)
    residual = study.residual(dict(enumerate(models)))
    return models, predict(study, residual, named)


def not_taken_back(gate: GateResult, found: Found) -> tuple[SensorFinding, ...]:
    """Faulty instruments, but for those whose fault the search, once corrected, finds anew.

    A correction that the truck does not follow was none: something on the truck turns it so, which
    the search is then left to name.
    """
    again = {r.hypothesis.effect.name for r in found.named if r.hypothesis.effect.kind == "sensor"}
    return tuple(finding for finding in gate.findings if finding.name not in again)
