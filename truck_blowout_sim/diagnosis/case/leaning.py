"""Accelerations that a recording has free of gravity are compared with the model's that are.

Known limits: the model's lean, not the recorded one, says how much gravity it feels.
Validated with: test/diagnosis/test_leaning.py.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.recordings.gravity import ACCELERATIONS, gravity_felt, gravity_is_removed

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Leaning:
    """An acceleration that a recording has free of gravity, and a model with it.

    Attributes:
        place: in a run's channels; ``stem``: of its name.
        angles: columns of the model's output: roll and pitch of the unit.
    """

    place: int
    stem: str
    angles: tuple[int, int]

    def felt(self, angles_rad: Floats) -> Floats:
        """[n] gravity in the model's bin means, at the means [n, 2] of its roll and pitch."""
        return gravity_felt(self.stem, angles_rad[:, 0], angles_rad[:, 1])


def leaning_of(recording: Recording, channels: Sequence[str], names: Sequence[str]
               ) -> tuple[Leaning, ...]:
    """Those of a recording's ``channels``; ``names``: of the model's output."""
    found = []
    for place, channel in enumerate(channels):
        unit, _, stem = channel.partition("_")
        if stem in ACCELERATIONS and gravity_is_removed(recording, unit):
            roll, pitch = (names.index(f"{unit}_{angle}_rad") for angle in ("roll", "pitch"))
            found.append(Leaning(place, stem, (roll, pitch)))
    return tuple(found)
