"""How far good models of one vehicle may differ in each bin: the widths, first guess.

    sigma^2 = noise^2 + (floor^2 + (relative swing)^2 + step^2) correlation / bin

Step is what a finer step changes in the model, rms over half a maneuver: where friction sticks and
slips, no step is fine enough for two simulations to agree.

The swing is the rms, over half a maneuver, of how far a signal is from its median: the smaller one
of model and recording. A model that is late is off most where its signal passes zero, so the swing
of one bin would be wrong. The measured signal alone would be wrong, too: what is missing moves the
vehicle, and would excuse itself.

References: Kennedy and O'Hagan 2001 (a model's discrepancy beside the noise of the instrument).
Known limits: a model that stands still where the vehicle moves is believed to its floor.
Validated with: test/diagnosis/test_widths.py (what is missing does not widen its own bins).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import uniform_filter1d

from truck_blowout_sim.diagnosis.settings import Settings

Floats = NDArray[np.float64]
_FEWEST_SEEN = 1e-6  # share of the bins that have a sample; below, running sums leave it from none


def swings(signals: Floats, settings: Settings) -> Floats:
    """[n, m] rms of how far each signal [n, m] is from its median around each bin.

    Bins without a sample count as far from it as those around them: of a gauge that reads once a
    second, most have none.
    """
    known = np.isfinite(signals)
    middle = np.array([np.median(one[seen]) if seen.any() else 0.0
                       for one, seen in zip(signals.T, known.T, strict=True)])
    away = np.where(known, np.nan_to_num(signals) - middle, 0.0)
    seen = np.square(rms_around(known.astype(np.float64), settings))
    share = np.where(seen > _FEWEST_SEEN, seen, 1.0)
    return np.asarray(rms_around(away, settings) / np.sqrt(share))


def rms_around(values: Floats, settings: Settings) -> Floats:
    """[n, m] rms of values [n, m] over half a maneuver around each bin."""
    bins = max(round(settings.swing_s / settings.bin_s), 1)
    squares = uniform_filter1d(np.square(values), bins, axis=0, mode="nearest")
    return np.sqrt(np.maximum(squares, 0.0))  # its running sums leave less than nothing


def widths(channels: Sequence[str], noise: Floats, swing: Floats, settings: Settings,
           step: Floats | float = 0.0) -> Floats:
    """[n, m] standard error of each bin of each channel.

    Args:
        channels: names, m of them; ``noise``: [n, m] standard errors of the instrument alone.
        swing: [n, m] the smaller of the model's and the recording's.
        settings: floors and shares; ``step``: [n, m] rms of what a finer step changes.
    """
    floor, relative = _rules(channels, settings)
    lasts = np.sqrt(settings.correlation_s / settings.bin_s)
    models = np.hypot(np.hypot(floor, relative * swing), step)
    return np.asarray(np.hypot(noise, lasts * models))


def _rules(channels: Sequence[str], settings: Settings) -> tuple[Floats, Floats]:
    """Floor and relative difference of each channel."""
    rules = [settings.rule(channel) for channel in channels]
    return (np.array([rule.floor if rule else 0.0 for rule in rules]),
            np.array([rule.relative if rule else 0.0 for rule in rules]))
