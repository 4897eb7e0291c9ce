"""A run counts up to where the vehicle spins; a turn, and a gyro that is off, are no spin."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.case.runs import prepare_run
from truck_blowout_sim.diagnosis.case.sliding import spin_notes, spins_at_s
from truck_blowout_sim.diagnosis.settings import Settings
from truck_blowout_sim.recordings import Recording, Series
from truck_blowout_sim.vehicle import Packed

TIME_S = np.arange(0.0, 12.0, 0.01)


def turning(rate: np.ndarray, ay: np.ndarray, speed: float = 20.0) -> Recording:
    return Recording("run", {
        "tractor_yaw_rate_radps": Series(TIME_S, rate), "tractor_ay_mps2": Series(TIME_S, ay),
        "tractor_vx_mps": Series(TIME_S, np.full(TIME_S.size, speed))})


def test_a_vehicle_that_turns_more_than_its_path_spins() -> None:
    """Half a radian is reached half a second after the rear breaks away at 1 rad/s."""
    rate = np.where(TIME_S > 7.0, 1.0, 0.0)
    assert spins_at_s(turning(rate, 0.0 * rate), "tractor") == pytest.approx(7.5, abs=0.03)


@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_a_turn_on_its_path_is_no_spin(sign: float) -> None:
    rate = sign * 0.3 * np.minimum(TIME_S, 1.0)
    assert spins_at_s(turning(rate, 20.0 * rate), "tractor") == np.inf
    leaning = 20.0 * rate - 0.1 * 9.81 * sign
    assert spins_at_s(turning(rate, leaning), "tractor") == np.inf


def test_a_gyro_with_an_offset_is_no_spin() -> None:
    rate = np.full(TIME_S.size, np.radians(10.0))
    assert spins_at_s(turning(rate, 0.0 * rate), "tractor") == np.inf


def test_a_vehicle_that_creeps_is_no_spin() -> None:
    rate = np.full(TIME_S.size, 1.0)
    assert spins_at_s(turning(rate, 0.0 * rate, speed=4.0), "tractor") == np.inf


def test_without_one_of_the_channels_nothing_is_said() -> None:
    rate = np.full(TIME_S.size, 1.0)
    whole = turning(rate, 0.0 * rate)
    assert spins_at_s(whole, "tractor") < 1.0
    for name in whole.channels:
        left = whole.only_channels([n for n in whole.channels if n != name])
        assert spins_at_s(left, "tractor") == np.inf
        once = whole.with_channels({name: Series(TIME_S[:1], np.ones(1))})
        assert spins_at_s(once, "tractor") == np.inf


def test_a_run_counts_up_to_its_spin(
        truck: Packed, few: Settings, drive_it: Callable[..., Recording]) -> None:
    straight = drive_it()
    rate = straight["tractor_yaw_rate_radps"]
    spun = straight.with_channels({"tractor_yaw_rate_radps": Series(
        rate.time_s, np.where(rate.time_s > 4.0, 2.0, rate.value))})
    whole, cut = (prepare_run(one, "train", truck, few, step_s=0.0025)
                  for one in (straight, spun))
    assert cut.edges_s[-1] == pytest.approx(4.25, abs=0.15)
    assert cut.edges_s[-1] < whole.edges_s[-1] - 1.0
    assert cut.simulated(truck).shape == cut.measured.shape
    assert spin_notes([straight], "tractor") == []
    note, = spin_notes([straight, spun], "tractor")
    assert note.endswith(" s; what follows does not count")
    assert "the tractor spins at 4.3 s" in note
