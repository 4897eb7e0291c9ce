"""What sigma_b takes for the noise of a case's readings is what its instruments make."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.fft import dct

from proving_ground.channels import RATE_HZ
from proving_ground.detect import constant_sigma
from proving_ground.instruments import Mounting, measure
from proving_ground.kept_back import BUS, KeptBack
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
        error = (readings[channel] - clean[channel][::every])
        fresh = np.isfinite(error)
        error = error[fresh] * 1.0
        scale = np.sqrt(len(clean[channel]) / len(error))
        row = dct(error, norm="ortho")[:COUNT] * scale
        squares[:len(row)] += row**2 / TRIES
    return squares


def agree(instruments: Instruments, channel: str, level: float, part: slice) -> None:
    stated = instruments.variance(channel, level, COUNT, DURATION_S)
    stated[0] -= DURATION_S * RATE_HZ * constant_sigma(channel) ** 2  # mounted without errors here
    found = simulated(instruments, channel, level)
    assert found[part].sum() == pytest.approx(stated[part].sum(), rel=0.15)


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
    agree(Instruments(KeptBack(), rough), "tractor_ay_mps2", 2.0, part)


def test_the_tone_of_a_frame_is_where_it_sounds() -> None:
    loud = Instruments(KeptBack(), replace(CALM, frame=5.0))
    line = round(2.0 * DURATION_S * loud.rough.frame_hz)  # type: ignore[union-attr]
    agree(loud, "tractor_ay_mps2", 2.0, slice(line - 5, line + 6))
    agree(Instruments(KeptBack(), replace(CALM, frame=5.0)), "hub_speed_steer_left_radps", 2.0,
          slice(line - 5, line + 6))


@pytest.mark.parametrize("channel", ["tractor_yaw_rate_radps", "tractor_vx_mps",
                                     "trailer_ax_mps2"])
@pytest.mark.parametrize("later", [True, False])
def test_the_instruments_kept_back(channel: str, later: bool) -> None:
    assert BUS  # rounding of the bus is coarser than that of the unit
    agree(Instruments(KeptBack(instruments=True, later=later), None), channel, 20.0, slice(3, 150))
