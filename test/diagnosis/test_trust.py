"""Where the model is believed less: from a braked flat tire on, and in turns near the limit."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.settings import Settings
from truck_blowout_sim.diagnosis.trust import hard_turn
from truck_blowout_sim.recordings import Recording, Series
from truck_blowout_sim.vehicle import Packed

EDGES_S = np.arange(0.0, 10.05, 0.1)
MIDDLES_S = 0.5 * (EDGES_S[1:] + EDGES_S[:-1])


@pytest.fixture
def rules(few: Settings) -> Settings:
    return replace(few, hard_from_mps2=2.5, hard_growth_s2pm=1.0, correlation_s=0.5)


def turning(ay_mps2: float, sign: float = 1.0) -> Recording:
    """20 m/s, straight but for a turn of so much lateral acceleration from 4 s to 6 s."""
    time_s = np.arange(0.0, 10.0, 0.01)
    rate = np.where((time_s >= 4.0) & (time_s < 6.0), sign * ay_mps2 / 20.0, 0.0)
    return Recording("turn", {
        "tractor_yaw_rate_radps": Series(time_s, rate),
        "tractor_vx_mps": Series(time_s, np.full(time_s.size, 20.0))})


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_turn_counts_by_what_it_exceeds_and_as_long_as_a_difference_lasts(
    truck: Packed, rules: Settings, sign: float
) -> None:
    factor = hard_turn(turning(4.0, sign), truck, EDGES_S, rules)
    inside = (MIDDLES_S > 4.0) & (MIDDLES_S < 6.0)
    far = (MIDDLES_S < 3.4) | (MIDDLES_S > 6.6)
    np.testing.assert_allclose(factor[inside], 1.0 + (4.0 - 2.5))
    np.testing.assert_allclose(factor[far], 1.0)
    assert (factor[(MIDDLES_S > 3.6) & (MIDDLES_S < 4.0)] > 2.0).all()


def test_a_gentle_turn_is_believed_as_ever(truck: Packed, rules: Settings) -> None:
    np.testing.assert_array_equal(hard_turn(turning(2.4), truck, EDGES_S, rules), 1.0)


def test_without_the_yaw_rate_no_turn_counts_as_hard(truck: Packed, rules: Settings) -> None:
    blind = turning(6.0)
    blind = replace(blind, channels={n: s for n, s in blind.channels.items() if "yaw" not in n})
    np.testing.assert_array_equal(hard_turn(blind, truck, EDGES_S, rules), 1.0)
