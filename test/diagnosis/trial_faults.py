"""Faults put into recordings, to see whether the sensor gate finds them.

Written apart from the gate's own ``distortions``: these act on whole recordings, in full size.

Validated with: test/diagnosis/test_sensors_distortions.py.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter1d
from scipy.signal import lfilter

from truck_blowout_sim.recordings import Recording, Series

FloatArray = NDArray[np.float64]
_GRAVITY = 9.81
_SMOOTH_SAMPLES = 5.0

Change = Callable[[Recording], Recording]
"""Spoils a recording."""


def remembering(time_s: FloatArray, memory_s: float, rng: np.random.Generator) -> FloatArray:
    """Noise of unit size that remembers so long."""
    keep = float(np.exp(-np.median(np.diff(time_s)) / memory_s))
    push = rng.standard_normal(time_s.size) * np.sqrt(1.0 - keep**2)
    return np.asarray(lfilter([1.0], [1.0, -keep], push), dtype=np.float64)


def scaled(channel: str, error: float) -> Change:
    """Gain error of one channel, as a fraction."""
    return lambda r: _changed(r, channel, r[channel].value * (1.0 + error))


def offset(channel: str, amount: float) -> Change:
    """Constant added to one channel."""
    return lambda r: _changed(r, channel, r[channel].value + amount)


def noisy(channels: Sequence[str], sigma: float, rng: np.random.Generator) -> Change:
    """White noise on top of channels."""

    def change(r: Recording) -> Recording:
        for c in channels:
            r = _changed(r, c, r[c].value + sigma * rng.standard_normal(r[c].value.size))
        return r

    return change


def delayed(channels: Sequence[str], delay_s: float) -> Change:
    """Channels that arrive late, resampled to their own instants."""

    def change(r: Recording) -> Recording:
        for c in channels:
            r = _changed(r, c, np.interp(r[c].time_s - delay_s, r[c].time_s, r[c].value))
        return r

    return change


def leaking(unit: str, share: float) -> Change:
    """A share of gravity that leaks into lateral acceleration through roll."""

    def change(r: Recording) -> Recording:
        roll = gaussian_filter1d(r[f"{unit}_roll_rad"].value, _SMOOTH_SAMPLES)
        channel = f"{unit}_ay_mps2"
        return _changed(r, channel, r[channel].value + share * _GRAVITY * np.sin(roll))

    return change


def displaced(unit: str, forward_m: float, what: str) -> Change:
    """Instruments ``what`` ("velocity", "accelerometer", "position" in any mix) sit forward."""

    def change(r: Recording) -> Recording:
        rate = gaussian_filter1d(r[f"{unit}_yaw_rate_radps"].value, _SMOOTH_SAMPLES)
        yaw = r[f"{unit}_yaw_rad"].value
        added: dict[str, FloatArray] = {}
        if "velocity" in what:
            added["vy_mps"] = rate * forward_m
        if "accelerometer" in what:
            added["ay_mps2"] = np.gradient(rate, r[f"{unit}_yaw_rate_radps"].time_s) * forward_m
            added["ax_mps2"] = -(rate**2) * forward_m
        if "position" in what:
            added |= {"x_m": np.cos(yaw) * forward_m, "y_m": np.sin(yaw) * forward_m}
        for stem, amount in added.items():
            r = _changed(r, f"{unit}_{stem}", r[f"{unit}_{stem}"].value + amount)
        return r

    return change


def _changed(recording: Recording, channel: str, value: FloatArray) -> Recording:
    return recording.with_channels({channel: Series(recording[channel].time_s, value)})
