"""Proportions with their uncertainty, medians, percentiles.

References: E. B. Wilson, "Probable inference", JASA 22 (1927) 209-212.
Validated with: test/proof/test_statistics.py.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

_Z95 = 1.959963984540054


@dataclass(frozen=True)
class Proportion:
    """``hits`` of ``trials`` with the Wilson interval that covers with 95 %."""

    hits: int
    trials: int

    @property
    def value(self) -> float | None:
        """Hits over trials; None if there was no trial."""
        return self.hits / self.trials if self.trials else None

    @property
    def interval(self) -> tuple[float, float] | None:
        """Wilson score interval."""
        return wilson(self.hits, self.trials) if self.trials else None

    def __str__(self) -> str:
        if not self.trials:
            return "–"
        low, high = wilson(self.hits, self.trials)
        return (f"{100 * self.hits / self.trials:.0f} % ({self.hits}/{self.trials}; "
                f"{100 * low:.0f}–{100 * high:.0f})")

    def as_json(self) -> dict[str, object]:
        """Plain objects."""
        return {"hits": self.hits, "trials": self.trials, "value": self.value,
                "wilson95": None if self.interval is None else list(self.interval)}


def wilson(hits: int, trials: int, z: float = _Z95) -> tuple[float, float]:
    """Wilson score interval of a proportion.

    Raises:
        ValueError: no trials, or hits outside 0..trials.
    """
    if trials < 1 or not 0 <= hits <= trials:
        raise ValueError(f"{hits} of {trials} is no proportion")
    p, n = hits / trials, float(trials)
    middle = (p + z * z / (2.0 * n)) / (1.0 + z * z / n)
    half = z / (1.0 + z * z / n) * math.sqrt(p * (1.0 - p) / n + z * z / (4.0 * n * n))
    return max(0.0, middle - half), min(1.0, middle + half)


def proportion(flags: Iterable[bool | None]) -> Proportion:
    """Count what is true; None does not count as a trial."""
    known = [flag for flag in flags if flag is not None]
    return Proportion(sum(known), len(known))


def quantile(values: Sequence[float], share: float) -> float | None:
    """Linear-interpolated quantile; None of nothing."""
    return float(np.quantile(values, share)) if len(values) else None
