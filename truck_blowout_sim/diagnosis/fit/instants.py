"""Instants at which an event is tried in a run."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.case.runs import EDGE_S, Run
from truck_blowout_sim.diagnosis.effects import Effect

Floats = NDArray[np.float64]
_GRID_S = 1.0
_MOST_INSTANTS = 20
PARTS = 5  # of the distance between two instants
_DELAYED_OVER = 3  # instants: so long, what a ramp does hardly depends on when it begins


def grid_of(run: Run, effect: Effect) -> Floats:
    """Instants of an effect simulated in a run."""
    return np.arange(run.edges_s[0] + EDGE_S, run.edges_s[-1] - EDGE_S,
                     spacing_s(run) * (_DELAYED_OVER if effect.timing == "ramp" else 1))


def spacing_s(run: Run) -> float:
    """Distance of the instants tried in a run: a second, more in long runs."""
    return max(_GRID_S, run.length_s / _MOST_INSTANTS)


def delayed(change: Floats, bins: int) -> Floats:
    """What an event changes [n, m], had it come so many bins later; nothing past the end."""
    moved = np.zeros(change.shape)
    moved[bins:] = change[:max(change.shape[0] - bins, 0)]
    return moved


def bins_between(effect: Effect, run: Run, bin_s: float) -> range:
    """By how many bins to delay the response to one instant tried, up to the next instant.

    What a ramp does soon after it begins is as short as the ramp; other events begin slowly enough.
    """
    if effect.timing != "ramp":
        return range(1)
    apart = spacing_s(run) / bin_s
    return range(0, round(_DELAYED_OVER * apart), max(round(apart / PARTS), 1))
