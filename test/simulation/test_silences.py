"""A hole in what drives a run is told."""

from __future__ import annotations

import numpy as np
import pytest

from truck_blowout_sim import load_vehicle, simulate
from truck_blowout_sim.recordings import Recording, Series
from truck_blowout_sim.simulation import simulate_inputs
from truck_blowout_sim.simulation.silences import silences
from truck_blowout_sim.simulation.start import initial_state

TIME_S = np.arange(0.0, 10.0, 0.01)


def holed(*holes: tuple[float, float], **metadata: str) -> Recording:
    keep = np.ones(TIME_S.size, dtype=np.bool_)
    for start_s, end_s in holes:
        keep &= (start_s >= TIME_S) | (end_s <= TIME_S)
    wheel = Series(TIME_S[keep], 0.1 * TIME_S[keep])
    return Recording("log", {"steering_wheel_angle_rad": wheel}, metadata=metadata)


def test_the_longest_hole_is_named_with_its_length() -> None:
    (note,) = silences(holed((2.0, 5.0), (7.0, 8.5)))
    assert note.startswith("steering_wheel_angle_rad has no samples from 2.00 s to 5.00 s (3.00 s,"
                           " the longest of 2 silences)")  # fmt: skip


def test_short_holes_and_held_commands_are_none() -> None:
    assert silences(holed((2.0, 2.5))) == ()
    assert silences(holed((2.0, 5.0), inputs="held until the next message")) == ()


def test_a_replay_tells_it() -> None:
    truck = load_vehicle("rigid_truck")
    run = simulate(truck, "coast_down").between(0.0, 3.0)
    wheel = run["steering_wheel_angle_rad"]
    keep = (wheel.time_s < 1.0) | (wheel.time_s > 2.5)
    cut = run.with_channels(
        {"steering_wheel_angle_rad": Series(wheel.time_s[keep], wheel.value[keep])})
    assert any("has no samples" in note for note in simulate_inputs(truck, cut).notes)


def test_a_command_that_begins_late_or_ends_early_is_told() -> None:
    throttle = {"throttle": Series(TIME_S, 0.0 * TIME_S)}
    late, early = (silences(holed(hole).with_channels(throttle))
                   for hole in ((-1.0, 3.0), (7.0, 10.0)))
    assert late == ("steering_wheel_angle_rad has no samples before 3.00 s: its first value stands"
                    " for them",)  # fmt: skip
    assert early == ("steering_wheel_angle_rad has no samples after 7.00 s: its last value is"
                     " held",)  # fmt: skip


def test_a_run_starts_at_the_first_speed_that_was_recorded() -> None:
    keep = TIME_S >= 3.5
    run = Recording("log", {"steering_wheel_angle_rad": Series(TIME_S, 0.0 * TIME_S),
                            "tractor_vx_mps": Series(TIME_S[keep], np.full(keep.sum(), 22.0))})
    assert initial_state(run).speed_mps == pytest.approx(22.0)
    assert silences(run) == ("tractor_vx_mps has no samples before 3.50 s: the run starts at its"
                             " first value",)  # fmt: skip
