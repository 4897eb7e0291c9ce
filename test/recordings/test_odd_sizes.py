"""Numbers that a truck may have but hardly does: named with the unit behind them."""

from __future__ import annotations

import numpy as np
import pytest

from truck_blowout_sim.recordings import Recording, Series
from truck_blowout_sim.recordings.mapping.odd_sizes import odd_sizes


def test_a_burst_tire_is_no_odd_size() -> None:
    time_s = np.arange(0, 5, 0.1)
    gauge = Series(time_s, np.where(time_s < 1.0, 7.6e5, 1.9e3))
    assert not odd_sizes(Recording("drive", {"tire_pressure_steer_left_pa": gauge}))


def test_noise_of_a_gauge_is_no_pressure_in_another_unit() -> None:
    noise = np.abs(np.random.default_rng(1).normal(0.0, 200.0, 300))
    gauge = Series(0.01 * np.arange(300), noise)
    assert not odd_sizes(Recording("drive", {"brake_pressure_steer_pa": gauge}))
    applied = Series(gauge.time_s, 500.0 * np.sin(gauge.time_s) ** 2)
    assert odd_sizes(Recording("drive", {"brake_pressure_steer_pa": applied}))


@pytest.mark.parametrize(("name", "value", "words"), [
    ("tire_pressure_steer_left_pa", 110.0, "is 110 Pa: reads like psi taken for Pa"),
    ("tire_pressure_steer_left_pa", 7.58e3, "reads like bar taken for kPa"),
    ("tire_pressure_steer_left_pa", 7.58e5, ""), ("tire_pressure_steer_left_pa", 0.0, ""),
    ("brake_pressure_steer_pa", 2.4, "is 2.4 Pa: reads like bar taken for Pa"),
    ("brake_pressure_steer_pa", 0.0, ""), ("hub_speed_steer_left_radps", 41.0, ""),
    ("hub_speed_steer_left_radps", 72.0, "wheel of 0.278 m: reads like km/h taken for rad/s"),
    ("hub_speed_steer_left_radps", 382.0, "rpm taken for rad/s"),
    ("tractor_yaw_rate_radps", 1.5, "reaches 30 m/s2, more than tires hold: reads like deg/s"),
    ("tractor_yaw_rate_radps", 0.3, ""),
])  # fmt: skip
def test_an_odd_size_is_named_with_the_unit_behind_it(name: str, value: float, words: str) -> None:
    time_s = np.arange(0, 5, 0.1)
    both = {"tractor_vx_mps": np.full(time_s.size, 20.0), name: np.full(time_s.size, value)}
    drive = Recording("drive", {n: Series(time_s, v) for n, v in both.items()})
    said = " | ".join(odd_sizes(drive))
    assert words in said
    assert bool(said) == bool(words)
