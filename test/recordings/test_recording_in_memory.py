"""Series and recordings: what a user does with them."""

from __future__ import annotations

import pickle

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from truck_blowout_sim.recordings import INPUT_NAMES, Blowout, Recording, Series


def ramp(start_s: float, end_s: float, step_s: float = 0.1) -> Series:
    time_s = np.round(np.arange(round((end_s - start_s) / step_s) + 1) * step_s + start_s, 9)
    return Series(time_s, 2.0 * time_s)


def test_a_series_is_linear_between_samples_and_nothing_outside() -> None:
    out = ramp(0.0, 1.0).at([-0.01, 0.0, 0.25, 1.0, 1.01])
    np.testing.assert_allclose(out, [np.nan, 0.0, 0.5, 2.0, np.nan])


def test_gaps_are_found_and_not_bridged_when_asked() -> None:
    whole = ramp(0.0, 10.0)
    keep = (whole.time_s < 3.05) | (whole.time_s > 6.95)
    series = Series(whole.time_s[keep], whole.value[keep])
    assert series.gaps() == ((3.0, 7.0),)
    assert series.gaps(longer_than_s=5.0) == ()
    assert np.isnan(series.at(5.0, max_gap_s=1.0))
    assert series.at(5.0) == pytest.approx(10.0)
    assert series.at([3.0, 7.0], max_gap_s=1.0).tolist() == [6.0, 14.0]


@pytest.mark.parametrize(
    ("time_s", "value", "words"),
    [
        ([0.0, 1.0], [0.0], "differ"),
        ([0.0, 0.0], [1.0, 2.0], "increase"),
        ([1.0, 0.0], [1.0, 2.0], "increase"),
        ([0.0, 1.0], [np.nan, 2.0], "finite"),
        ([0.0, np.inf], [1.0, 2.0], "finite"),
    ],
)
def test_a_series_refuses_what_is_none(time_s: list[float], value: list[float], words: str) -> None:
    with pytest.raises(ValueError, match=words):
        Series(np.array(time_s), np.array(value))


def test_a_series_does_not_change_under_its_owner() -> None:
    values = np.zeros(3)
    series = Series(np.arange(3.0), values)
    values[:] = 7.0
    assert not series.value.any()
    with pytest.raises(ValueError, match="read-only"):
        series.value[0] = 1.0


def test_inputs_are_held_at_the_ends_and_nan_where_not_recorded() -> None:
    recording = Recording("r", {"throttle": ramp(0.0, 1.0), INPUT_NAMES[0]: ramp(0.0, 1.0)})
    inputs = recording.inputs_at([-1.0, 0.5, 9.0])
    np.testing.assert_allclose(inputs[:, 1], [0.0, 1.0, 2.0])
    assert np.isnan(inputs[:, 2:]).all()
    assert recording.missing_inputs == INPUT_NAMES[2:]


def test_commands_to_a_simulator_hold_until_the_next_one() -> None:
    series = Series(np.array([0.0, 0.3, 1.0]), np.array([1.0, 2.0, 3.0]))
    recording = Recording("r", {"throttle": series}, metadata={"inputs": "held"})
    times_s = [-1.0, 0.0, 0.299, 3 * 0.1, 0.999, 1.0, 9.0]
    assert recording.inputs_at(times_s)[:, 1].tolist() == [1.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0]


def test_a_part_keeps_its_events_and_drops_what_is_empty() -> None:
    recording = Recording(
        "r",
        {"throttle": ramp(0.0, 1.0), "tractor_vx_mps": ramp(2.0, 3.0)},
        (Blowout(2.5, ("steer_left",)), Blowout(0.5, ("steer_right",))),
    )
    assert (recording.start_s, recording.end_s, recording.duration_s) == (0.0, 3.0, 3.0)
    part = recording.between(1.5, 2.5)
    assert set(part.channels) == {"tractor_vx_mps"}
    assert part.blowouts == (Blowout(0.5, ("steer_right",)), Blowout(2.5, ("steer_left",)))
    assert [b.time_s for b in recording.blowouts] == [0.5, 2.5]


def test_a_part_keeps_the_tire_that_burst_before_it() -> None:
    burst = Blowout(0.5, ("steer_left",))
    part = Recording("r", {"tractor_vx_mps": ramp(0.0, 3.0)}, (burst,)).between(1.5, 2.5)
    assert part.blowouts == (burst,)
    assert (part.start_s, part.end_s) == (1.5, 2.5)


def test_a_part_keeps_the_command_that_was_given_before_it() -> None:
    channels = {"throttle": Series(np.array([0.0, 2.0]), np.array([0.3, 0.1])),
                "steering_wheel_angle_rad": Series(np.zeros(1), np.full(1, 0.2)),
                "tractor_vx_mps": ramp(0.0, 3.0)}  # fmt: skip
    held = Recording("r", channels, metadata={"inputs": "held until the next message"})
    part = held.between(1.5, 2.5)
    assert part["throttle"] == Series(np.array([1.5, 2.0]), np.array([0.3, 0.1]))
    assert part["steering_wheel_angle_rad"] == Series(np.array([1.5]), np.array([0.2]))
    linear = Recording("r", channels).between(1.5, 2.5)
    assert "steering_wheel_angle_rad" not in linear


def test_copies_leave_the_original_alone() -> None:
    recording = Recording("r", {"throttle": ramp(0.0, 1.0)}, metadata={"a": "1"})
    more = recording.with_channels({"tractor_x_m": ramp(0.0, 2.0)}).with_metadata(b="2")
    assert "tractor_x_m" in more
    assert "tractor_x_m" not in recording
    assert dict(more.metadata) == {"a": "1", "b": "2"}
    assert set(more.without_channels(["throttle"]).channels) == {"tractor_x_m"}
    assert set(more.only_channels(["throttle", "nothing"]).channels) == {"throttle"}
    assert recording.shifted(1.5).start_s == 1.5


def test_it_travels_to_other_processes(full_recording: Recording) -> None:
    again = pickle.loads(pickle.dumps(full_recording))
    assert dict(again.channels) == dict(full_recording.channels)
    assert again.blowouts == full_recording.blowouts


@given(st.lists(st.floats(-1e6, 1e6), min_size=1, max_size=30, unique=True), st.data())
def test_samples_themselves_are_returned(times: list[float], data: st.DataObject) -> None:
    time_s = np.array(sorted(times))
    value = np.array(data.draw(st.lists(st.floats(-1e9, 1e9), min_size=len(times),
                                        max_size=len(times))))  # fmt: skip
    np.testing.assert_allclose(Series(time_s, value).at(time_s), value)
