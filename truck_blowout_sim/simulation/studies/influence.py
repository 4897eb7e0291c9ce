"""How much of what differs between the runs of a study each varied key explains.

References: first-order sensitivity, the variance of the mean at each value over the variance of
all (Sobol 1993; correlation ratio, Pearson 1905). Values of a range are put into bins.
Known limits: what two keys do only together is in neither share; with few runs a value, chance
adds to the share, which is corrected as for a correlation ratio (Kelley 1935).
Validated with: test/simulation/test_sweep.py.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.simulation.studies.keys import scale_of

Floats = NDArray[np.float64]
_BINS = 8


def groups(values: Sequence[float | str]) -> tuple[list[str], NDArray[np.int64]]:
    """Labels of the values of a key, and which one each run has; many numbers go into bins."""
    scales = [scale_of(v) for v in values]
    if scales and None not in scales:
        labels, at = groups([s for s in scales if s is not None])
        return [f"{label}x" for label in labels], at
    if any(isinstance(v, str) for v in values):
        labels = list(dict.fromkeys(str(v) for v in values))
        return labels, np.array([labels.index(str(v)) for v in values])
    numbers = np.array(values, dtype=np.float64)
    unique = np.unique(numbers)
    if unique.size <= _BINS + 2:
        return [f"{v:g}" for v in unique], np.searchsorted(unique, numbers)
    edges = np.quantile(numbers, np.linspace(0.0, 1.0, _BINS + 1))
    at = np.clip(np.searchsorted(edges, numbers, side="right") - 1, 0, _BINS - 1)
    return [f"{a:.3g} to {b:.3g}" for a, b in pairwise(edges)], at


def share_explained(at: NDArray[np.int64], outcome: Floats) -> float:
    """Share (0 to 1) of an outcome's variance between groups; NaN outcomes are left out."""
    known = np.isfinite(outcome)
    y, at = outcome[known], at[known]
    whole = float(np.sum((y - y.mean()) ** 2)) if y.size else 0.0
    kinds = np.unique(at)
    if whole <= 0.0 or kinds.size < 2 or y.size <= kinds.size:
        return 0.0
    within = float(sum(np.sum((y[at == k] - y[at == k].mean()) ** 2) for k in kinds))
    adjusted = 1.0 - (within / (y.size - kinds.size)) / (whole / (y.size - 1))
    return float(np.clip(adjusted, 0.0, 1.0))
