"""What the learning rivals may look at: residuals of the motion, commands and measured motion."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.case.runs import Run

Floats = NDArray[np.float64]
MOTION = ("_vx_mps", "_vy_mps", "_yaw_rate_radps")
INPUTS = ("speed", "steer", "throttle", "brake_tractor", "brake_trailer", "steer_rate", "blown")


@dataclass(frozen=True, eq=False)
class Stretch:
    """One run on bins.

    Attributes:
        names: m motion channels.
        left: [n, m] measured - model, SI; NaN where not measured.
        noise: [n, m] standard error of a bin from the instrument.
        inputs: [n, k] as INPUTS says, each of order one.
        bin_s: length of a bin.
    """

    names: tuple[str, ...]
    left: Floats
    noise: Floats
    inputs: Floats
    bin_s: float

    def column(self, name: str) -> Floats:
        """Residual of one channel."""
        return self.left[:, self.names.index(name)]

    def noise_of(self, name: str) -> Floats:
        """Noise of one channel."""
        return self.noise[:, self.names.index(name)]

    def less(self, prediction: Floats, names: Sequence[str]) -> Stretch:
        """The same with a prediction [n, len(names)] taken out of those channels."""
        left = self.left.copy()
        left[:, [self.names.index(n) for n in names]] -= prediction
        return replace(self, left=left)


def motion_columns(channels: Sequence[str]) -> list[int]:
    """Places of speeds and yaw rates among a run's channels."""
    return [k for k, name in enumerate(channels) if name.endswith(MOTION)]


def inputs_of(run: Run) -> Floats:
    """[n, k] commands and speed at the middle of each bin, scaled to order one."""
    times = 0.5 * (run.edges_s[1:] + run.edges_s[:-1])
    commands = np.nan_to_num(np.asarray(run.recording.inputs_at(times), dtype=np.float64))
    steer = commands[:, 0]
    speed = (run.recording.at("tractor_vx_mps", times) if "tractor_vx_mps" in run.recording
             else np.full(times.size, run.drive.initial.speed_mps))
    blown = np.zeros(times.size)
    for event in run.recording.blowouts:
        blown += times >= event.time_s
    tractor = np.maximum(commands[:, 2], commands[:, 3])
    return np.stack([np.nan_to_num(speed) / 25.0, steer, commands[:, 1], tractor / 3e5,
                     commands[:, 4] / 3e5, np.gradient(steer, times), blown], axis=1)
