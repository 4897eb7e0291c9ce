"""Amounts at a limit that nature reaches, in words: a brake that is dead has a gain of zero.

Validated with: test/diagnosis/test_outcome.py.
"""

from __future__ import annotations

from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.result.parts import Interval

_NEAR = 0.05  # of the distance from the neutral amount to the limit


def limit_sentence(hypothesis: Hypothesis, ends: Interval) -> str:
    """What to say of an amount at its physical limit; empty where it is not at one.

    Args:
        hypothesis: the effect with its amount.
        ends: of its 90 % interval, as reported.
    """
    amount, at = hypothesis.effect.amount, hypothesis.amount
    if not amount.at_low or abs(at - amount.low) > _NEAR * abs(amount.low):
        return ""
    return amount.at_low.format(where=str(hypothesis.place), percent=f"{100.0 * max(ends):.0f}")
