"""How the truck stands: a body that leans or dips all the time, whatever the road.

What is left of a body's roll and pitch after everything named is fitted with a constant over the
training runs. Where the gyro sits crooked it does so in the baseline runs too: that constant, and
all other nuisances, are projected out. What stays belongs to the truck: a spring that lost its air
or broke, a frame that bent. No known effect turns a body without the forces that it would take.

References: as `scatter.py`.
Known limits: without baseline runs a lean is how the instrument is mounted, and nothing is said;
angles that were not recorded show none; nothing is asked where an instrument was found faulty, or
where only training lost a tire.
Validated with: test/diagnosis/test_posture.py (a body that leans is named, and by how much).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from truck_blowout_sim.diagnosis.algebra.quantiles import NINETY
from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects import secondary_blowout
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.one_channel import Weighed, ask_channel, asked_of
from truck_blowout_sim.diagnosis.fit.scatter import Scatter

_ANGLES = {"roll": ("right", "left"), "pitch": ("nose", "tail")}  # lower where it is positive


@dataclass(frozen=True)
class Posture:
    """A body that stands turned against the model, everything named in force.

    Attributes:
        angle: roll or pitch; ``turned_rad`` by how much, ``sigma`` its standard error.
        evidence: fall of the sum of squares that it buys; ``support``: see `scatter.py`.
    """

    body: str
    angle: str
    turned_rad: float
    sigma: float
    evidence: float
    support: float

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


def turned_body(study: Study, named: Sequence[Hypothesis], scatter: Scatter) -> Posture | None:
    """The body that stands turned most clearly, if one does beyond chance.

    Study's models have ``named`` in force; ``scatter``: of the case.
    """
    asked = postures(study, named, scatter)
    found = max(asked, key=lambda p: p.support, default=None)
    least = asked_of(study.settings.alarms_by_sign, len(asked))
    return found if found and found.support > least else None


def postures(study: Study, named: Sequence[Hypothesis], scatter: Scatter) -> list[Posture]:
    """How each body stands about each axis for which an angle was recorded.

    One body strays in this from another, and from day to day, as gyros do in how they sit. Nothing
    is asked where only training lost a tire: on a flat one a body leans, as far as its tire's law.
    """
    if not study.baseline or _lost_a_tire(study, named):
        return []
    left, found = Weighed.of(study, named), []
    for body in study.packed.vehicle.units:
        for angle in _ANGLES:
            channel = f"{body}_{angle}_rad"
            rule = study.settings.rule(channel)
            one = rule and ask_channel(study, left, scatter, channel,
                                       lambda _, mean: np.ones_like(mean), rule.bias)
            if one:
                found.append(Posture(body, angle, one.score.amount, one.score.sigma,
                                     one.score.delta, one.support))
    return found


def _lost_a_tire(study: Study, named: Sequence[Hypothesis]) -> bool:
    """Whether a tire is flat in training and in no baseline run."""
    flat = [bool(study.runs[i].recording.blowouts) for i in (*study.train, *study.baseline)]
    commanded = any(flat[:len(study.train)]) and not any(flat[len(study.train):])
    return commanded or any(h.effect.name == secondary_blowout.EFFECT.name for h in named)
