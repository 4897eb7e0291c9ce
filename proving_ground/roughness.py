"""Recordings as rough as real logs: noise that remembers, tones, drift, gaps, clocks, few channels.

Ranges: noise of one to ten times the clean instrument's with a memory of 0.05 to 2 s, tones of
frame, wheels and engine between 2 and 20 Hz, a clock that runs up to 0.1 % fast, 10 to 100 Hz. They
enclose the logs that the documentation compares with (a race car's raw accelerometer: 1.2 m/s2).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.signal import lfilter

from proving_ground.channels import COMMANDS, RATE_HZ
from proving_ground.instruments import noise_of
from proving_ground.layout import FloatArray

Values = dict[str, FloatArray]
Rng = np.random.Generator
FEW = (*COMMANDS, "tractor_vx_mps", "tractor_yaw_rate_radps", "tractor_ay_mps2")
WHEEL_RADIUS_M = 0.49
WALK_S = 60.0   # in which a drift has walked as far as its size


class _Own(NamedTuple):
    """How much rougher one channel is than the log; drawn evenly."""

    low: float = 0.6
    high: float = 1.4

    @property
    def square(self) -> float:
        """Mean square."""
        return (self.low**2 + self.low * self.high + self.high**2) / 3.0


OWN = _Own()


@dataclass(frozen=True)
class Roughness:
    """How rough the log of one truck is; sizes are multiples of the clean instrument's sigma."""

    noise: float
    memory_s: float
    frame_hz: float
    frame: float
    wheel: float
    engine_hz: float
    engine: float
    drift: float
    rounding: float
    dropped: float                 # share of samples that are absent
    clock: float                   # relative, of the trailer's unit or of all
    clock_of: str                  # "trailer" or ""
    every: int                     # each so many hundredths of a second
    few: bool

    @classmethod
    def draw(cls, seed: int, may_be_few: bool = True) -> Roughness:
        """Drawn once per case; `may_be_few`: the channels may go down to the usual five."""
        rng = np.random.default_rng([seed, 103])

        def between(low: float, high: float) -> float:
            return float(rng.uniform(low, high))

        def often(share: float, value: float) -> float:
            return value if rng.random() < share else 0.0

        return cls(
            noise=float(np.exp(rng.uniform(0.0, np.log(10.0)))),
            memory_s=float(np.exp(rng.uniform(np.log(0.05), np.log(2.0)))),
            frame_hz=between(2.0, 6.0), frame=often(0.5, between(0.3, 5.0)),
            wheel=often(0.4, between(0.3, 5.0)), engine_hz=between(10.0, 20.0),
            engine=often(0.5, between(0.3, 6.0)), drift=often(0.6, between(0.3, 4.0)),
            rounding=float(np.exp(rng.uniform(0.0, np.log(20.0)))),
            dropped=often(0.5, between(0.002, 0.03)), clock=often(0.3, 1.0e-3),
            clock_of="trailer" if rng.random() < 0.5 else "",
            every=int(rng.choice([1, 1, 2, 5, 10])),
            few=bool(rng.random() < 0.35) and may_be_few)

    def keeps(self, channel: str) -> bool:
        """Whether a channel is recorded at all."""
        return not self.few or channel in FEW


def roughen(readings: Values, rough: Roughness, seed: int) -> tuple[FloatArray, Values]:
    """Time stamps and readings of a log as rough as `rough` says."""
    rng = np.random.default_rng([seed, 107])
    count = len(next(iter(readings.values())))
    speed = readings.get("tractor_vx_mps", np.full(count, 20.0))
    turns = np.cumsum(np.nan_to_num(speed, nan=20.0)) / RATE_HZ / WHEEL_RADIUS_M
    time = np.arange(count) / RATE_HZ
    out = {}
    for channel, signal in readings.items():
        if not rough.keeps(channel):
            continue
        if channel not in COMMANDS:
            signal = _worse(channel, signal, time, turns, rough, rng)
        if rough.clock and channel.startswith(rough.clock_of or ("tractor", "trailer", "hub")):
            signal = np.interp(time * (1.0 + rough.clock), time, signal)
        if rough.dropped and channel not in COMMANDS:
            signal = np.where(_gone(count, rough.dropped, rng), np.nan, signal)
        out[channel] = signal[::rough.every]
    return time[::rough.every], out


def _worse(channel: str, signal: FloatArray, time: FloatArray, turns: FloatArray,
           rough: Roughness, rng: Rng) -> FloatArray:
    """Coloured noise, tones, drift and coarser rounding on top of a reading."""
    noise = noise_of(channel)
    sigma = float(np.hypot(noise.sigma, noise.relative * np.nanmean(np.abs(signal))))
    own = float(rng.uniform(OWN.low, OWN.high))
    keep = float(np.exp(-1.0 / (rough.memory_s * RATE_HZ)))
    push = rng.standard_normal(len(signal)) * np.sqrt(1.0 - keep * keep)
    push[0] = rng.standard_normal()
    out = signal + rough.noise * own * sigma * lfilter([1.0], [1.0, -keep], push)
    if channel.endswith(("_mps2", "_radps")) and not channel.startswith("hub"):
        phase = rng.uniform(0.0, 2.0 * np.pi, 3)
        out = out + sigma * own * (
            rough.frame * np.sin(2.0 * np.pi * rough.frame_hz * time + phase[0])
            + rough.wheel * np.sin(turns + phase[1])
            + rough.engine * np.sin(2.0 * np.pi * rough.engine_hz * time + phase[2]))
    if rough.drift:
        walk = np.cumsum(rng.standard_normal(len(signal))) / np.sqrt(WALK_S * RATE_HZ)
        out = out + rough.drift * sigma * walk
    if noise.quantum > 0.0 and rough.rounding > 1.0:
        step = noise.quantum * rough.rounding
        out = step * np.round(out / step)
    return np.maximum(out, 0.0) if channel.endswith("_pa") else np.asarray(out)


def _gone(count: int, share: float, rng: Rng) -> np.ndarray:
    """Which samples are absent: single ones, and now and then a fifth of a second."""
    gone = rng.random(count) < 0.5 * share
    for start in np.nonzero(rng.random(count) < 0.5 * share / 20.0)[0]:
        gone[start:start + 20] = True
    return np.asarray(gone)
