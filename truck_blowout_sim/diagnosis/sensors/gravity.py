"""Is it another treatment of gravity, or a fault with an amount that looks like it?

A body leans by about as much as it is accelerated sideways: a share of gravity that a sideways
accelerometer reads looks like an error of its gain, and all of it like an accelerometer that is
said to be free of gravity.

References, known limits: see `reading.py`.
Validated with: test/diagnosis/test_sensors_conventions.py.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from truck_blowout_sim.diagnosis.sensors.distortions import GravityConvention
from truck_blowout_sim.diagnosis.sensors.reading import Reading

_LEAKS = np.arange(0.1, 1.5, 0.05)  # shares of gravity
_GAINS = np.arange(0.75, 1.3, 0.01)  # of a sideways accelerometer


def look_alikes(logs: Sequence[Reading], convention: GravityConvention, alike: float
                ) -> tuple[str, ...] | None:
    """Names of faults that explain as much as the other treatment; None if one explains more.

    Args:
        logs: those that have the fault.
        convention: the other treatment of gravity.
        alike: log likelihood ratio within which two readings cannot be told apart.
    """
    whole = sum(log.log_ratio(convention) for log in logs)
    leak, gain = _best_leak(logs, convention), _best_gain(logs, convention)
    if max(leak, gain) > whole + alike:
        return None
    # a leak through roll says nothing of the longitudinal accelerometer
    along = sum(log.log_ratio(convention, "longitudinal") for log in logs)
    return ((("lateral_accel_roll",) if along < alike else ())
            + (("lateral_accel_scale",) if gain > whole - alike else ()))


def _best_leak(logs: Sequence[Reading], convention: GravityConvention) -> float:
    """Log likelihood ratio of the share of gravity that explains most."""
    return max(sum(log.gain_of(convention.leaked(log.signals, share)) for log in logs)
               for share in _LEAKS.tolist())


def _best_gain(logs: Sequence[Reading], convention: GravityConvention) -> float:
    """The same of the gain of its sideways accelerometers."""
    sideways = [c for c in convention.channels if c.endswith("_ay_mps2")]
    return max(sum(log.gain_of(log.signals.with_values({
        channel: log.signals[channel] / gain for channel in sideways if channel in log.signals}))
        for log in logs) for gain in _GAINS.tolist())
