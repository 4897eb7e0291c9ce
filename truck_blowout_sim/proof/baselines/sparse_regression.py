"""A sparse law of the residual accelerations, after SINDy with control.

With e the residuals of speeds and yaw rates and u the inputs, de/dt = -e/tau + Xi theta(u). Xi is
fitted by sequentially thresholded least squares; tau is taken from a grid by what the integrated
law leaves in training. A law with free feedback of e ran away on runs it had not seen; the leak is
stable by construction. The optimizer is PySINDy's STLSQ where that package is installed, the same
algorithm written here otherwise.

References: S. L. Brunton, J. L. Proctor, J. N. Kutz, PNAS 113 (2016) 3932-3937.
Validated with: test/proof/test_baselines.py (finds a known law).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from importlib import import_module
from importlib.util import find_spec
from typing import Any

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.proof.baselines.features import INPUTS, Stretch

Floats = NDArray[np.float64]
THRESHOLD = 0.05  # of the spread of an acceleration, for terms scaled to unit spread
RIDGE = 1.0  # for terms scaled to unit mean square; a weak one let speeds never seen run away
LEAKS_S = (0.5, 2.0, 8.0)
_SMOOTH = 5  # bins over which a residual is averaged before it is differentiated


@dataclass(frozen=True, eq=False)
class Law:
    """Coefficients [channels, terms] of SI accelerations, and the leak's time constant."""

    coefficients: Floats
    leak_s: float


def optimizer_name() -> str:
    """Whose thresholded least squares is used."""
    return "pysindy.STLSQ" if find_spec("pysindy") else "own STLSQ"


def terms(inputs: Floats) -> Floats:
    """[n, terms]: 1, inputs, speed^2, speed x steer, speed^2 x steer, steer^3, sign(steer)."""
    speed, steer = inputs[:, INPUTS.index("speed")], inputs[:, INPUTS.index("steer")]
    products = np.stack([speed**2, speed * steer, speed**2 * steer, steer**3, np.sign(steer)], 1)
    return np.concatenate([np.ones((speed.size, 1)), inputs, products], axis=1)


def fit_law(learned: Sequence[Stretch], names: Sequence[str]) -> Law:
    """The law that training runs ask for."""
    laws = [_fit_with_leak(learned, names, leak) for leak in LEAKS_S]
    return min(laws, key=lambda law: _left(law, learned, names))


def _left(law: Law, learned: Sequence[Stretch], names: Sequence[str]) -> float:
    """Sum of squares in noise that the integrated law leaves."""
    total = 0.0
    for s in learned:
        noise = np.stack([s.noise_of(n) for n in names], axis=1)
        total += float(np.nansum(((_filled(s, names) - integrate(law, s, names)) / noise) ** 2))
    return total


def _fit_with_leak(learned: Sequence[Stretch], names: Sequence[str], leak_s: float) -> Law:
    theta, rates = [], []
    for s in learned:
        smooth = np.apply_along_axis(_averaged, 0, _filled(s, names))
        theta.append(terms(s.inputs))
        rates.append(np.gradient(smooth, s.bin_s, axis=0) + smooth / leak_s)
    x, y = np.concatenate(theta), np.concatenate(rates)
    wide = np.sqrt(np.mean(x**2, axis=0))
    wide = np.where(wide > 1e-9, wide, np.inf)
    spread = np.maximum(np.sqrt(np.mean(y**2, axis=0)), 1e-12)
    return Law(thresholded(x / wide, y / spread) * spread[:, None] / wide, leak_s)


def thresholded(x: Floats, y: Floats) -> Floats:
    """Coefficients [targets, terms] of y = x c, small ones thrown out and the rest fitted anew."""
    if find_spec("pysindy"):
        stlsq: Any = import_module("pysindy").STLSQ
        return np.asarray(stlsq(threshold=THRESHOLD, alpha=RIDGE, unbias=False).fit(x, y).coef_)
    return own_stlsq(x, y)


def own_stlsq(x: Floats, y: Floats, rounds: int = 20) -> Floats:
    """Sequentially thresholded ridge regression; coefficients [targets, terms]."""
    found = np.zeros((y.shape[1], x.shape[1]))
    for k in range(y.shape[1]):
        keep = np.ones(x.shape[1], dtype=bool)
        for _ in range(rounds):
            part = x[:, keep]
            fit = np.linalg.solve(part.T @ part + RIDGE * np.eye(part.shape[1]), part.T @ y[:, k])
            found[k] = 0.0
            found[k, keep] = fit
            smaller = keep & (np.abs(found[k]) >= THRESHOLD)
            if (smaller == keep).all():
                break
            keep = smaller
        found[k, ~keep] = 0.0
    return found


def integrate(law: Law, unseen: Stretch, names: Sequence[str]) -> Floats:
    """[n, len(names)] residual that the law predicts from rest."""
    rates = terms(unseen.inputs) @ law.coefficients.T
    kept = np.exp(-unseen.bin_s / law.leak_s)
    e = np.zeros((rates.shape[0], len(names)))
    for k in range(1, e.shape[0]):
        e[k] = kept * e[k - 1] + (1.0 - kept) * law.leak_s * rates[k - 1]
    return e


def _filled(stretch: Stretch, names: Sequence[str]) -> Floats:
    """[n, len(names)] residuals, gaps bridged."""
    columns = []
    for name in names:
        y = stretch.column(name).copy()
        seen = np.isfinite(y)
        known = np.flatnonzero(seen)
        y[~seen] = np.interp(np.flatnonzero(~seen), known, y[known]) if known.size else 0.0
        columns.append(y)
    return np.stack(columns, axis=1)


def _averaged(y: Floats) -> Floats:
    """Running mean; the ends average what there is."""
    window = np.ones(_SMOOTH)
    return np.convolve(y, window, "same") / np.convolve(np.ones_like(y), window, "same")
