"""How much work a diagnosis may take: three levels, or one's own by ``dataclasses.replace``.

Validated with: test/diagnosis/test_effort.py.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Effort:
    """What a diagnosis looks at, and how closely.

    Attributes:
        most_effects: how many effects may be named.
        refits: how many steady candidates are fitted anew for each, and how many events. An event
            that is far from linear is fitted from as many amounts as events are fitted; with more
            than one, its instants are searched again at the fitted amount.
        step_s: fine integration step. Residuals on bins of 0.1 s hardly depend on it, but where
            friction sticks and slips; what it changes there widens the bins.
        coarse: simulate what is tried on the coarsest step that the settings allow.
        profile: intervals of amounts by profile likelihood and block jackknife, not by curvature.
        next_run: simulate which run would best tell apart what fits alike; else words only.
    """

    most_effects: int = 3
    refits: tuple[int, int] = (7, 2)
    step_s: float = 0.0025
    coarse: bool = False
    profile: bool = False
    next_run: bool = True


USUAL = Effort()
QUICK = Effort(most_effects=1, refits=(3, 1), coarse=True, next_run=False)
THOROUGH = Effort(most_effects=4, step_s=0.001, profile=True)
