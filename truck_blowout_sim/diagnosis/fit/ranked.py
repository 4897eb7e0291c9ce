"""A hypothesis with what speaks for it, as all stages of the search hand it on."""

from __future__ import annotations

from dataclasses import dataclass

from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis


@dataclass(frozen=True)
class Ranked:
    """A hypothesis with the evidence for it.

    Attributes:
        delta: fall of the sum of squares, nuisances refitted.
        sigma: standard error of the amount.
        refitted: whether the amount comes from the nonlinear refit.
        evidence: fall against a truck whose own number of this meaning stays within two prior
            sigmas; equals ``delta`` where calibration has no such number.
        promise: linear fall with that number held, by which candidates are ranked before a refit.
        support: twice the log of the likelihood ratio, the amount allowed to scatter from run to
            run, less what choosing its instants brings by chance; see `scatter.py`.
        unseen: share of the support of an event that unseen runs add to what the others say.
    """

    hypothesis: Hypothesis
    delta: float
    sigma: float
    refitted: bool = False
    evidence: float = 0.0
    promise: float = 0.0
    support: float = 0.0
    unseen: float = 0.0
