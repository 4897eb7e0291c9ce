"""One line of the validation table, and what turns recordings into its numbers."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.vehicle.units import FOOT_M, MILE_PER_HOUR_MPS

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Row:
    """What a published figure says and what the model gives.

    Attributes:
        key: number of the figure, such as V7.
        quantity: what is measured.
        target: the published figure, with its unit.
        value: the model's, with its unit.
        met: inside the tolerance; None where the figure cannot be held against a model.
        note: why not, or what to keep in mind.
    """

    key: str
    quantity: str
    target: str
    value: str
    met: bool | None
    note: str = ""


def at(recording: Recording, name: str, time_s: float) -> float:
    """Value of a channel at an instant."""
    return float(recording.at(name, time_s))


def window(recording: Recording, name: str, start_s: float, end_s: float) -> Floats:
    """Samples of a channel in an interval."""
    return recording[name].between(start_s, end_s).value


def mph(speed_mps: float) -> float:
    """Miles per hour."""
    return speed_mps / MILE_PER_HOUR_MPS


def feet(length_m: float) -> float:
    """Feet."""
    return length_m / FOOT_M


def path_length_m(recording: Recording, start_s: float, end_s: float) -> float:
    """Length of the tractor's path in an interval."""
    part = recording.between(start_s, end_s)
    x, y = part["tractor_x_m"].value, part["tractor_y_m"].value
    return float(np.hypot(np.diff(x), np.diff(y)).sum())


def yaw_rate_degps(recording: Recording, unit: str, start_s: float, end_s: float) -> Floats:
    """Yaw rate in degrees a second, to the left positive."""
    return np.degrees(window(recording, f"{unit}_yaw_rate_radps", start_s, end_s))
