"""Bags round trip, keep their promises to ROS, and agree with CSVs of the same runs."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import yaml

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import (
    BagWriter,
    Recording,
    Series,
    by_name,
    channels_for,
    read_recording,
    write_recording,
)
from truck_blowout_sim.recordings.cdr import template

TABLE = by_name(channels_for())


def assert_same(again: Recording, original: Recording) -> None:
    assert set(again.channels) == set(original.channels)
    for name, series in original.channels.items():
        np.testing.assert_array_equal(again[name].time_s, series.time_s, err_msg=name)
        # absolute pressures and quaternions round in the last bit
        tolerance = 1e-9 if name.endswith("_pa") else 1e-14
        np.testing.assert_allclose(again[name].value, series.value, atol=tolerance, err_msg=name)
    assert again.blowouts == original.blowouts


@pytest.mark.parametrize("name", ["bag", "bare.mcap"])
def test_round_trip_with_rates_gaps_and_events(
    tmp_path: Path, full_recording: Recording, name: str
) -> None:
    again = read_recording(write_recording(full_recording, tmp_path / name))
    assert_same(again, full_recording)
    assert dict(again.metadata) == dict(full_recording.metadata)
    assert again.notes == ()


def test_time_before_zero_survives_though_stamps_cannot(
    tmp_path: Path, sparse_recording: Recording
) -> None:
    folder = write_recording(sparse_recording, tmp_path / "sparse")
    info = yaml.safe_load((folder / "metadata.yaml").read_text())["rosbag2_bagfile_information"]
    assert info["starting_time"]["nanoseconds_since_epoch"] == 0
    assert info["custom_data"]["time_origin_s"] == "-4.92"
    assert_same(read_recording(folder), sparse_recording)


def test_heading_is_continuous_over_several_turns(tmp_path: Path) -> None:
    time_s = np.arange(500) / 100
    recording = Recording("spin", {"tractor_yaw_rad": Series(time_s, 4 * time_s)})
    again = read_recording(write_recording(recording, tmp_path / "spin"))
    np.testing.assert_allclose(again["tractor_yaw_rad"].value, 4 * time_s, atol=1e-12)


def test_the_same_recording_gives_the_same_bytes(tmp_path: Path, full_recording: Recording) -> None:
    one = write_recording(full_recording, tmp_path / "a" / "bag")
    two = write_recording(full_recording, tmp_path / "b" / "bag")
    for name in ("bag_0.mcap", "metadata.yaml"):
        assert (one / name).read_bytes() == (two / name).read_bytes()


def test_a_bag_is_replaced_whole_and_nothing_else_is(
    tmp_path: Path, sparse_recording: Recording, full_recording: Recording
) -> None:
    bag = write_recording(full_recording, tmp_path / "bag")
    write_recording(sparse_recording, bag)
    assert_same(read_recording(bag), sparse_recording)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["bag"]
    (bag / "notes.txt").write_text("mine")
    with pytest.raises(InputError, match=r"notes\.txt"):
        write_recording(full_recording, bag)
    assert (bag / "notes.txt").read_text() == "mine"


def test_instruments_that_agree_with_the_csv_of_the_same_run(shared_recordings: Path) -> None:
    """Three runs recorded twice: as CSV (rounded) and as rosbag2 at 100, 50 and 20 Hz."""
    folder = shared_recordings / "proving_ground" / "nominal"
    for run in ("blowout", "lane_change", "coast_down"):
        csv, bag = read_recording(folder / f"{run}.csv"), read_recording(folder / run)
        extras = {name for name in bag.channels if not TABLE[name].standard}
        assert set(bag.channels) - extras == set(csv.channels)
        assert bag.blowouts == csv.blowouts
        assert bag.start_s == csv.start_s == 0.0
        for name, series in csv.channels.items():
            assert bag[name].period_s == pytest.approx(_period_s(name))
            rounding = {"Pa": 0.5, "rad/s": 5e-4}.get(TABLE[name].unit, 5e-7)
            difference = bag[name].value - series.at(bag[name].time_s)
            assert np.abs(difference).max() <= rounding * 1.001, name
        assert bag.metadata["test"] == csv.metadata["test"]
        assert bag.metadata["clock_start_s"] == "1700000000.0"


def test_foreign_topics_are_read_through_a_remapping(tmp_path: Path) -> None:
    """An INS driver of its own naming, on epoch time, with a steering sensor of the user's."""
    path = tmp_path / "foreign.mcap"
    with BagWriter(path, namespace="/ins", background=False) as writer:
        for i in range(50):
            stamp = {"header__stamp__sec": 1_700_000_000, "header__stamp__nanosec": i * 10**7}
            odometry = template(
                "nav_msgs/msg/Odometry", **stamp, twist__twist__linear__x=20.0 + i,
                pose__pose__position__y=0.5,
            )  # fmt: skip
            time_s = 1_700_000_000.0 + i * 0.01
            writer.message("odometry", "nav_msgs/msg/Odometry", time_s, odometry)
            angle = template("std_msgs/msg/Float64", data=0.1 * i)
            writer.message("/can/steering", "std_msgs/msg/Float64", time_s, angle)
    recording = read_recording(
        path,
        remap={"/ins/odometry": "tractor/odometry", "/can/steering": "steering_wheel_angle"},
    )
    assert recording["tractor_vx_mps"].value[10] == 30.0
    assert recording["tractor_y_m"].value[0] == 0.5
    np.testing.assert_allclose(recording["steering_wheel_angle_rad"].time_s,
                               np.arange(50) / 100, atol=3e-7)  # fmt: skip
    assert recording["tractor_vx_mps"].time_s[-1] == 0.49


def test_another_namespace_is_found_by_itself(tmp_path: Path) -> None:
    with BagWriter(tmp_path / "bag", namespace="/lorry_2", background=False) as writer:
        writer.write(0.0, {"tractor_vx_mps": 20.0, "throttle": 0.3})
    recording = read_recording(tmp_path / "bag")
    assert recording["throttle"].value.tolist() == [0.3]


def test_commands_logged_on_wall_time_are_put_on_simulation_time(tmp_path: Path) -> None:
    """`ros2 bag record` without simulation time: headers in simulation time, log in wall time."""
    path = tmp_path / "wall.mcap"
    half_speed_wall = 2.0
    with BagWriter(path, background=False) as writer:
        for i in range(200):
            sim_s = 0.01 * i
            wall_s = 1_700_000_000.0 + half_speed_wall * sim_s
            stamp = {"header__stamp__sec": int(sim_s), "header__stamp__nanosec": i % 100 * 10**7}
            message = template("nav_msgs/msg/Odometry", **stamp, twist__twist__linear__x=sim_s)
            writer.message("tractor/odometry", "nav_msgs/msg/Odometry", wall_s, message)
            command = template("std_msgs/msg/Float64", data=sim_s / 2)
            writer.message("throttle", "std_msgs/msg/Float64", wall_s, command)
        blown = template("std_msgs/msg/String", data="steer_left")
        writer.message("blowout", "std_msgs/msg/String", 1_700_000_002.0, blown)
    recording = read_recording(path)
    throttle = recording["throttle"]
    np.testing.assert_allclose(throttle.value, throttle.time_s / 2, atol=1e-6)
    assert recording.blowouts[0].time_s == pytest.approx(1.0, abs=1e-6)
    assert any("another clock" in note for note in recording.notes)


def _period_s(name: str) -> float:
    return {"brake_chamber": 0.02, "tire_pressure": 0.05}.get(TABLE[name].group, 0.01)
