"""Find the severity that gives a wanted detectability."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from proving_ground.cases import EffectSpec, FaultSpec

LOWEST, HIGHEST = 1.0e-3, 2.0
CLOSE_ENOUGH = 0.15      # in the logarithm of sigma


@dataclass(frozen=True)
class Calibrated:
    """Severity found for a wanted detectability, what was reached, and by which channel."""

    severity: float
    sigma: float
    channel: str


def search(spec: EffectSpec | FaultSpec, power: Callable[[float], tuple[float, str]],
           lowest: float) -> Calibrated:
    """Severity whose detectability is the wanted one, by secants in logarithms."""
    severity = spec.severity
    sigma, channel = power(severity)
    if spec.sigma is None:
        return _rounded(severity, sigma, channel)
    slope, best = 1.0, (abs(np.log(max(sigma, 1e-9) / spec.sigma)), severity, sigma, channel)
    for _ in range(6):
        if best[0] < CLOSE_ENOUGH:
            break
        step = float(np.log(spec.sigma / max(sigma, 1e-9)) / slope)
        trial = float(np.clip(severity * np.exp(np.clip(step, -3.0, 3.0)), lowest, HIGHEST))
        trial = float(f"{trial:.3g}")
        if trial == severity:
            break
        try:
            reached, channel = power(trial)
        except FloatingPointError:
            break          # stronger than the truck can bear
        rise = float(np.log(max(reached, 1e-9) / max(sigma, 1e-9)) / np.log(trial / severity))
        slope = float(np.clip(rise, 0.3, 3.0))
        severity, sigma = trial, reached
        miss = abs(np.log(max(sigma, 1e-9) / spec.sigma))
        if miss < best[0]:
            best = (miss, severity, sigma, channel)
    return _rounded(best[1], best[2], best[3])


def from_guess(spec: EffectSpec) -> EffectSpec:
    """The effect with the severity where its search begins."""
    if spec.sigma is None:
        return spec
    start = min(HIGHEST, max(spec.kind.lowest, spec.sigma / spec.kind.guess))
    return replace(spec, severity=float(f"{start:.3g}"))


def _rounded(severity: float, sigma: float, channel: str) -> Calibrated:
    return Calibrated(severity, float(f"{sigma:.3g}"), channel)
