"""How restless each channel is where nothing is missing: the widths of the bins, second pass.

The stated difference between good models is a first guess. What the fit leaves of a channel in the
baseline runs, where nothing is missing, shows how far this model differs from this truck, and how
long such a difference lasts: the long-run variance of the whitened residual, 1 where the guess is
right. A channel that is more restless than the guess is widened by its root, in every run. Its
color is not taken over: a model errs by the maneuver, and training drives others.

Without baseline runs only the training runs tell. There an effect must stand out of what the
channel does at all times: its color is taken out of every run (`color.py`), and one that is calmer
in the long run than the guess keeps its color and is raised to the guess. A gauge of a tire shows
its color only while the tire holds its air.

References: Newey and West 1987 (long-run variance with a Bartlett window); Friston et al. 2002
(estimated variance components in brain imaging); Worsley et al. 2002 (autoregressions there).
Known limits: without baseline runs an effect at work is restless, too, and hides in part; a channel
that is calmer than the guess is not narrowed.
Validated with: test/diagnosis/test_restlessness.py (noise of known colour; no false widening).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.algebra.color import Color, autocovariance
from truck_blowout_sim.diagnosis.algebra.linear import Projector
from truck_blowout_sim.diagnosis.case.emptying import began_to_empty_s
from truck_blowout_sim.diagnosis.case.runs import Run
from truck_blowout_sim.diagnosis.case.study import Study, row_ranges

Floats = NDArray[np.float64]
_LASTS_S = 1.0  # as far back as a bin is foretold from
_GUESS = 0.02  # weight of the guess beside what a run shows
_FEWEST_WINDOWS = 4  # as many are needed to tell a variance at all


def long_run_variance(covariance: Floats) -> float:
    """Variance of the sum of a series, a sample, from its autocovariance; Bartlett weights."""
    lags = covariance.size - 1
    weights = 1.0 - np.arange(1, lags + 1) / (lags + 1.0)
    return max(float(covariance[0] + 2.0 * weights @ covariance[1:]), 0.0)


def colors(study: Study) -> Mapping[str, Color]:
    """Of each channel: white and wide enough beside baseline runs, else as training leaves it."""
    return {name: _wide_enough(one) if study.baseline else _no_calmer_than_guessed(one)
            for name, one in _autocovariances(study).items()}


def _left_of_telling(study: Study) -> Floats:
    """[rows] what is left in the runs that tell, zero elsewhere.

    Baseline runs are fitted alone: what is missing in training would pull the sheet, and the gains
    of its channels, away from them, and so excuse itself.
    """
    if not study.baseline:
        return study.projector().remove(study.residual())
    residual, ranges = study.residual(), row_ranges(study)
    rows = np.concatenate([np.arange(ranges[i].start, ranges[i].stop) for i in study.baseline])
    left = np.zeros_like(residual)
    left[rows] = Projector.of(study.columns[rows]).remove(residual[rows])
    return left


def _autocovariances(study: Study) -> Mapping[str, Floats]:
    """[lags + 1] of what is left of each channel in the runs that tell, in widths."""
    left = _left_of_telling(study)
    lags, rows = round(_LASTS_S / study.settings.bin_s), row_ranges(study)
    sums, counts = dict[str, Floats](), dict[str, int]()
    for i in study.baseline or study.train:
        run = study.runs[i]
        z = run.color.colored(left[rows[i]].reshape(run.measured.shape))
        for k, name in enumerate(run.channels):
            resting = run.edges_s[1:] <= _holds_air_until_s(run, name)
            seen = np.isfinite(run.measured[:, k]) & resting
            if seen.sum() >= _FEWEST_WINDOWS * lags:
                sums[name] = sums.get(name, 0.0) + autocovariance(z[seen, k], lags)
                counts[name] = counts.get(name, 0) + int(seen.sum())
    return {name: sums[name] / counts[name] for name in sums}


def _holds_air_until_s(run: Run, channel: str) -> float:
    """Up to when a channel tells how it rests: a gauge of a tire, while this holds its air.

    Else the emptying of a tire would be the color of its gauge, and hide.
    """
    if not channel.startswith("tire_pressure_"):
        return np.inf
    began = began_to_empty_s(run.recording[channel])
    return np.inf if began is None else began


def _wide_enough(covariance: Floats) -> Color:
    """White, of the long-run variance, 1 at least."""
    return Color.of(np.array([[max(long_run_variance(covariance), 1.0)]]))


def _no_calmer_than_guessed(covariance: Floats) -> Color:
    """The color, raised until its long-run variance is the guess's where it is less.

    A little of the guess, white, keeps the whole from foretelling what only these runs did.
    """
    mixed = (covariance + _GUESS * np.eye(1, covariance.size)[0]) / (1.0 + _GUESS)
    color = Color.of(mixed[None])
    calm = float(color.surprise[0, -1] / (1.0 - color.foretold[0, -1].sum()))
    return Color.of(mixed[None] / min(calm, 1.0)**2)


def resting_level(study: Study) -> float:
    """Mean square that the fit leaves a row of the runs that tell, once their color is out.

    1 at most; less where channels are calmer than the guess.
    """
    left, rows = _left_of_telling(study), row_ranges(study)
    told = np.concatenate([left[rows[i]] for i in study.baseline or study.train])
    return min(float(np.mean(np.square(told))), 1.0)


def whiten(study: Study) -> None:
    """Widen every channel, or take its color out, in every run."""
    found = colors(study)
    everything = (*study.runs, *study.holdout)
    lags = max((color.lags for color in found.values()), default=0)
    runs = [replace(run, color=Color.joined([found.get(name) for name in run.channels], lags))
            for run in everything]
    columns = [_recolored(old, new, part) for old, new, part in zip(
        everything, runs, [*(study.columns[rows] for rows in row_ranges(study)),
                           *study.holdout_columns], strict=True)]
    n = len(study.runs)
    study.columns, study.holdout_columns = np.concatenate(columns[:n]), columns[n:]
    study.runs, study.holdout = tuple(runs[:n]), tuple(runs[n:])
    study.forget()


def _recolored(old: Run, new: Run, columns: Floats) -> Floats:
    """Columns [n * m, k] of a run whose color is another now."""
    cube = columns.reshape(*old.measured.shape, columns.shape[1])
    return new.color.whitened(old.color.colored(cube)).reshape(columns.shape)
