"""What was found beyond the promised names: where it acts and how strongly, without a cause.

Validated with: test/diagnosis/test_unlisted.py.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from truck_blowout_sim.diagnosis.answer.words import fill
from truck_blowout_sim.diagnosis.fit.ranked import Ranked


@dataclass(frozen=True)
class Unlisted:
    """A hypothesis that was accepted and has no name of the list.

    Attributes:
        sentence: for a driver; ``equation``: for an engineer; ``next_test``: what would show it.
    """

    sentence: str
    equation: str
    next_test: str

    @staticmethod
    def of(ranked: Ranked, rivals: Sequence[Ranked] = ()) -> Unlisted:
        """In words, with its amount, and the names that explain it as well.

        Args:
            rivals: its alias set.
        """
        h = ranked.hypothesis
        sentence, equation = fill(h, h.effect.amount.report(h.amount), None)
        names = " or ".join(dict.fromkeys(r.hypothesis.effect.name for r in listed(rivals)))
        also = f" These recordings cannot tell it from {names}." if names else ""
        return Unlisted(sentence + also, equation,
                        f"To confirm: {h.effect.splits}.")


def listed(named: Sequence[Ranked]) -> list[Ranked]:
    """Those whose name is promised."""
    return [r for r in named if r.hypothesis.effect.listed]


def unlisted(named: Sequence[Ranked]) -> list[Ranked]:
    """All others."""
    return [r for r in named if not r.hypothesis.effect.listed]


def mostly_unlisted(named: Sequence[Ranked]) -> bool:
    """Whether what has no name explains more than what has one."""
    outside, inside = (sum(r.delta for r in one) for one in (unlisted(named), listed(named)))
    return outside > inside
