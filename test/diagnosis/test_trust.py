"""Where the model is believed less: from a braked flat tire on, and in turns near the limit."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.case.trust import calm, demand
from truck_blowout_sim.diagnosis.settings import Settings
from truck_blowout_sim.recordings import Recording, Series


@pytest.fixture
def rules(few: Settings) -> Settings:
    return replace(few, hard_from_mps2=3.0, hard_demand_s2pm=0.75)


def turning(ay_mps2: float, sign: float = 1.0) -> Recording:
    """20 m/s, straight but for a turn of so much lateral acceleration from 4 s to 6 s."""
    time_s = np.arange(0.0, 10.0, 0.01)
    rate = np.where((time_s >= 4.0) & (time_s < 6.0), sign * ay_mps2 / 20.0, 0.0)
    return Recording("turn", {
        "tractor_yaw_rate_radps": Series(time_s, rate),
        "tractor_vx_mps": Series(time_s, np.full(time_s.size, 20.0))})


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_the_hardest_turn_of_any_run_asks_for_more_by_what_it_exceeds(
    rules: Settings, sign: float
) -> None:
    runs = [turning(1.0, sign), turning(4.0, sign)]
    assert demand(runs, "tractor", rules) == pytest.approx(1.0 + 0.75 * (4.0 - 3.0), rel=0.01)


def test_a_gentle_turn_is_believed_as_ever(rules: Settings) -> None:
    assert demand([turning(2.9)], "tractor", rules) == 1.0
    assert demand([], "tractor", rules) == 1.0


def test_without_the_yaw_rate_no_turn_counts_as_hard(rules: Settings) -> None:
    blind = turning(6.0)
    blind = replace(blind, channels={n: s for n, s in blind.channels.items() if "yaw" not in n})
    assert demand([blind], "tractor", rules) == 1.0


def test_on_a_straight_course_a_smaller_force_is_one(rules: Settings) -> None:
    strict = replace(rules, calm_below_mps2=2.0, calm_share=0.35)
    shares = [calm([turning(hard)], "tractor", strict) for hard in (0.0, 1.0, 2.5)]
    assert shares == pytest.approx([0.35, 0.675, 1.0], rel=0.01)
    assert calm([turning(0.0)], "tractor", replace(rules, calm_share=1.0)) == 1.0
