"""Amounts at a limit that nature reaches, in words: a brake that is dead has a gain of zero.

Validated with: test/diagnosis/test_outcome.py.
"""

from __future__ import annotations

from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.result.parts import Interval

_NEAR = 0.05  # of the distance from the neutral amount to the limit
_WORDS = {
    ("brake_imbalance", "low"): "The brake at {where} is dead: it gives no torque, whatever its "
                                "pressure (90 %: at most {percent} percent of what it should).",
    ("blown_tire_cornering", "low"): "The blown tire at {where} has lost all of its cornering "
                                     "force (90 %: at most {percent} percent of the sheet's).",
}


def limit_sentence(hypothesis: Hypothesis, ends: Interval) -> str:
    """What to say of an amount at its physical limit; empty where it is not at one.

    Args:
        hypothesis: the effect with its amount.
        ends: of its 90 % interval, as reported.
    """
    amount, at = hypothesis.effect.amount, hypothesis.amount
    for side, limit in (("low", amount.low), ("high", amount.high)):
        words = _WORDS.get((hypothesis.effect.name, side))
        if words and limit != 0.0 and abs(at - limit) <= _NEAR * abs(limit):
            return words.format(where=str(hypothesis.place), percent=f"{100.0 * max(ends):.0f}")
    return ""
