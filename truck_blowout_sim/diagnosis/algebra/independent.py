"""How many independent questions correlated ones are, and what chance reaches in any of them.

Reference: Li and Ji, Heredity 95 (2005) 221-227.
Validated with: test/diagnosis/test_scatter.py.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def independent_among(shared: Floats) -> float:
    """How many independent questions are asked, from their sums of squares and products [k, k]."""
    size = np.sqrt(np.maximum(np.diag(shared), 0.0))
    seen = size > 1e-5 * max(float(size.max(initial=0.0)), 1e-12)
    if not seen.any():
        return 1.0
    alike = shared[np.ix_(seen, seen)] / np.outer(size[seen], size[seen])
    found = np.abs(np.linalg.eigvalsh(alike))
    return max(float(np.sum((found >= 1.0) + (found - np.floor(found)))), 1.0)


def in_any(alone: float, questions: float) -> float:
    """Chance of something in any of independent questions that has the chance ``alone`` in one."""
    return float(-np.expm1(questions * np.log1p(-min(alone, 1.0 - 1e-15))))
