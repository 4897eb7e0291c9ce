"""What tables of worlds share: the cycle of groups, how names and severities are drawn."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from proving_ground.faults import WHOLE

Rng = np.random.Generator
# n nothing, s one effect, p two, f an instrument, u of no list, t taken out of the library
CYCLE = "nsnsnfnsnsnpnsnsntnsfuss"
GROUP = {"n": "null", "s": "single", "p": "pair", "f": "sensor", "u": "unknown", "t": "unknown"}
WHOLE_NAMES = tuple(kind.name for kind in WHOLE)
SIGMAS = (4.0, 150.0)
SIGMAS_B = (2.0, 30.0)
ENDS = 0.1                        # share of single effects at their physical end


@dataclass(frozen=True)
class Turn:
    """Place of a case in its world: number, letter, and how often the letter came before."""

    number: int
    letter: str
    before: int

    @classmethod
    def of(cls, number: int) -> Turn:
        """The turn of a case number."""
        rounds, at = divmod(number, len(CYCLE))
        letter = CYCLE[at]
        return cls(number, letter, rounds * CYCLE.count(letter) + CYCLE[:at].count(letter))


def walk(names: tuple[str, ...], number: int) -> str:
    """Names one after the other in strides, so that a few draws already differ in kind."""
    stride = next(step for step in (7, 5, 3, 1) if np.gcd(step, len(names)) == 1)
    return names[stride * number % len(names)]


def wanted_sigma(rng: Rng) -> float:
    """A wanted detectability, uniform in its logarithm."""
    return float(f"{np.exp(rng.uniform(*np.log(SIGMAS))):.3g}")


def wanted_sigma_b(rng: Rng) -> float:
    """A wanted sigma_b, uniform."""
    return float(f"{rng.uniform(*SIGMAS_B):.3g}")
