"""What became of each hypothesis: the rule that decided, its value and its limit.

Validated with: test/diagnosis/test_trial.py.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from truck_blowout_sim.diagnosis.fit.ranked import Ranked

Rule = Literal["accepted", "quiets", "refit", "support", "instant", "bound", "remainder",
               "imitates", "explains", "predicts", "holdout", "withheld"]
_WORDS: dict[Rule, str] = {
    "accepted": "accepted",
    "quiets": "accepted: takes {value:.0%} of what training keeps beyond baseline runs, of "
              "{limit:.0%} that was asked",
    "refit": "not refitted: others explain more",
    "support": "support {value:.1f} of {limit:.1f} that chance may reach",
    "instant": "support {value:.1f} of {limit:.1f} that chance may reach, its instant searched",
    "bound": "its amount runs to the bound of what is physical",
    "remainder": "buys {value:.0f} of {limit:.0f} that a stronger effect's inexactness may leave",
    "imitates": "no more likely than a cause that is always there",
    "explains": "explains {value:.0f}, another {limit:.0f}",
    "predicts": "explains as much, predicts less",
    "holdout": "does not predict the holdout better ({value:+.1f})",
    "withheld": "helps, but the cause is unknown",
}


@dataclass(frozen=True)
class Fate:
    """Why a hypothesis was named or fell.

    Attributes:
        rule: that decided; ``value``: of the hypothesis; ``limit``: what was asked of it.
    """

    rule: Rule
    value: float = 0.0
    limit: float = 0.0

    def __str__(self) -> str:
        return _WORDS[self.rule].format(value=self.value, limit=self.limit)


@dataclass(frozen=True)
class Trial:
    """A hypothesis that was tried, and what became of it."""

    ranked: Ranked
    fate: Fate
