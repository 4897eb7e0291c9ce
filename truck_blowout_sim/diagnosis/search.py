"""Look for what is missing, one effect after another, until nothing passes.

A hypothesis is accepted only if it buys enough (threshold calibrated on nulls), is strong enough to
matter, is far from zero for its standard error, and predicts the holdout runs better.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.attribute import Ranked, with_effects
from truck_blowout_sim.diagnosis.holdout import Prediction, predict
from truck_blowout_sim.diagnosis.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.shortlist import shortlist
from truck_blowout_sim.diagnosis.study import Progress, Study

Floats = NDArray[np.float64]
_MOST_EFFECTS = 3
_FAR_FROM_ZERO = 3.0
_FLAWLESS = 0.25  # of what is usually left: no prediction is better than that
_LAW = 0.5  # of what is left unexplained: how far inexact laws may change places
_ALIKE = 0.4  # less evidence than the best by more than this share is no alias
_AT_BOUND = 0.002  # of the range
_EVENT_WORTH = 0.8
_NEXT_SHARE = 0.12
_MOST = 0.5  # of what a stronger effect left beyond the usual


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


def search(study: Study, progress: Progress | None = None, most: int = _MOST_EFFECTS) -> Found:
    """Find up to ``most`` effects; leaves the study's training models with them in force."""
    projector = study.projector()
    found = Found()
    residual = study.residual()
    found.models_null = list(study.models)
    found.chi2_null = found.chi2_after = projector.chi2(residual)
    found.before = found.after = predict(study, residual, ())
    rounds: list[list[Ranked]] = []
    for turn in range(most):
        named = [r.hypothesis for r in found.named]
        ranked = shortlist(study, named, progress)
        if turn == 0:
            found.tried = [(r, "") for r in ranked]
        best = _accept(study, found, ranked, named)
        if best is None:
            break
        rounds.append(ranked)
    left = _excess(study, found)
    taken = {r.hypothesis.key for r in found.named}
    found.rivals = [_rivals(best, [r for r in ranked if r.hypothesis.key not in taken],
                            slack(study, best, left))
                    for best, ranked in zip(found.named, rounds, strict=True)]
    return found


def _accept(study: Study, found: Found, ranked: Sequence[Ranked],
            named: Sequence[Hypothesis]) -> Ranked | None:
    """Take the best hypothesis that passes every test; record why others fell.

    Among those that training cannot tell apart, the one that predicts the holdout best is taken.
    """
    strongest = max((r.evidence for r in found.named), default=0.0)
    excess = _excess(study, found)
    passing: list[tuple[Ranked, float, list[Floats], tuple[Prediction, ...]]] = []
    for one in ranked:
        # what explains most of the rest is no leftover of a stronger effect's inexactness
        reason = _weak(study, one, strongest if one.delta < _MOST * excess else 0.0)
        if not reason and passing and _worth(one) < max(
                _worth(p[0]) for p in passing) - slack(study, passing[0][0]):
            reason = "explains less"
        elif not reason:
            models, after = _predict_with(study, [*named, one.hypothesis])
            gain = sum(p.chi2 for p in found.after) - sum(p.chi2 for p in after)
            better = _predicts_better(study, found.after, after)
            if study.holdout and better <= 0.0 and _can_judge(study, one.hypothesis):
                reason = f"does not predict the holdout better ({better:+.1f})"
            else:
                passing.append((one, _worth(one) + gain, models, after))
                reason = "explains as much, predicts less"
        _note(found, one, reason)
    if not passing:
        return None
    best, _, study.models, found.after = max(passing, key=lambda p: p[1])
    found.named.append(best)
    found.chi2_after -= best.delta
    _note(found, best, "accepted")
    return best


def _excess(study: Study, found: Found) -> float:
    """What is left beyond the usual."""
    return found.chi2_after - study.settings.expected_level * study.columns.shape[0]


def _predicts_better(study: Study, before: Sequence[Prediction], after: Sequence[Prediction]
                     ) -> float:
    """Log-likelihood gained on the holdout, twice, each run's own scale of error unknown.

    Squares alone would let the one run in which a law is least exact outvote all others.
    """
    least = _FLAWLESS * study.settings.expected_level
    return float(sum(a.left.size * np.log(max(b.chi2, least * a.left.size)
                                          / max(a.chi2, least * a.left.size))
                     for b, a in zip(before, after, strict=True)))


def _worth(one: Ranked) -> float:
    """Evidence, less a share where instants were free to choose: steady causes come first."""
    return one.delta * (_EVENT_WORTH if one.hypothesis.times else 1.0)


def slack(study: Study, best: Ranked, left: float = 0.0) -> float:
    """Evidence within which training does not tell explanations apart.

    ``left`` is what even the best explanations leave beyond the usual: laws that inexact may change
    places by half of it, though never with what explains less than three fifths.
    """
    room = max(study.settings.keep_within * best.delta, 0.5 * study.settings.accept_delta)
    return max(room, min(room + _LAW * left, _ALIKE * best.delta))


def _can_judge(study: Study, hypothesis: Hypothesis) -> bool:
    """Whether any holdout run could show the effect at all."""
    return any(run.shows(hypothesis.effect.applies) for run in study.holdout)


def _weak(study: Study, one: Ranked, strongest: float) -> str:
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
    if one.evidence < _NEXT_SHARE * strongest:
        return f"buys {one.evidence:.0f}, which the stronger effect's own inexactness may leave"
    if abs(away) < _FAR_FROM_ZERO * one.sigma:
        return "its interval comes near zero"
    return ""


def _note(found: Found, one: Ranked, reason: str) -> None:
    """Keep the reason beside the first-round entry of the hypothesis."""
    found.tried = [(one if r.hypothesis.key == one.hypothesis.key else r,
                    reason if r.hypothesis.key == one.hypothesis.key else why)
                   for r, why in found.tried]


def _predict_with(study: Study, named: Sequence[Hypothesis]
                  ) -> tuple[list[Floats], tuple[Prediction, ...]]:
    """Training models and holdout predictions with effects in force."""
    jobs = [(study.runs[i], with_effects(study.packed, named, study.runs[i].recording.name))
            for i in study.train]
    models = list(study.models)
    for i, model in zip(study.train, study.simulate(jobs), strict=True):
        models[i] = model
    residual = study.residual(dict(enumerate(models)))
    return models, predict(study, residual, named)


def _rivals(best: Ranked, ranked: Sequence[Ranked], room: float) -> tuple[Ranked, ...]:
    """The alias set, best first: what is not named itself and explains nearly as much."""
    others = [r for r in ranked if r.delta > best.delta - room and r.refitted]
    return (best, *others)
