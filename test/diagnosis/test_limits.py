"""Amounts at a limit of nature, and what no channel can tell, in words."""

from __future__ import annotations

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.answer.limits import limit_sentence
from truck_blowout_sim.diagnosis.answer.told import alias_set
from truck_blowout_sim.diagnosis.effects import LIBRARY
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.ranked import Ranked
from truck_blowout_sim.diagnosis.prove.next_test import drivable
from truck_blowout_sim.vehicle import Packed


def hypothesis(name: str, truck: Packed, amount: float) -> Hypothesis:
    effect = next(e for e in LIBRARY if e.name == name)
    return Hypothesis(effect, effect.places(truck.vehicle)[0], amount)


def test_a_dead_brake_is_called_dead(truck: Packed) -> None:
    said = limit_sentence(hypothesis("brake_imbalance", truck, -1.0), (0.0, 0.04))
    assert said.startswith("The brake at steer_left is dead")
    assert "at most 4 percent" in said
    assert limit_sentence(hypothesis("brake_imbalance", truck, -0.6), (0.3, 0.5)) == ""


@pytest.mark.parametrize(("recorded", "names"), [
    ((), ("steering_lag", "channel_delay")),
    (("steer_left_steer_rad",), ("steering_lag",)),
])  # fmt: skip
def test_a_late_gear_and_instruments_that_are_late_together_need_the_road_wheels(
    truck: Packed, recorded: tuple[str, ...], names: tuple[str, ...]
) -> None:
    one = Ranked(hypothesis("steering_lag", truck, 0.2), 100.0, 0.01)
    assert alias_set([one], recorded).names == names


def test_no_run_is_proposed_that_puts_a_truck_on_its_side() -> None:
    channels = ("tractor_ay_mps2", "trailer_roll_rad")
    gentle = np.array([[1.5, 0.05], [1.8, 0.08]])
    assert drivable(channels, gentle, 2.0)
    assert not drivable(channels, gentle + np.array([0.0, 0.4]), 2.0)
    assert not drivable(channels, gentle + np.array([1.0, 0.0]), 2.0)
    assert not drivable(channels, gentle * np.nan, 2.0)
