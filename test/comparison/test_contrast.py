"""What a comparison says of its rating, assumptions and lags; two recordings without a model."""

from __future__ import annotations

import numpy as np
import pytest

from truck_blowout_sim.comparison import Comparison, compare, compare_recordings, verdict
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import Blowout, Recording, Series

RECORD = "test_2013_steer_blowout"


@pytest.fixture(scope="module")
def compared() -> Comparison:
    return compare(RECORD, step_s=0.002, contrasted=True)


def test_another_vehicle_is_rated_on_the_same_channels(compared: Comparison) -> None:
    found = compared.contrast
    assert found is not None
    assert "rigid_truck" in found.others
    assert "trailer_yaw_rate_radps" not in found.channels  # not recorded
    assert "vehicles apart" in verdict(compared)


def test_the_headline_says_which_side_the_record_assumes(compared: Comparison) -> None:
    assert "which the record leaves open" in verdict(compared)


def test_a_late_gyro_is_said_in_the_headline(compared: Comparison) -> None:
    model = compared.model
    rate = model["tractor_yaw_rate_radps"]
    late = Series(rate.time_s, np.interp(rate.time_s - 0.37, rate.time_s, rate.value))
    record = Recording("late gyro", {"tractor_yaw_rate_radps": late,
                                     "tractor_vx_mps": model["tractor_vx_mps"]})  # fmt: skip
    said = verdict(compare_recordings(record, model))
    assert "yaw rate of the tractor is 0.37 s late" in said


def test_two_recordings_are_compared_without_a_model(compared: Comparison) -> None:
    model = compared.model
    same = compare_recordings(model, model)
    assert same.against == model.name
    assert all(channel.rms == 0.0 for channel in same.channels)
    assert model.name in verdict(same)


@pytest.mark.parametrize(("start_s", "blown_s", "told"), [
    (0.0, 9.0, False), (-4.92, 9.0, True), (-4.92, 4.0, False),
])  # fmt: skip
def test_clocks_that_start_apart_are_told(start_s: float, blown_s: float, told: bool) -> None:
    ramp = np.linspace(0.0, 15.0, 1501)
    runs = [Recording(name, {"tractor_vx_mps": Series(begin + ramp, 20.0 + ramp)},
                      (Blowout(at_s, ("steer_left",)),))
            for name, begin, at_s in (("one", 0.0, 4.0), ("two", start_s, blown_s))]  # fmt: skip
    words = ("the clocks start at different instants, 0 s in one and -4.92 s in two: no shift was"
             " applied")  # fmt: skip
    assert (words in compare_recordings(*runs).notes) == told


def test_recordings_without_a_common_channel_are_refused() -> None:
    time = np.linspace(0.0, 1.0, 50)
    one = Recording("one", {"tractor_vx_mps": Series(time, time)})
    two = Recording("two", {"tractor_ay_mps2": Series(time, time)})
    with pytest.raises(InputError, match="no output channel in common with two"):
        compare_recordings(one, two)
