"""Amounts at a limit, in words: one that nature reaches, as a dead brake, or the end of the search.

An amount that is fitted alone must stay clear of the end of the search to be named. Fitted again
beside what was named later, it may still run there: the name stays, and the amount is a limit.

Validated with: test/diagnosis/test_outcome.py.
"""

from __future__ import annotations

import numpy as np

from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.name.judging import at_bound, nearer_bound
from truck_blowout_sim.diagnosis.result.parts import Interval

_NEAR = 0.05  # of the distance from the neutral amount to the limit


def limit_sentence(hypothesis: Hypothesis, ends: Interval) -> str:
    """What to say of an amount at its physical limit; empty where it is not at one.

    Args:
        hypothesis: the effect with its amount.
        ends: of its 90 % interval, as reported.
    """
    amount, at, where = hypothesis.effect.amount, hypothesis.amount, str(hypothesis.place)
    if amount.at_low and abs(at - amount.low) <= _NEAR * abs(amount.low):
        return amount.at_low.format(where=where, percent=f"{100.0 * max(ends):.0f}")
    if amount.at_high and abs(at - amount.high) <= _NEAR * abs(amount.high):
        return amount.at_high.format(where=where, percent=f"{100.0 * min(ends):.0f}")
    return ""


def limit_of_search(hypothesis: Hypothesis) -> str:
    """What to say of an amount at the end of the search; empty where it is not there."""
    return (" The amount ran to the end of what was searched: it is a limit, not a measurement."
            if at_bound(hypothesis) else "")


def open_at_limit(hypothesis: Hypothesis, low: float, high: float) -> Interval:
    """An interval of the amount, without the end at which the search ended."""
    if not at_bound(hypothesis):
        return low, high
    lower = nearer_bound(hypothesis) == hypothesis.effect.amount.low
    return (-np.inf, high) if lower else (low, np.inf)
