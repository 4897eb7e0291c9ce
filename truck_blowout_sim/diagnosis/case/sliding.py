"""When a vehicle slides where its model does not: what follows says little about its numbers.

From then on small differences grow. The model, driven open-loop by the recorded inputs, soon heads
elsewhere, and what it seems to lack is another in each run. So a run counts up to there.

Side slip grows at the yaw rate less lateral acceleration over speed. Where this differs from the
model's by more than the slip at which a tire holds best, the tires are on the other side of their
peak; the heading must differ as much, because an accelerometer that leans, or a banked road, feigns
slip alone, and a wrong steering ratio turns the path with the vehicle. What adds up within two
seconds tells a slide from an offset of a gyro.

References: Inagaki et al. 1994 (side slip and its rate as the limit of control); Pacejka 2012,
ch. 1 and 4 (side force peaks at slips of 0.1 to 0.2 rad).
Known limits: needs yaw rate, lateral acceleration and speed; of a model that slides elsewhere than
the vehicle as well, only the first parting is seen.
Validated with: test/diagnosis/test_sliding.py.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
_PARTED_RAD = 0.1  # side slip at which tires of cars hold best; those of trucks at 0.1 to 0.2
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

    slip = _within(edges_s, slips(measured) - slips(model))
    heading = _within(edges_s, measured[:, turns] - model[:, turns])
    apart = np.flatnonzero(np.minimum(slip, heading) > _PARTED_RAD)
    return Parting(unit, float(edges_s[apart[0]])) if apart.size else None


def _within(edges_s: Floats, rate: Floats) -> Floats:
    """Size of what a rate [n] adds up to within two seconds, at each of the edges [n + 1].

    What is not measured adds nothing.
    """
    total = np.concatenate(([0.0], np.cumsum(np.nan_to_num(rate) * np.diff(edges_s))))
    return np.asarray(np.abs(total - np.interp(edges_s - _WITHIN_S, edges_s, total)))

