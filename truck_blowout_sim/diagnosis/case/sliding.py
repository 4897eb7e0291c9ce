"""When a vehicle slides where its model does not: what follows says little about its numbers.

From then on small differences grow. The model, driven open-loop by the recorded inputs, soon heads
elsewhere, and what it seems to lack is another in each run. So a run counts up to there.

Side slip grows at the yaw rate less lateral acceleration over speed. Where this differs from the
model's by as much slip as takes a tire to the end of its linear range, neither the model nor its
sensitivities hold. The heading must differ as much, because a banked road, or an accelerometer that
leans, feigns slip alone, and a wrong steering ratio turns the path with the vehicle. What differs
within the first two seconds is taken for a gyro that is off, and its median is removed.

References: Inagaki et al. 1994 (side slip and its rate as the limit of control); Pacejka 2012,
ch. 1 (side force leaves the line at slips of 0.05 rad and peaks at 0.1 to 0.2).
Known limits: needs yaw rate, lateral acceleration and speed; of a long log, what comes after the
first slide does not count, though the vehicle may drive on.
Validated with: test/diagnosis/test_sliding.py.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
_PARTED_RAD = 0.05  # side slip at which a tire's linear range ends
_WITHIN_S = 2.0
_FAST_MPS = 5.0  # slower, a small acceleration is a large angle


@dataclass(frozen=True)
class Parting:
    """Where a unit slides and the model does not, or the other way round."""

    unit: str
    at_s: float


def parting_of(edges_s: Floats, channels: Sequence[str], measured: Floats, model: Floats,
               units: Sequence[str]) -> Parting | None:
    """Where the first of some units, the foremost first, parts from the model; None: nowhere.

    ``measured``, ``model``: [n, m] bin means of the channels.
    """
    partings = [one for unit in units
                if (one := _one_parting(edges_s, channels, measured, model, unit, units[0]))]
    return min(partings, key=lambda one: one.at_s, default=None)


def _one_parting(edges_s: Floats, channels: Sequence[str], measured: Floats, model: Floats,
                 unit: str, foremost: str) -> Parting | None:
    """Where slip and heading of one unit both differ too much.

    None, too, where a channel is not recorded.
    """
    names = (f"{unit}_yaw_rate_radps", f"{unit}_ay_mps2", f"{foremost}_vx_mps")
    if not all(name in channels for name in names):
        return None
    turns, pushed, speed = (channels.index(name) for name in names)

    def slips(signals: Floats) -> Floats:
        fast = np.abs(signals[:, speed])
        grows = signals[:, turns] - signals[:, pushed] / np.maximum(fast, _FAST_MPS)
        return np.where(fast > _FAST_MPS, grows, 0.0)

    rates = np.nan_to_num(np.stack([slips(measured) - slips(model),
                                    measured[:, turns] - model[:, turns]]),
                          posinf=0.0, neginf=0.0)
    at_s = _first_apart(edges_s, rates)
    if at_s <= edges_s[0] + _WITHIN_S:
        at_s = _first_apart(edges_s, rates - np.median(rates, axis=1)[:, None])
    return Parting(unit, at_s) if np.isfinite(at_s) else None


def _first_apart(edges_s: Floats, rates: Floats) -> float:
    """Where both of two rates [2, n] add up to too much within two seconds; infinite: nowhere."""
    total = np.cumsum(rates * np.diff(edges_s), axis=1)
    apart = np.ones(edges_s.size, dtype=np.bool_)
    for one in np.pad(total, ((0, 0), (1, 0))):
        apart &= np.abs(one - np.interp(edges_s - _WITHIN_S, edges_s, one)) > _PARTED_RAD
    return float(edges_s[apart][0]) if apart.any() else np.inf
