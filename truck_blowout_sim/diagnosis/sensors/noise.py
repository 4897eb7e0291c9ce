"""How noisy each channel is, from the recording itself.

The white part comes from fourth differences: they remove everything that moves slower than about
a fifth of the sampling rate and keep white noise with a known gain. Colour shows as a residual
about local cubics that is larger than the fourth differences promise. Quiet stretches decide, so
a manoeuvre or a blowout does not count as noise.

References: the variance of a k-th difference of white noise is sigma² * binom(2k, k).
Known limits: colour slower than about half a second cannot be told from motion here; constant
offsets are found only against another channel (see ``gate``).
Validated with: test/diagnosis/test_sensors_noise.py (stated sigmas of sample recordings).
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import toeplitz
from scipy.signal import savgol_coeffs, savgol_filter

from truck_blowout_sim.comparison.instruments import body_sigma, good_sigma
from truck_blowout_sim.recordings import Recording, Series

FloatArray = NDArray[np.float64]

_DIFFERENCE_GAIN = np.sqrt(70.0)  # binom(8, 4)
_STRETCH_S = 0.5
_SHORTEST = 12  # samples of a stretch: their fourth differences tell its sigma to a third
_LOCAL_CUBIC = 31  # samples of the local cubic whose residual shows coloured noise
FEWEST_SAMPLES = 40
_FEWEST_READINGS = 5  # of a slow gauge: fewer are hardly a course of time
_COMPUTED = 0.02  # of a good instrument's noise: no instrument is that good
_REPEATS = 0.5  # share of samples that differ from the one before, below which most repeat it
_LEAST_STEPS = 3  # fewer may be one jump there and back
_ROUNDED = 1e-12  # of the largest value: by so much doubles differ that stand for one number
_FEWEST_STEPS = 5  # judgement: fewer that do not repeat show no common step
_LEAST_PERCENT = 1  # percentile taken for the smallest step: the very smallest may be a remainder
_NEAR = 20.0  # steps: farther multiples magnify the error of the step itself
_OFF = 0.03  # of a step: what the last printed digit makes; of continuous values 94 % are farther
_MOST_PERCENT = 95  # of the steps must be as near: one in twenty may be an outlier
_FEWEST_NEAR = 20  # steps, of which one may be that
_FEWEST_STRETCHES = 6  # judgement: three on either side of the middle
_LOW_PERCENT, _HIGH_PERCENT = 10, 90  # judgement: levels without the rarest
_VARIED = 0.25  # judgement: of the highest squared level, below which the level hardly varies
_MARKED = 2.0  # times the variance; judgement: a few stretches scatter by themselves
_MOST_ALIKE = 0.98  # neighbors: noise that lasts for 99 samples; a cubic over 31 shows none slower
_CLEAR_COLOUR = 1.5  # times the white sigma, before colour is believed
_MOST_KNOWN = 2000  # channels whose noise is remembered: that of every run is asked for repeatedly


@dataclass(frozen=True)
class Noise:
    """Random error of one channel, in the channel's unit.

    Attributes:
        sigma: 1 sigma of a single sample at the recording's typical level.
        floor: part of it that does not depend on the level.
        relative: part that grows with the level, as a fraction of it.
        correlation_s: integral correlation time; one sampling interval when white.
        effective_rate_hz: independent samples a second.
        quantum: smallest step between samples, 0 where none is visible.
        period_s: sampling interval.
        white: whether colour is below what can be told from white noise.
    """

    sigma: float
    floor: float
    relative: float
    correlation_s: float
    effective_rate_hz: float
    quantum: float
    period_s: float
    white: bool

    def at(self, level: FloatArray) -> FloatArray:
        """1 sigma of single samples at given levels of the channel."""
        return np.asarray(np.hypot(self.floor, self.relative * np.abs(level)), dtype=np.float64)


def channel_noise(recording: Recording, quanta: Mapping[str, float] | None = None
                  ) -> Mapping[str, Noise]:
    """Noise of every channel that has enough samples to show it.

    Args:
        recording: any recording; channels shorter than 40 samples are left out.
        quanta: steps in which channels are known to read, from other runs (:func:`seen_quanta`).

    Returns:
        Noise by channel name.
    """
    known = quanta or {}
    return {
        name: _rounded(series_noise(series), known.get(name, 0.0))
        for name, series in recording.channels.items()
        if len(series) >= FEWEST_SAMPLES
    }


def slow_noise(recording: Recording) -> Mapping[str, Noise]:
    """Noise of the channels with too few samples to show it: that of a good instrument.

    A gauge of tire pressure that sends once a second tells how fast a tire empties all the same.
    """
    return {name: _stated(series, good_sigma(name, series.value))
            for name, series in recording.channels.items()
            if _FEWEST_READINGS <= len(series) < FEWEST_SAMPLES
            and good_sigma(name, series.value) > 0.0}


def _stated(series: Series, sigma: float) -> Noise:
    quantum = _quantum(series.value)
    sigma = max(sigma, quantum / np.sqrt(12.0))
    return Noise(sigma=sigma, floor=sigma, relative=0.0, correlation_s=series.period_s,
                 effective_rate_hz=1.0 / series.period_s, quantum=quantum,
                 period_s=series.period_s, white=True)


def seen_quanta(recordings: Sequence[Recording]) -> Mapping[str, float]:
    """The step in which each channel reads, as the run tells it in which it is smallest.

    A channel that rests in one run shows there neither its noise nor its step.
    """
    found: dict[str, float] = {}
    for noise in map(channel_noise, recordings):
        for name, one in noise.items():
            if one.quantum > 0.0:
                found[name] = min(one.quantum, found.get(name, np.inf))
    return found


def _rounded(one: Noise, quantum: float) -> Noise:
    """The same noise, no smaller than rounding to the quantum leaves it."""
    least = quantum / np.sqrt(12.0)
    if one.quantum > 0.0 or one.sigma >= least:
        return one
    return replace(one, sigma=least, floor=max(one.floor, least), quantum=quantum)


def believable(noise: Mapping[str, Noise]) -> Mapping[str, Noise]:
    """The same noise, computed channels (as good as none) with that of a good instrument.

    Identities hold to what rigid bodies on a level path are worth, not to the last bit.
    """
    return {name: _believed(one, body_sigma(name)) for name, one in noise.items()}


def told_noise(recording: Recording, noise: Mapping[str, Noise]) -> Mapping[str, Noise]:
    """The noise to tell errors in: :func:`believable`, in a computed record that of all channels.

    Forces, pressures and wheels are in no identity. A record is computed if most motions are.
    """
    motions = {name: body_sigma(name) for name in noise if body_sigma(name) > 0.0}
    real = sum(noise[name].sigma > _COMPUTED * usual for name, usual in motions.items())
    if 2 * real > len(motions):
        return believable(noise)
    return {name: _believed(one, good_sigma(name, recording[name].value))
            for name, one in noise.items()}


def excess_noise(runs: Sequence[Mapping[str, Noise]]) -> Mapping[str, float]:
    """1 sigma of each channel beyond a good instrument's, as squares add.

    Of the run in which it is quietest, because motion only adds to it.
    """
    least = {name: min(own[name].sigma for own in runs if name in own)
             for name in {name for own in runs for name in own}}
    return {name: float(np.sqrt(max(sigma**2 - body_sigma(name) ** 2, 0.0)))
            for name, sigma in least.items()}


def _believed(one: Noise, usual: float) -> Noise:
    if one.sigma > _COMPUTED * usual:
        return one
    return replace(one, sigma=usual, floor=usual, relative=0.0)


_known: dict[tuple[bytes, float], Noise] = {}


def series_noise(series: Series) -> Noise:
    """Noise of one channel, see :func:`channel_noise`; that of the same samples is remembered."""
    # by content: a corrected run shares most of its channels with the run as recorded
    key = hashlib.blake2b(series.value.data, digest_size=16).digest(), series.period_s
    found = _known.get(key)
    if found is None:
        if len(_known) >= _MOST_KNOWN:
            _known.clear()
        found = _known[key] = _noise_of(series.value, series.period_s)
    return found


def _noise_of(value: FloatArray, period_s: float) -> Noise:
    """What the samples themselves show."""
    quantum = _quantum(value)
    levels, local = _local_sigmas(value, max(_SHORTEST, round(_STRETCH_S / period_s)))
    # A quantised channel at rest shows no difference at all; its error is still the rounding.
    local = np.maximum(local, quantum / np.sqrt(12.0))
    # a computed series may show none at all; a millionth of its spread keeps the weights finite
    sigma = max(float(np.median(local)), 1e-6 * float(np.std(value)), 1e-12)
    floor, relative = _level_dependence(levels, local, sigma)
    coloured, correlation_s = _colour(value, sigma, period_s)
    if coloured > sigma:
        floor, relative = floor * coloured / sigma, relative * coloured / sigma
        sigma = coloured
    white = correlation_s <= period_s * (1.0 + 1e-9)
    return Noise(
        sigma=sigma,
        floor=floor,
        relative=relative,
        correlation_s=correlation_s,
        effective_rate_hz=1.0 / correlation_s,
        quantum=quantum,
        period_s=period_s,
        white=white,
    )


def _quantum(value: FloatArray) -> float:
    """Largest step of which all differences are multiples; 0 if the values are continuous.

    Values printed with few digits are multiples only to within their last digit, hence the slack.
    Continuous noise does not repeat: where most samples do, the smallest step is the quantum.
    """
    steps = np.abs(np.diff(value))
    every, steps = steps.size, steps[steps > _ROUNDED * max(1.0, float(np.abs(value).max()))]
    if _LEAST_STEPS <= steps.size < _REPEATS * every:
        return float(steps.min())
    if steps.size < _FEWEST_STEPS:
        return 0.0
    step = float(np.percentile(steps, _LEAST_PERCENT))
    near = steps[steps < _NEAR * step]
    off = np.abs(near / step - np.round(near / step))
    most = float(np.percentile(off, _MOST_PERCENT)) if near.size > _FEWEST_NEAR else np.inf
    return step if most < _OFF else 0.0


def _local_sigmas(value: FloatArray, length: int) -> tuple[FloatArray, FloatArray]:
    """Mean level and noise of consecutive stretches of ``length`` samples."""
    difference = np.diff(value, 4) / _DIFFERENCE_GAIN
    count = max(1, difference.size // length)
    return _means(value[2:-2], count), np.sqrt(_means(difference**2, count))


def _means(value: FloatArray, count: int) -> FloatArray:
    """Mean of each of ``count`` parts, cut as :func:`numpy.array_split` does."""
    length, longer = divmod(value.size, count)
    end = longer * (length + 1)
    return np.concatenate([value[:end].reshape(longer, length + 1).mean(axis=1),
                           value[end:].reshape(count - longer, length).mean(axis=1)])


def _level_dependence(levels: FloatArray, local: FloatArray, sigma: float) -> tuple[float, float]:
    """Split local² = floor² + (relative * level)² where the level varies enough to show it."""
    square = levels**2
    lowest, highest = np.percentile(square, _LOW_PERCENT), np.percentile(square, _HIGH_PERCENT)
    if levels.size < _FEWEST_STRETCHES or highest - lowest <= _VARIED * highest:
        return sigma, 0.0
    high = square > np.median(square)
    if not high.any():  # at its highest level most of the time, like a brake held on
        return sigma, 0.0
    low_var, high_var = float(np.median(local[~high] ** 2)), float(np.median(local[high] ** 2))
    low_sq, high_sq = float(np.median(square[~high])), float(np.median(square[high]))
    if high_sq <= low_sq or high_var < _MARKED * low_var:
        return sigma, 0.0
    slope = (high_var - low_var) / (high_sq - low_sq)
    return float(np.sqrt(max(low_var - slope * low_sq, 0.0))), float(np.sqrt(slope))


def _colour(value: FloatArray, sigma: float, period_s: float) -> tuple[float, float]:
    """Sigma of the residual about local cubics in the quieter half, and its correlation time."""
    residual = value - savgol_filter(value, _LOCAL_CUBIC, 3)
    pieces = np.array_split(residual, max(2, residual.size // (2 * _LOCAL_CUBIC)))
    power = _means(residual**2, len(pieces))
    quiet = [k for k in np.argsort(power)[: max(1, power.size // 2)] if power[k] > 0.0]
    if not quiet:
        return sigma, period_s
    seen = float(np.mean(power[quiet]))
    if seen < _CLEAR_COLOUR**2 * _kept(0.0) * sigma**2:
        return sigma, period_s
    lagged = [float(np.mean(pieces[k][1:] * pieces[k][:-1])) / float(power[k]) for k in quiet]
    first = float(np.clip(np.mean(lagged), 0.0, _MOST_ALIKE))
    return float(np.sqrt(seen / _kept(first))), period_s * (1.0 + first) / (1.0 - first)


@lru_cache(maxsize=16)
def _kept(first: float) -> float:
    """Share of the power of first-order noise (lag-one correlation given) that a cubic leaves."""
    weights = -savgol_coeffs(_LOCAL_CUBIC, 3)
    weights[_LOCAL_CUBIC // 2] += 1.0
    return float(weights @ toeplitz(first ** np.arange(_LOCAL_CUBIC)) @ weights)
