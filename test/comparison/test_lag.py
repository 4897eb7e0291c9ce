"""A shift in time is found, and a difference that is none is not called one."""

from __future__ import annotations

import numpy as np
import pytest

from truck_blowout_sim.comparison.lag import best_lag_s
from truck_blowout_sim.comparison.pairing import Pair

TIME = np.arange(0.0, 20.0, 0.01)


def swing(time_s: np.ndarray) -> np.ndarray:
    return np.sin(1.3 * time_s) * np.exp(-0.05 * time_s)


@pytest.mark.parametrize("late_s", [0.37, 0.05, -0.2])
def test_a_record_that_is_late_is_found_by_its_delay(late_s: float) -> None:
    pair = Pair("tractor_yaw_rate_radps", TIME, swing(TIME - late_s), swing(TIME))
    found = best_lag_s(pair)
    assert found == pytest.approx(late_s, abs=0.005)


def test_a_gain_error_is_no_lag() -> None:
    assert best_lag_s(Pair("tractor_yaw_rate_radps", TIME, 1.1 * swing(TIME), swing(TIME))) is None


def test_a_constant_offset_is_no_lag() -> None:
    assert best_lag_s(Pair("tractor_vx_mps", TIME, 0.0 * TIME + 1.0, 0.0 * TIME)) is None


def test_a_short_record_has_no_lag() -> None:
    pair = Pair("tractor_vx_mps", TIME[:200], swing(TIME[:200]), swing(TIME[:200]))
    assert best_lag_s(pair) is None
