"""How the truck stands: a body that leans or dips all the time, whatever the road.

What is left of a body's roll and pitch after everything named is fitted with a constant over the
training runs. Where the gyro sits crooked it does so in the baseline runs too: that constant, and
all other nuisances, are projected out. What stays belongs to the truck: a spring that lost its air
or broke, a frame that bent. No known effect turns a body without the forces that it would take.

References: score test of `linear.py`.
Known limits: without baseline runs a lean is how the instrument is mounted, and nothing is said;
angles that were not recorded show none; nothing is asked where an instrument was found faulty.
Validated with: test/diagnosis/test_posture.py (a body that leans is named, and by how much).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.attribute import score_channel
from truck_blowout_sim.diagnosis.fit.quantiles import NINETY

_ANGLES = {"roll": ("right", "left"), "pitch": ("nose", "tail")}  # lower where it is positive


@dataclass(frozen=True)
class Posture:
    """A body that stands turned against the model, everything named in force.

    Attributes:
        angle: roll or pitch; ``turned_rad`` by how much, ``sigma`` its standard error.
        evidence: fall of the sum of squares that it buys.
    """

    body: str
    angle: str
    turned_rad: float
    sigma: float
    evidence: float

    @property
    def equation(self) -> str:
        """For an engineer."""
        return (f"{self.angle}({self.body}) = that of the model {self.turned_rad:+.5f} rad  "
                f"(+- {NINETY * self.sigma:.5f}, 90 %), at all times")

    @property
    def sentence(self) -> str:
        """For a driver."""
        down, up = _ANGLES[self.angle]
        return (f"The {self.body} stands with its {down if self.turned_rad > 0.0 else up} low by "
                f"{math.degrees(abs(self.turned_rad)):.2f} deg on any road, as with a spring that "
                "is broken or without air, and none of the known effects.")

    @property
    def next_test(self) -> str:
        """What would find its cause."""
        return (f"On level ground measure the height over every axle of the {self.body}, on both "
                "sides, and the air pressure of its springs.")


def turned_body(study: Study, named: Sequence[Hypothesis]) -> Posture | None:
    """The body that stands turned most clearly, if one does.

    Study's models have ``named`` in force.
    """
    found = max(postures(study, named), key=lambda p: p.evidence, default=None)
    return found if found and found.evidence > study.settings.posture_delta else None


def postures(study: Study, named: Sequence[Hypothesis]) -> list[Posture]:
    """How each body stands about each axis for which an angle was recorded."""
    if not study.baseline:
        return []
    projector = study.projector(named)
    removed = projector.remove(study.residual())
    scores = {(body, angle): score_channel(study, projector, removed, f"{body}_{angle}_rad",
                                           lambda _, mean: np.ones_like(mean))
              for body in study.packed.vehicle.units for angle in _ANGLES}
    return [Posture(*key, one.amount, one.sigma, one.delta) for key, one in scores.items()
            if np.isfinite(one.sigma)]
