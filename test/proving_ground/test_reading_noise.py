"""What sigma_b takes for the noise of a case's readings is what its instruments make."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.fft import dct

from proving_ground.channels import RATE_HZ
from proving_ground.detect import constant_sigma
from proving_ground.instruments import Mounting, measure
from proving_ground.kept_back import KeptBack
from proving_ground.reading_noise import Instruments
from proving_ground.roughness import Roughness, roughen

DURATION_S, HIGHEST_HZ, TRIES = 20.0, 5.0, 150
COUNT = round(2.0 * DURATION_S * HIGHEST_HZ)
CALM = Roughness(noise=0.0, memory_s=0.1, frame_hz=3.0, frame=0.0, wheel=0.0, engine_hz=15.0,
                 engine=0.0, drift=0.0, rounding=1.0, dropped=0.0, clock=0.0, clock_of="",
                 every=1, few=False)


def simulated(instruments: Instruments, channel: str, level: float) -> np.ndarray:
    """Mean square of each coefficient of what the instruments themselves add to a reading."""
    clean = {channel: level + 1e-3 * np.linspace(0.0, 1.0, round(DURATION_S * RATE_HZ))}
    squares = np.zeros(COUNT)
    for seed in range(TRIES):
        readings = instruments.kept.read(measure(clean, Mounting({}, {}), seed), seed)
        if instruments.rough is not None:
            readings = roughen(readings, instruments.rough, seed)[1]
        every = len(clean[channel]) // len(readings[channel])
        error = readings[channel] - clean[channel][::every]
        error = error[np.isfinite(error)]
        scale = np.sqrt(len(clean[channel]) / len(error))
        row = dct(error, norm="ortho")[:COUNT] * scale
        squares[:len(row)] += row**2 / TRIES
    return squares


def stated(instruments: Instruments, channel: str, level: float) -> np.ndarray:
    """The variance of each coefficient as sigma_b has it, of instruments mounted without errors."""
    variance = instruments.variance(channel, level, COUNT, DURATION_S)
    variance[0] -= DURATION_S * RATE_HZ * constant_sigma(channel) ** 2
    return variance


def ratio(instruments: Instruments, channel: str, level: float, part: slice) -> float:
    """Noise power that the instruments make over the power that is stated, in some coefficients."""
    return float(simulated(instruments, channel, level)[part].sum()
                 / stated(instruments, channel, level)[part].sum())


ROUGH = {
    "white": CALM,
    "short memory": replace(CALM, noise=5.0, memory_s=0.05),
    "long memory": replace(CALM, noise=5.0, memory_s=2.0),
    "drift": replace(CALM, drift=4.0),
    "slow logger": replace(CALM, every=10, noise=3.0, memory_s=0.1),
    "coarse": replace(CALM, rounding=20.0, noise=3.0),
}


@pytest.mark.parametrize("rough", ROUGH.values(), ids=ROUGH.keys())
@pytest.mark.parametrize("part", [slice(0, 3), slice(3, 20), slice(20, 120)],
                         ids=["slow", "middle", "fast"])
def test_a_rough_log(rough: Roughness, part: slice) -> None:
    found = ratio(Instruments(KeptBack(), rough), "tractor_ay_mps2", 2.0, part)
    assert found == pytest.approx(1.0, rel=0.15)


def test_the_tone_of_a_frame_is_where_it_sounds() -> None:
    loud = Instruments(KeptBack(), replace(CALM, frame=5.0))
    line = round(2.0 * DURATION_S * CALM.frame_hz)
    near = slice(line - 5, line + 6)
    assert ratio(loud, "tractor_ay_mps2", 2.0, near) == pytest.approx(1.0, rel=0.15)
    assert ratio(loud, "hub_speed_steer_left_radps", 2.0, near) == pytest.approx(1.0, rel=0.15)


@pytest.mark.parametrize("channel", ["tractor_yaw_rate_radps", "tractor_vx_mps",
                                     "trailer_ax_mps2"])
@pytest.mark.parametrize("later", [True, False])
def test_the_instruments_kept_back(channel: str, later: bool) -> None:
    kept = Instruments(KeptBack(instruments=True, later=later), None)
    assert ratio(kept, channel, 20.0, slice(3, 150)) == pytest.approx(1.0, rel=0.15)
