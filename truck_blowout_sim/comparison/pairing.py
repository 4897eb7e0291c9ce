"""Model and measurement side by side: at the instants of the measurement, in its own conventions.

Nothing measured is resampled: the model's output, which is even and dense, is interpolated to the
measured instants. Headings are unwrapped; accelerations that a recording calls free of gravity are
compared with model accelerations that are.

Validated with: test/comparison/test_pairing.py.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.comparison.units import DisplayUnit, display_unit
from truck_blowout_sim.recordings import INPUT_NAMES, Recording
from truck_blowout_sim.recordings.gravity import ACCELERATIONS, gravity_felt, gravity_is_removed

Floats = NDArray[np.float64]

_FIRST_S = 1.0


@dataclass(frozen=True, eq=False)
class Pair:
    """One channel, measured and simulated, at the same instants; SI."""

    name: str
    time_s: Floats
    measured: Floats
    model: Floats

    @property
    def error(self) -> Floats:
        """Model minus measurement."""
        return self.model - self.measured

    @property
    def rms(self) -> float:
        """Root of the error's mean square."""
        return float(np.sqrt(np.mean(self.error**2)))

    @property
    def unit(self) -> DisplayUnit:
        """Unit to show it in."""
        return display_unit(self.name)


def pairs_of(recording: Recording, model: Recording) -> dict[str, Pair]:
    """Every output channel that both have, and each unit's position along and across its course.

    Channels without two common instants are left out.
    """
    found = {pair.name: pair for pair in _channels(recording, model)}
    for unit in ("tractor", "trailer"):
        found |= {pair.name: pair for pair in _position(recording, found, unit)}
    return found


def _channels(recording: Recording, model: Recording) -> Iterator[Pair]:
    for name, series in recording.channels.items():
        # A spin angle counts turns from an arbitrary start; the spin speed says the same.
        if name in INPUT_NAMES or name not in model or name.startswith("hub_spin_angle_"):
            continue
        simulated = model.at(name, series.time_s)
        if gravity_is_removed(recording, name.partition("_")[0]):
            simulated = simulated - _gravity(model, name, series.time_s)
        both = np.isfinite(simulated)
        if np.count_nonzero(both) < 2:
            continue
        measured, simulated = series.value[both], simulated[both]
        if name.endswith("_yaw_rad"):
            measured, simulated = _unwrapped(measured, simulated)
        yield Pair(name, series.time_s[both], measured, simulated)


def _gravity(model: Recording, name: str, time_s: Floats) -> Floats:
    """Share of gravity in a simulated acceleration; 0 for other channels."""
    unit, _, stem = name.partition("_")
    if stem not in ACCELERATIONS:
        return np.zeros_like(time_s)
    return gravity_felt(stem, *(model.at(f"{unit}_{angle}_rad", time_s)
                                for angle in ("roll", "pitch")))


def _unwrapped(measured: Floats, simulated: Floats) -> tuple[Floats, Floats]:
    """Headings without jumps, on the same turn at the start."""
    measured, simulated = (np.asarray(np.unwrap(one), dtype=np.float64)
                           for one in (measured, simulated))
    turns = np.round((measured[0] - simulated[0]) / (2 * np.pi))
    return measured, simulated + 2 * np.pi * turns


def _position(recording: Recording, pairs: dict[str, Pair], unit: str) -> Iterator[Pair]:
    """Position turned into the direction in which the unit set out."""
    x, y = pairs.get(f"{unit}_x_m"), pairs.get(f"{unit}_y_m")
    if x is None or y is None or not np.array_equal(x.time_s, y.time_s):
        return
    course = _course(recording, unit)
    cos, sin = np.cos(course), np.sin(course)
    x0, y0 = x.measured[0], y.measured[0]

    def turned(along: float, across: float) -> tuple[Floats, Floats]:
        return (
            along * (x.measured - x0) + across * (y.measured - y0),
            along * (x.model - x0) + across * (y.model - y0),
        )

    yield Pair(f"{unit}_along_m", x.time_s, *turned(cos, sin))
    yield Pair(f"{unit}_across_m", x.time_s, *turned(-sin, cos))


def _course(recording: Recording, unit: str) -> float:
    """Direction of travel over the first second: from the heading, else from the positions."""
    yaw = recording.channels.get(f"{unit}_yaw_rad")
    if yaw is not None and len(yaw):
        first = yaw.between(yaw.time_s[0], yaw.time_s[0] + _FIRST_S).value
        return float(np.arctan2(np.sin(first).mean(), np.cos(first).mean()))
    start = recording.start_s
    x, y = (recording[f"{unit}_{axis}_m"].between(start, start + _FIRST_S) for axis in "xy")
    if len(x) < 2 or len(y) < 2:
        return 0.0
    return float(np.arctan2(y.value[-1] - y.value[0], x.value[-1] - x.value[0]))
