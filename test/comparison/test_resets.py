"""A reset in the middle of a recording is seen, and the longest run is what is compared."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from truck_blowout_sim.comparison.resets import longest_run
from truck_blowout_sim.recordings import Blowout, Recording, Series, read_recording, write_recording
from truck_blowout_sim.recordings.resets import reset_times_s

TIME = np.arange(0.0, 10.0, 0.01)


def driving(reset_at_s: float | None) -> Recording:
    x = 20.0 * TIME
    if reset_at_s is not None:
        x = np.where(reset_at_s <= TIME, x - 20.0 * reset_at_s, x)
    return Recording("drive", {"tractor_x_m": Series(TIME, x),
                               "tractor_y_m": Series(TIME, 0.0 * TIME)})  # fmt: skip


def test_a_steady_drive_has_no_reset() -> None:
    whole = driving(None)
    assert reset_times_s(whole.channels) == ()
    assert longest_run(whole) is whole


def test_a_reset_is_found_and_the_longer_part_kept() -> None:
    whole = driving(3.0)
    (at,) = reset_times_s(whole.channels)
    assert abs(at - 3.0) < 0.02
    kept = longest_run(whole)
    assert kept.start_s == at
    assert kept.end_s == whole.end_s
    assert "reset at 3.00 s" in kept.notes[-1]


def test_held_commands_last_beyond_a_reset() -> None:
    once = {"steering_wheel_angle_rad": Series(np.zeros(1), np.full(1, 0.2)),
            "throttle": Series(np.zeros(1), np.full(1, 0.3))}  # fmt: skip
    whole = driving(3.0).with_channels(once).with_metadata(inputs="held until the next message")
    kept = longest_run(whole)
    assert kept.inputs_at([5.0])[0, :2].tolist() == [0.2, 0.3]


def test_a_gap_in_the_samples_is_no_reset() -> None:
    series = driving(None)["tractor_x_m"]
    keep = (series.time_s < 4.0) | (series.time_s > 6.0)
    gap = Recording("gap", {"tractor_x_m": Series(series.time_s[keep], series.value[keep])})
    assert reset_times_s(gap.channels) == ()


@pytest.mark.parametrize("name", ["two.csv", "two.mcap"])
def test_a_tire_may_burst_in_each_run(tmp_path: Path, name: str) -> None:
    events = (Blowout(1.0, ("steer_left",)), Blowout(5.0, ("steer_left",)))
    path = write_recording(replace(driving(3.0), blowouts=events), tmp_path / name)
    read = read_recording(path)
    assert read.blowouts == events
    assert not any("blown again" in note for note in read.notes)
    assert longest_run(read).blowouts == events[1:]
    moved = read_recording(path, blow=[Blowout(6.0, ("steer_left",))])
    assert moved.blowouts == (events[0], Blowout(6.0, ("steer_left",)))


def test_a_tire_that_is_named_twice_in_a_run_counts_once(tmp_path: Path) -> None:
    events = (Blowout(4.0, ("steer_left",)), Blowout(5.0, ("steer_left",)))
    path = write_recording(replace(driving(3.0), blowouts=events), tmp_path / "two.mcap")
    read = read_recording(path)
    assert read.blowouts == events[:1]
    assert "steer_left is blown again at 5.0 s: left out" in read.notes
