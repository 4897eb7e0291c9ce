"""Channels of a recording on one grid of times, and what had to be assumed about them."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.recordings import Recording

Floats = NDArray[np.float64]


@dataclass
class Source:
    """A recording read at given instants.

    Attributes:
        recording: where the channels come from.
        times_s: instants, increasing.
        assumptions: sentences about what was not recorded, in the order they were found out.
    """

    recording: Recording
    times_s: Floats
    assumptions: list[str] = field(default_factory=list)

    def get(self, name: str) -> Floats | None:
        """The channel at every instant, held beyond its ends; None if it was not recorded."""
        series = self.recording.channels.get(name)
        if series is None or not len(series):
            return None
        return np.interp(self.times_s, series.time_s, series.value)

    def angle(self, name: str) -> Floats | None:
        """As `get`, for an angle that may jump by a whole turn between two samples."""
        series = self.recording.channels.get(name)
        if series is None or not len(series):
            return None
        return np.interp(self.times_s, series.time_s, np.unwrap(series.value))

    def or_constant(self, name: str, value: float) -> tuple[Floats, bool]:
        """The channel, or a constant; and whether it was recorded."""
        found = self.get(name)
        return (np.full(self.times_s.size, value), False) if found is None else (found, True)

    def assume(self, sentence: str) -> None:
        """Note an assumption once."""
        if sentence not in self.assumptions:
            self.assumptions.append(sentence)

    def integral(self, rate: Floats) -> Floats:
        """Integral over time by the trapezoidal rule, 0 at the first instant."""
        steps = 0.5 * (rate[1:] + rate[:-1]) * np.diff(self.times_s)
        return np.concatenate(([0.0], np.cumsum(steps)))
