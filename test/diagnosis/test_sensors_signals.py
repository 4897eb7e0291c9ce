"""The grid on which a recording is read, and the least that it must hold."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.sensors.signals import read_signals, smoothed
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import Recording, Series


def channel(rate_hz: float, count: int) -> Series:
    time_s = np.arange(count) / rate_hz
    return Series(time_s, 20.0 + np.sin(time_s))


def test_a_stop_of_six_seconds_at_ten_hertz_is_read() -> None:
    signals = read_signals(Recording("stop", {"tractor_vx_mps": channel(10.0, 60)}))
    assert signals.values["tractor_vx_mps"].size == 60


def test_a_short_burst_on_a_fast_clock_is_no_grid_for_the_others() -> None:
    recording = Recording("burst", {"tractor_vx_mps": channel(10.0, 300),
                                    "tractor_ax_mps2": channel(1000.0, 60)})
    assert read_signals(recording).time_s.size == 300


def test_less_than_tells_its_noise_is_refused() -> None:
    with pytest.raises(InputError, match="with 40 samples or more"):
        read_signals(Recording("short", {"tractor_vx_mps": channel(10.0, 39)}))


def test_a_pressure_at_rest_is_smoothed_without_a_warning() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        still = smoothed(np.full(500, 7e5), 8.0, sigma=2e4)
    assert still == pytest.approx(7e5)
