"""When a vehicle slides where its model does not: what follows says little about its numbers.

From then on small differences grow. The model, driven open-loop by the recorded inputs, soon heads
elsewhere, and what it seems to lack is another in each run. So a run counts up to there. Of a long
log, what follows an episode later counts again, once both agree.

Side slip grows at the yaw rate less lateral acceleration over speed. Where this differs from the
model's by as much slip as takes a tire to the end of its linear range, neither the model nor its
sensitivities hold. The heading must differ as much, because a banked road, or an accelerometer that
leans, feigns slip alone, and a wrong steering ratio turns the path with the vehicle. What differs
within the first two seconds is taken for a gyro that is off, and its median is removed.

References: Inagaki et al. 1994 (side slip and its rate as the limit of control); Pacejka 2012,
ch. 1 (side force leaves the line at slips of 0.05 rad and peaks at 0.1 to 0.2).
Known limits: needs yaw rate, lateral acceleration and a speed that is not imposed.
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
_SAME_SPEED = 0.2  # of the model's: at a speed further off, a turn asks for other slips


@dataclass(frozen=True)
class Parting:
    """While a unit slides and the model does not, or the other way round; to the end: infinite."""

    unit: str
    at_s: float
    until_s: float = np.inf


def partings_of(edges_s: Floats, channels: Sequence[str], measured: Floats, model: Floats,
                units: Sequence[str], least_s: float) -> tuple[Parting, ...]:
    """When units, the foremost first, part from the model.

    ``measured``, ``model``: [n, m] bin means of the channels. A parting lasts for ``least_s``, and
    until nothing parts over two seconds at like speeds.
    """
    speed = f"{units[0]}_vx_mps"
    needed = {unit: (f"{unit}_yaw_rate_radps", f"{unit}_ay_mps2", speed) for unit in units}
    places = {unit: [channels.index(name) for name in names]
              for unit, names in needed.items() if all(name in channels for name in names)}
    if not places:
        return ()
    apart = {unit: _apart(edges_s, measured[:, three], model[:, three])
             for unit, three in places.items()}
    any_apart = np.logical_or.reduce(list(apart.values()))
    both = np.abs(np.stack([one[:, channels.index(speed)] for one in (measured, model)]))
    alike = np.append(False, np.abs(both[0] - both[1]) < _SAME_SPEED * both[1])
    found: list[Parting] = []
    k = _first(any_apart)
    while k < edges_s.size:
        unit = next(one for one, there in apart.items() if there[k])
        back = _first(~any_apart & alike & (edges_s >= edges_s[k] + least_s + _WITHIN_S))
        found.append(Parting(unit, float(edges_s[k]), float(edges_s[back] - _WITHIN_S)
                             if back < edges_s.size else np.inf))
        k = _first(any_apart & (np.arange(edges_s.size) > back))
    return tuple(found)


def _first(true: NDArray[np.bool_]) -> int:
    """Place of the first that is true; how many there are if none is."""
    return int(np.argmax(true)) if true.any() else true.size


def _apart(edges_s: Floats, measured: Floats, model: Floats) -> NDArray[np.bool_]:
    """[n + 1] where slip and heading of one unit both differ too much.

    ``measured``, ``model``: [n, 3] yaw rate, lateral acceleration and speed.
    """
    rates = np.nan_to_num(np.stack([_slip_rate(measured) - _slip_rate(model),
                                    measured[:, 0] - model[:, 0]]), posinf=0.0, neginf=0.0)
    apart = _adds_up(edges_s, rates)
    if apart[edges_s <= edges_s[0] + _WITHIN_S].any():
        return _adds_up(edges_s, rates - np.median(rates, axis=1)[:, None])
    return apart


def _slip_rate(signals: Floats) -> Floats:
    """[n] yaw rate less that of the path; 0 where the vehicle is slow."""
    turns, pushed, speed = signals[:, 0], signals[:, 1], np.abs(signals[:, 2])
    return np.where(speed > _FAST_MPS, turns - pushed / np.maximum(speed, _FAST_MPS), 0.0)


def _adds_up(edges_s: Floats, rates: Floats) -> NDArray[np.bool_]:
    """[n + 1] where both of two rates [2, n] add up to too much within the last two seconds."""
    total = np.pad(np.cumsum(rates * np.diff(edges_s), axis=1), ((0, 0), (1, 0)))
    return np.logical_and.reduce([
        np.abs(one - np.interp(edges_s - _WITHIN_S, edges_s, one)) > _PARTED_RAD for one in total])
