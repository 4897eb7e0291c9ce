"""Channels of a recording on one even time grid, as the identities read them.

Nothing is resampled where the channels already share their instants; a channel on another time
base is interpolated, and gaps stay gaps (NaN).

Validated with: test/diagnosis/test_sensors_identities.py.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter1d, uniform_filter1d

from truck_blowout_sim.diagnosis.sensors.noise import FEWEST_SAMPLES
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.recordings.channels import UNITS
from truck_blowout_sim.recordings.gravity import gravity_is_removed

FloatArray = NDArray[np.float64]

WHEEL = "steering_wheel_angle_rad"
_SMOOTH_S = 0.08
_MAX_GAP_FACTOR = 2.5
# The grid's interval is rounded to a nanosecond: half of that adds up to this in 2000 samples.
_ROUNDING_S = 1e-6
_ASKED = ("tractor_", "trailer_", "hub_speed_", "brake_pressure_", "articulation_")
_LASTING_SAMPLES = 100
_WIENER_BINS = 9
_WIENER_MARGIN = 2.0


@dataclass(frozen=True)
class Signals:
    """Channels on a common grid.

    Attributes:
        name: of the recording.
        time_s: even grid.
        values: by channel name, NaN where not measured.
        gravity: by unit, 1 if its accelerometers are said (or silently assumed) to read gravity,
            0 if it is said to be removed.
        blown_since_s: instant from which each hub rolls on a blown tire.
        wheel_rad: hand-wheel angle on the grid; ``None`` where it was not recorded.
    """

    name: str
    time_s: FloatArray
    values: Mapping[str, FloatArray]
    gravity: Mapping[str, float]
    blown_since_s: Mapping[str, float]
    wheel_rad: FloatArray | None = None
    _remembered: dict[tuple[str, float, float], tuple[FloatArray | None, FloatArray]] = field(
        default_factory=dict, compare=False, repr=False)

    @property
    def period_s(self) -> float:
        """Interval of the grid."""
        return float(self.time_s[1] - self.time_s[0])

    def __contains__(self, name: object) -> bool:
        return name in self.values

    def __getitem__(self, name: str) -> FloatArray:
        """A channel, or zeros where it was not measured (small corrections may be left out)."""
        found = self.values.get(name)
        return np.zeros_like(self.time_s) if found is None else found

    def with_values(self, values: Mapping[str, FloatArray]) -> Signals:
        """A copy in which the given channels are replaced."""
        return replace(self, values={**self.values, **values})

    def smooth(self, sigma: Mapping[str, float] | None = None) -> Signals:
        """A copy with the noise taken out as well as its spectrum allows, gaps bridged.

        Regressors are made from this: the noise of the raw channel would correlate with the
        residual's own noise and bias the regression.

        Args:
            sigma: white noise by channel; where given, frequencies that hold mostly noise are
                dropped.
        """
        width = _SMOOTH_S / self.period_s
        known = sigma or {}
        values = {name: self._smoothed(name, width, known.get(name, 0.0)) for name in self.values}
        return replace(self, values=values)

    def _smoothed(self, name: str, width_samples: float, sigma: float) -> FloatArray:
        """:func:`smoothed` of a channel, remembered as long as the channel stays the same."""
        key, values = (name, width_samples, sigma), self.values[name]
        seen, found = self._remembered.get(key, (None, values))
        if seen is not values:
            found = smoothed(values, width_samples, sigma)
            self._remembered[key] = values, found
        return found


def smoothed(values: FloatArray, width_samples: float, sigma: float = 0.0) -> FloatArray:
    """Gaussian smoothing; missing samples are bridged linearly, all-missing stays missing.

    Args:
        values: even samples, NaN where missing.
        width_samples: standard deviation of the Gaussian.
        sigma: white noise of one sample; a Wiener filter drops what it explains.
    """
    known = np.isfinite(values)
    if not known.any():
        return values
    index = np.arange(values.size)
    full = np.interp(index, index[known], values[known]) if not known.all() else values
    if sigma > 0.0 and full.size > 64:
        full = _wiener(full, sigma)
    return np.asarray(gaussian_filter1d(full, width_samples, mode="nearest"), dtype=np.float64)


def _wiener(values: FloatArray, sigma: float) -> FloatArray:
    """Keep the frequencies whose power stands out of white noise."""
    line = np.linspace(values[0], values[-1], values.size)
    # Odd reflection about both ends makes the series periodic without a step.
    half = values - line
    around = np.concatenate([half, -half[-2:0:-1]])
    spectrum = np.fft.rfft(around)
    power = uniform_filter1d(np.abs(spectrum) ** 2, _WIENER_BINS, mode="nearest")
    noise = _WIENER_MARGIN * (sigma**2 * around.size)
    # a channel at rest has no power at all, which nothing can be divided by
    explained = np.divide(noise, power, out=np.ones_like(power), where=power > noise)
    return np.asarray(np.fft.irfft(spectrum * (1.0 - explained), around.size)[: values.size] + line)


def read_signals(recording: Recording) -> Signals:
    """Put a recording on the grid of its most densely sampled motion channel.

    Raises:
        InputError: if no channel of a body has samples enough to tell its noise.
    """
    told = [
        series
        for name, series in recording.channels.items()
        if name.startswith(("tractor_", "trailer_")) and len(series) >= FEWEST_SAMPLES
    ]
    if not told:
        raise InputError(
            file=recording.name,
            problem=f"no motion channel (tractor_..., trailer_...) with {FEWEST_SAMPLES} samples "
                    "or more",
            expected="at least tractor velocity, yaw rate or acceleration over a second",
        )
    # a short burst on a fast clock is no grid for the others
    body = [series for series in told if len(series) >= _LASTING_SAMPLES] or told
    finest = min(body, key=lambda series: (series.period_s, -len(series)))
    period_s = round(finest.period_s, 9)
    start, end = float(finest.time_s[0]), float(finest.time_s[-1])
    steps = np.arange(int(np.floor((end - start) / period_s + 0.5)) + 1)
    time_s = np.asarray(start + period_s * steps, dtype=np.float64)
    values = {}
    for name, series in recording.channels.items():
        if len(series) < 2 or not name.startswith(_ASKED):
            continue
        # Rounding must not turn the first or the last sample into a missing one.
        inside = np.clip(time_s, time_s[0], None)
        for end in (series.time_s[-1], series.time_s[0]):
            inside = np.where(np.abs(inside - end) < _ROUNDING_S, end, inside)
        found = series.at(inside, max_gap_s=_MAX_GAP_FACTOR * max(series.period_s, period_s))
        values[name] = _unwrapped(found) if name.endswith("_yaw_rad") else found
    return Signals(
        name=recording.name,
        time_s=time_s,
        values=values,
        gravity={unit: float(not gravity_is_removed(recording, unit)) for unit in UNITS},
        blown_since_s=_blown_hubs(recording),
        wheel_rad=_wheel(recording, time_s),
    )


def _wheel(recording: Recording, time_s: FloatArray) -> FloatArray | None:
    if WHEEL not in recording or len(recording[WHEEL]) < 2:
        return None
    return np.asarray(recording.at(WHEEL, time_s), dtype=np.float64)


def _unwrapped(angle: FloatArray) -> FloatArray:
    known = np.isfinite(angle)
    out = angle.copy()
    out[known] = np.unwrap(angle[known])
    return np.asarray(out, dtype=np.float64)


def _blown_hubs(recording: Recording) -> dict[str, float]:
    """Hub by hub: the first blowout on it. A tire's name begins with its hub's."""
    since: dict[str, float] = {}
    for event in recording.blowouts:
        for tire in event.tires:
            hub = tire.removesuffix("_outer").removesuffix("_inner")
            since.setdefault(hub, event.time_s)
    return since
