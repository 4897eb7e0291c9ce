"""How visible an effect is: signal-to-noise ratio of its best single channel.

The effect's signal is the difference between two runs on the same commands and an even road, one
with the effect and one without. The noise of a channel is the instrument's white noise, an
unknown constant (mounting), and what a calibrated model of a truck still leaves: two first-order
Markov processes, FLOORS, given as multiples of the white sigma with the time in which they forget
themselves. Detectability is the matched-filter ratio

    d^2 = sum over training runs of (1/N) sum_k |D_k|^2 / S_k ,    d = largest over channels,

with D_k the discrete Fourier transform of the N samples of the signal and S_k the noise spectrum.
Position and heading are left out: without a driver they drift without bound. An instrument fault
breaks identities that need no model of the truck, so INSTRUMENT_FLOORS hold for it, except at the
hand wheel: an input shows only through the truck's answer, so its sigma is that of the yaw rate
over the yaw gain.
"""

from __future__ import annotations

import numpy as np

from proving_ground.channels import COMMANDS, RATE_HZ
from proving_ground.instruments import DEG, noise_of
from proving_ground.layout import FloatArray

Floors = tuple[tuple[float, float], ...]
FLOORS: Floors = ((5.0, 0.5), (8.0, 5.0))     # white sigmas, seconds
INSTRUMENT_FLOORS: Floors = ((1.5, 0.5), (1.5, 5.0))
HAND_WHEEL = "steering_wheel_angle_rad"
HAND_WHEEL_SIGMA_RAD = 0.02 * DEG * 22.0 / 2.6
LEFT_OUT = ("_x_m", "_y_m", "_yaw_rad")


def constant_sigma(channel: str) -> float:
    """One sigma of the unknown constant of a channel, SI."""
    more = 2.0 if channel.startswith("trailer_") else 1.0
    if channel.endswith("_rate_radps"):
        return more * 0.006 * DEG
    if channel.endswith("_mps2"):
        return more * 0.006
    if channel.endswith("_rad"):
        return more * 0.05 * DEG
    return 0.02 * more if channel.endswith("_mps") else 0.0


def noise_spectrum(channel: str, level: float, count: int,
                   floors: Floors = FLOORS) -> FloatArray:
    """Noise power at each discrete frequency for a typical reading `level`."""
    noise = noise_of(channel)
    white = noise.sigma**2 + (noise.relative * level) ** 2 + noise.quantum**2 / 12.0
    if channel == HAND_WHEEL:
        white, floors = HAND_WHEEL_SIGMA_RAD**2, FLOORS
    spectrum = np.full(count // 2 + 1, white)
    for ratio, memory_s in floors:
        keep = float(np.exp(-1.0 / (memory_s * RATE_HZ)))
        turn = np.abs(1.0 - keep * np.exp(-2j * np.pi * np.fft.rfftfreq(count))) ** 2
        spectrum += white * ratio**2 * (1.0 - keep**2) / turn
    spectrum[0] += count * constant_sigma(channel) ** 2
    return spectrum


def channel_power(channel: str, with_effect: FloatArray, without: FloatArray,
                  floors: Floors = FLOORS) -> float:
    """Squared signal-to-noise ratio of one channel in one run."""
    count = min(len(with_effect), len(without))
    signal = with_effect[:count] - without[:count]
    level = float(np.mean(np.abs(without[:count])))
    spectrum = noise_spectrum(channel, level, count, floors)
    power = np.abs(np.fft.rfft(signal)) ** 2
    weight = np.full(power.size, 2.0)
    weight[0] = 1.0
    if count % 2 == 0:
        weight[-1] = 1.0
    return float(np.sum(weight * power / spectrum) / count)


def detectability(pairs: list[tuple[dict[str, FloatArray], dict[str, FloatArray]]],
                  missing: tuple[str, ...] = (), floors: Floors = FLOORS
                  ) -> tuple[float, str]:
    """Detectability in sigma and the channel that gives it, from (with, without) per run."""
    best, best_channel = 0.0, ""
    for channel in pairs[0][0]:
        if channel in COMMANDS and channel != HAND_WHEEL:
            continue
        if channel.endswith(LEFT_OUT) or channel.startswith(missing or ("-",)):
            continue
        total = sum(channel_power(channel, a[channel], b[channel], floors) for a, b in pairs)
        if total > best:
            best, best_channel = total, channel
    return float(np.sqrt(best)), best_channel
