"""What a hypothesis must pass to be named, and where the search keeps what it found.

It must buy enough (threshold calibrated on nulls), be strong enough to matter, be far from zero for
its standard error, and predict the holdout runs better.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.attribute import Ranked
from truck_blowout_sim.diagnosis.fit.refit import models_of
from truck_blowout_sim.diagnosis.prove.holdout import Prediction, predict
from truck_blowout_sim.diagnosis.sensors import GateResult, SensorFinding

Floats = NDArray[np.float64]
_FAR_FROM_ZERO = 3.0
_FLAWLESS = 0.25  # of what is usually left: no prediction is better than that
_LAW = 0.5  # of what is left unexplained: how far inexact laws may change places
_ALIKE = 0.4  # less evidence than the best by more than this share is no alias
_AT_BOUND = 0.002  # of the range
_EVENT_WORTH = 0.8
_NEXT_SHARE = 0.08  # three true second effects bought 8.5 to 10 %, a false one 7.4
_NEXT_EVENT_SHARE = 0.12  # its instant was free to choose


@dataclass(eq=False)
class Found:
    """What the search ends with.

    Attributes:
        named: accepted effects, in order, each with its rivals (itself first).
        tried: every candidate of the first round, best first, with the reason why it fell.
        chi2_null, chi2_after: sums of squares without and with the named effects.
        models_null: training models before anything was named.
        before, after: holdout predictions without and with them.
    """

    named: list[Ranked] = field(default_factory=list)
    rivals: list[tuple[Ranked, ...]] = field(default_factory=list)
    tried: list[tuple[Ranked, str]] = field(default_factory=list)
    chi2_null: float = 0.0
    chi2_after: float = 0.0
    models_null: list[Floats] = field(default_factory=list)
    before: tuple[Prediction, ...] = ()
    after: tuple[Prediction, ...] = ()


def excess_of(study: Study, found: Found) -> float:
    """What is left beyond the usual."""
    return found.chi2_after - study.settings.expected_level * study.columns.shape[0]


def predicts_better(study: Study, before: Sequence[Prediction], after: Sequence[Prediction]
                     ) -> float:
    """Log-likelihood gained on the holdout, twice, each run's own scale of error unknown.

    Squares alone would let the one run in which a law is least exact outvote all others.
    """
    least = _FLAWLESS * study.settings.expected_level
    return float(sum(a.left.size * np.log(max(b.chi2, least * a.left.size)
                                          / max(a.chi2, least * a.left.size))
                     for b, a in zip(before, after, strict=True)))


def worth(one: Ranked) -> float:
    """Evidence, less a share where instants were free to choose: steady causes come first."""
    return one.delta * (_EVENT_WORTH if one.hypothesis.times else 1.0)


def slack(study: Study, best: Ranked, left: float = 0.0) -> float:
    """Evidence within which training does not tell explanations apart.

    ``left`` is what even the best explanations leave beyond the usual: laws that inexact may change
    places by half of it, though never with what explains less than three fifths.
    """
    room = max(study.settings.keep_within * best.delta, 0.5 * study.settings.accept_delta)
    return max(room, min(room + _LAW * left, _ALIKE * best.delta))


def can_judge(study: Study, hypothesis: Hypothesis) -> bool:
    """Whether any holdout run could show the effect at all."""
    return any(run.shows(hypothesis.effect.applies) for run in study.holdout)


def weakness(study: Study, one: Ranked, strongest: float) -> str:
    """Why a hypothesis is too weak to name; empty if it is not."""
    amount = one.hypothesis.effect.amount
    if not one.refitted:
        return "not refitted: others explain more"
    event = bool(one.hypothesis.times)
    needed = study.needed(one.hypothesis.effect, event)
    if one.evidence < needed:
        return f"buys only {one.evidence:.0f} of {needed:.0f}" + (
            ", an event whose instant was searched" if event else "")
    away = one.hypothesis.amount - one.hypothesis.effect.neutral(study.packed)
    # runs of the same truck show what this one is; without them it may be another of its kind
    shown = bool(study.baseline) and not one.hypothesis.effect.met
    least = amount.material * (study.settings.same_truck if shown else 1.0)
    if abs(away) < least:
        return (f"{one.hypothesis.amount:.3g} {amount.unit} is within what trucks of one kind "
                f"differ ({least:.3g})")
    if min(one.hypothesis.amount - amount.low, amount.high - one.hypothesis.amount) < _AT_BOUND * (
            amount.high - amount.low):
        return "its amount runs to the bound of what is physical"
    if one.evidence < (_NEXT_EVENT_SHARE if event else _NEXT_SHARE) * strongest:
        return f"buys {one.evidence:.0f}, which the stronger effect's own inexactness may leave"
    if abs(away) < _FAR_FROM_ZERO * one.sigma:
        return "its interval comes near zero"
    return ""


def note(found: Found, one: Ranked, reason: str) -> None:
    """Keep the reason beside the first-round entry of the hypothesis."""
    found.tried = [(one if r.hypothesis.key == one.hypothesis.key else r,
                    reason if r.hypothesis.key == one.hypothesis.key else why)
                   for r, why in found.tried]


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
