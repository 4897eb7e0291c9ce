"""How noisy each channel is: as its recording states, else as its samples show.

The estimate takes fourth differences, which keep white noise and remove motion, and residuals
about a local cubic, which also see noise that a filter has smoothed; the larger counts, and never
less than the rounding of the samples.

References: the variance of a k-th difference of white noise is sigma^2 binom(2k, k).
Known limits: one number a channel; slow drift and offsets are no noise here. A record rebuilt from
text and a simulated one have none.
Validated with: test/comparison/test_noise.py.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.recordings import Recording, Series
from truck_blowout_sim.vehicle.units import PSI_PA

Floats = NDArray[np.float64]

_DIFFERENCE_GAIN = np.sqrt(70.0)
_MAD_TO_SIGMA = 1.4826
_CUBIC = 21
_SHORTEST = 2 * _CUBIC
# What of the value is rounding noise of double precision, not of an instrument.
_ARITHMETIC = 1e-9

_UNITS = {
    "m/s": 1.0, "deg/s": np.pi / 180, "m/s2": 1.0, "deg": np.pi / 180, "m": 1.0, "rad": 1.0,
    "rad/s": 1.0, "Pa": 1.0, "kPa": 1e3, "psi": PSI_PA,
}  # fmt: skip
_BODY_WORDS = {
    "velocity": ("vx_mps", "vy_mps"),
    "rate": ("yaw_rate_radps", "roll_rate_radps", "pitch_rate_radps"),
    "acceleration": ("ax_mps2", "ay_mps2", "az_mps2"),
    "tilt": ("roll_rad", "pitch_rad"),
    "heading": ("yaw_rad",),
    "position": ("x_m", "y_m"),
}
_OTHER_WORDS = {
    "hub speed": "hub_speed_",
    "tire pressure": "tire_pressure_",
    "chamber pressure": "brake_chamber_",
}
_AMOUNT = re.compile(r"([0-9.]+(?:e-?[0-9]+)?)\s*(%|[a-zA-Z/0-9]+)")


@dataclass(frozen=True)
class Sigma:
    """One standard deviation of a sample, SI, and where it comes from."""

    value: float
    source: str


def channel_sigmas(recording: Recording) -> Mapping[str, Sigma]:
    """Noise of every channel whose noise is stated or visible.

    Metadata lines ``noise_1sigma_tractor: velocity 0.012 m/s, rate 0.02 deg/s, ...``,
    ``noise_1sigma_trailer`` and ``noise_1sigma_other: hub speed 0.2 %, ...`` are read.
    """
    if "rebuilt" in recording.metadata.get("origin", ""):
        return {}
    found = {}
    for name, series in recording.channels.items():
        stated = _stated(recording.metadata, name, series)
        value = estimated_sigma(series) if stated is None else stated
        if value is not None and value > 0.0:
            found[name] = Sigma(value, "estimated" if stated is None else "stated")
    return found


def estimated_sigma(series: Series) -> float | None:
    """White noise of a channel; ``None`` if it is too short or shows none."""
    value = series.value
    if value.size < _SHORTEST:
        return None
    from scipy.signal import savgol_coeffs, savgol_filter  # slow to load

    difference = np.diff(value, 4) / _DIFFERENCE_GAIN
    kept = 1.0 - float(savgol_coeffs(_CUBIC, 3)[_CUBIC // 2])
    residual = (value - savgol_filter(value, _CUBIC, 3)) / np.sqrt(kept)
    sigma = max(_spread(difference), _spread(residual), _quantum(value) / np.sqrt(12.0))
    return sigma if sigma > _ARITHMETIC * max(float(np.abs(value).max()), 1e-300) else None


def _spread(value: Floats) -> float:
    """Standard deviation of the quieter part, robust against events."""
    return float(_MAD_TO_SIGMA * np.median(np.abs(value - np.median(value))))


def _quantum(value: Floats) -> float:
    """Smallest step between samples if every step is a multiple of it, else 0.

    A ramp, whose steps are all alike, shows no rounding.
    """
    steps = np.abs(np.diff(value))
    moving = steps[steps > _ARITHMETIC * max(float(np.abs(value).max()), 1e-300)]
    if moving.size == 0:
        return 0.0
    step = float(moving.min())
    ratio = steps / step
    multiple = np.round(ratio)
    even = float(np.abs(ratio - multiple).max()) < 0.05
    return step if even and np.ptp(multiple) > 0.0 else 0.0


def _stated(metadata: Mapping[str, str], name: str, series: Series) -> float | None:
    """Noise as a metadata line states it, ``None`` if none does."""
    unit, _, stem = name.partition("_")
    for words, stems in _BODY_WORDS.items():
        if stem in stems:
            return _amount(metadata.get(f"noise_1sigma_{unit}", ""), words, series)
    for words, prefix in _OTHER_WORDS.items():
        if name.startswith(prefix):
            return _amount(metadata.get("noise_1sigma_other", ""), words, series)
    return None


def _amount(text: str, words: str, series: Series) -> float | None:
    """``words 0.5 % + 500 Pa`` in SI: shares of the level and constants, added as squares.

    Units that are not known make it unstated rather than wrong.
    """
    entry = next((e for e in text.split(",") if e.strip().startswith(f"{words} ")), "")
    level = float(np.sqrt(np.mean(series.value**2))) if len(series) else 0.0
    parts = []
    for number, unit in _AMOUNT.findall(entry):
        scale = 0.01 * level if unit == "%" else _UNITS.get(unit)
        if scale is None:
            return None
        parts.append(float(number) * scale)
    return math.hypot(*parts) if parts else None
