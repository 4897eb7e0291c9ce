"""Amounts at a limit of nature, and what no channel can tell, in words."""

from __future__ import annotations

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.answer.limits import (
    limit_of_search,
    limit_sentence,
    open_at_limit,
)
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


def test_a_flat_tire_that_drags_with_all_grip_is_at_a_limit_of_nature(truck: Packed) -> None:
    locked = hypothesis("blown_tire_drag", truck, 6.0)
    said = limit_sentence(locked, (5.2, 7.0))
    assert "hardly turns" in said
    assert "at least 520 percent" in said
    assert limit_of_search(locked) == ""
    assert limit_sentence(hypothesis("blown_tire_drag", truck, 4.0), (4.2, 5.8)) == ""
    flat = truck[f"tire.{locked.place.tire}.flat_rolling"]
    assert (1.0 + locked.amount) * flat > truck[f"tire.{locked.place.tire}.peak_y"]


def test_an_amount_at_the_end_of_the_search_is_a_limit_on_that_side(truck: Packed) -> None:
    longest = hypothesis("tire_relaxation", truck, 8.0)
    assert "a limit, not a measurement" in limit_of_search(longest)
    assert open_at_limit(longest, 6.9, 8.0) == (6.9, np.inf)
    backwards = hypothesis("roll_steer", truck, -1.0)
    assert open_at_limit(backwards, -1.0, -0.8) == (-np.inf, -0.8)


@pytest.mark.parametrize(("name", "amount"), [("tire_relaxation", 6.0), ("brake_imbalance", -1.0)])
def test_an_amount_inside_the_search_or_at_a_limit_of_nature_is_a_measurement(
    truck: Packed, name: str, amount: float
) -> None:
    inside = hypothesis(name, truck, amount)
    assert limit_of_search(inside) == ""
    assert open_at_limit(inside, amount, amount + 0.2) == (amount, amount + 0.2)


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
