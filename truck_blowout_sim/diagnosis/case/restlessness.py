"""How restless each channel is where nothing is missing: the widths of the bins, second pass.

The stated difference between good models is a first guess. What the fit leaves of a channel in the
baseline runs, where nothing is missing, shows how far this model differs from this truck, and how
long such a difference lasts: the long-run variance of the whitened residual, 1 where the guess is
right. A channel that is more restless than the guess is widened by its root, in every run. Without
baseline runs the training runs are asked.

References: Newey and West 1987 (long-run variance with a Bartlett window); Friston et al. 2002
(estimated variance components in brain imaging).
Known limits: without baseline runs an effect at work is restless, too, and hides in part; a channel
that is calmer than the guess is not narrowed.
Validated with: test/diagnosis/test_restlessness.py (noise of known colour; no false widening).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.case.study import Study, row_ranges

Floats = NDArray[np.float64]
_WINDOW_S = 1.0
_FEWEST_WINDOWS = 4  # as many are needed to tell a variance at all


def long_run_variance(series: Floats, lags: int) -> float:
    """Variance of the sum of a zero-mean series, a sample: Bartlett weights up to ``lags``."""
    n = series.size
    total = float(series @ series)
    for lag in range(1, min(lags, n - 1) + 1):
        total += 2.0 * (1.0 - lag / (lags + 1.0)) * float(series[lag:] @ series[:-lag])
    return max(total / n, 0.0)


def widths(study: Study) -> Mapping[str, float]:
    """Factor on the width of each channel that the baseline runs ask for, 1 or more.

    Training runs are asked where there are none: an effect at work is restless, too, and hides in
    part, but noise with a color of its own is no longer taken for one.
    """
    residual = study.residual()
    projector = study.projector()
    left = residual - projector.explained(projector.amounts(residual))
    lags = round(_WINDOW_S / study.settings.bin_s)
    sums: dict[str, list[tuple[float, int]]] = {}
    for i in study.baseline or study.train:
        run, rows = study.runs[i], row_ranges(study)[i]
        cube = left[rows].reshape(run.measured.shape)
        for k, name in enumerate(run.channels):
            seen = np.isfinite(run.measured[:, k])
            if seen.sum() >= _FEWEST_WINDOWS * lags:
                part = cube[seen, k]
                sums.setdefault(name, []).append((long_run_variance(part, lags), part.size))
    return {name: max(float(np.sqrt(np.average([v for v, _ in parts],
                                               weights=[n for _, n in parts]))), 1.0)
            for name, parts in sums.items()}


def widen(study: Study) -> None:
    """Widen every channel that the runs show to be more restless than was guessed."""
    factors = widths(study)
    if all(factor == 1.0 for factor in factors.values()):
        return
    scales = [np.array([factors.get(name, 1.0) for name in run.channels])
              for run in (*study.runs, *study.holdout)]
    runs = [replace(run, sigma=run.sigma * scale)
            for run, scale in zip((*study.runs, *study.holdout), scales, strict=True)]
    n = len(study.runs)
    rows = np.concatenate([np.tile(scale, run.measured.shape[0])
                           for run, scale in zip(runs[:n], scales[:n], strict=True)])
    study.columns = study.columns / rows[:, None]
    study.holdout_columns = [
        columns / np.tile(scale, run.measured.shape[0])[:, None] for columns, run, scale in zip(
            study.holdout_columns, runs[n:], scales[n:], strict=True)]
    study.runs, study.holdout = tuple(runs[:n]), tuple(runs[n:])
    study.forget()
