"""Unbroken stretches of samples.

Validated with: test/recordings/test_stretches.py.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def unbroken(chosen: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """First and one past the last index of each unbroken stretch of chosen samples."""
    edges = np.flatnonzero(np.diff(np.concatenate(([0], chosen.astype(np.int8), [0]))))
    return [(int(first), int(end)) for first, end in edges.reshape(-1, 2)]
