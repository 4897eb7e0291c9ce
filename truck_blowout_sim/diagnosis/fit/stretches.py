"""Stretches of time that an event may take, and what each of them shows of its amount.

What ends is the sum of its parts. What grows and stays, as a load that creeps aside, is the mean of
moves at once, one at each instant of the stretch.

Validated with: test/diagnosis/test_stretches.py.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.effects.base import CHANGED_IN_S, Timing

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]


@lru_cache(maxsize=64)
def stretches(timing: Timing, count: int, earliest: int = 0, latest: int | None = None,
              apart_s: float = 0.0) -> tuple[Integers, Integers]:
    """First instant and end of every stretch among so many instants, the first ones in order.

    A ``step`` has one end, and only its first instant is free: its stretches are as long as one
    instant. A ``ramp`` is over soon; what changes over minutes is an instrument that drifts.

    Args:
        timing: of the event.
        count: how many instants; ``earliest``, ``latest``: of the first ones.
        apart_s: distance of two instants.
    """
    last = count if latest is None else latest
    longest = {"step": 1, "ramp": max(int(CHANGED_IN_S / apart_s), 1) if apart_s else count
               }.get(timing, count)
    pairs = [(first, end) for first in range(earliest, last)
             for end in range(first + 1, min(first + longest, count) + 1)]
    both = np.array(pairs, dtype=np.int64).reshape(-1, 2).T
    both.flags.writeable = False  # all who ask are given the same
    return both[0], both[1]


def of_stretches(timing: Timing, slope: Floats, bend: Floats, first: Integers, end: Integers
                 ) -> tuple[Floats, Floats]:
    """Slope and bend of the likelihood in the amount, for each stretch.

    Args:
        timing: of the event.
        slope: [n] of the response to an event at each instant; ``bend``: [n, n] of each two.
        first: [k] first instant of each stretch; ``end``: [k] one past its last.
    """
    line = np.concatenate([[0.0], np.cumsum(slope)])
    area = np.zeros((slope.size + 1, slope.size + 1))
    area[1:, 1:] = np.cumsum(np.cumsum(bend, axis=0), axis=1)
    share = parts_of(timing, first, end)
    return (share * (line[end] - line[first]),
            np.square(share) * (area[end, end] - area[first, end] - area[end, first]
                                + area[first, first]))


def parts_of(timing: Timing, first: Integers, end: Integers) -> Floats:
    """What each instant of a stretch adds."""
    return 1.0 / (end - first) if timing == "ramp" else np.ones(first.size)


def lasting(slope: Floats, bend: Floats) -> tuple[Floats, Floats]:
    """The same of what lasts from each instant on, where given are parts that last one each."""
    return (slope[::-1].cumsum()[::-1],
            bend[::-1, ::-1].cumsum(axis=0).cumsum(axis=1)[::-1, ::-1])
