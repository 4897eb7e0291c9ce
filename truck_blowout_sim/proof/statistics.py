"""Proportions with their uncertainty, medians, percentiles.

References: E. B. Wilson, "Probable inference", JASA 22 (1927) 209-212; J. N. K. Rao and A. J.
Scott, "A simple method for the analysis of clustered binary data", Biometrics 48 (1992) 577-585.
Known limits: with all or none of the trials hit, clusters show no scatter and count as one each
trial.
Validated with: test/proof/test_statistics.py.
"""

from __future__ import annotations

import math
from collections import Counter
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


def wilson(hits: float, trials: float, z: float = _Z95) -> tuple[float, float]:
    """Wilson score interval of a proportion; both may be effective numbers of clustered trials.

    Raises:
        ValueError: no trials, or hits outside 0..trials.
    """
    if trials <= 0 or not 0 <= hits <= trials:
        raise ValueError(f"{hits} of {trials} is no proportion")
    p, n = hits / trials, float(trials)
    middle = (p + z * z / (2.0 * n)) / (1.0 + z * z / n)
    half = z / (1.0 + z * z / n) * math.sqrt(p * (1.0 - p) / n + z * z / (4.0 * n * n))
    return max(0.0, middle - half), min(1.0, middle + half)


def clustered(trials: Sequence[tuple[str, bool]]) -> tuple[float, float]:
    """Wilson interval of trials that come in clusters, each given by its cluster's name.

    Hits and trials are divided by the design effect, how many times the scatter between clusters
    exceeds that of independent trials (Rao and Scott 1992), at least 1.

    Raises:
        ValueError: no trials.
    """
    sizes, hits = Counter(name for name, _ in trials), Counter(name for name, hit in trials if hit)
    total, clusters, found = len(trials), len(sizes), sum(hits.values())
    p = found / total if total else 0.0
    if clusters < 2 or found in (0, total):
        return wilson(found, total)
    spread = sum((hits[name] - p * size)**2 for name, size in sizes.items())
    effect = max(1.0, clusters / (clusters - 1) * spread / (total * p * (1.0 - p)))
    return wilson(found / effect, total / effect)


def proportion(flags: Iterable[bool | None]) -> Proportion:
    """Count what is true; None does not count as a trial."""
    known = [flag for flag in flags if flag is not None]
    return Proportion(sum(known), len(known))


def quantile(values: Sequence[float], share: float) -> float | None:
    """Linear-interpolated quantile; None of nothing."""
    return float(np.quantile(values, share)) if len(values) else None
