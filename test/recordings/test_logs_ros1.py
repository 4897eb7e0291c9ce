"""ROS 1 bags: types with and without a header, compressed, damaged."""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from rosbags.rosbag1 import Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import read_recording
from truck_blowout_sim.recordings.logs import open_log
from truck_blowout_sim.recordings.logs.bag_log import HEADER, RECEIVE
from truck_blowout_sim.recordings.mapping.rules import Rules, Source

IN_TMP = settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=25)
REPORT = "Header header\nfloat32 speed\nfloat64[] wheels\ntime taken\nacme_msgs/Steer steer\n"
STEER = "Header header\nfloat64 angle_deg\n"
NS, START_NS, LATE_NS = 1_000_000_000, 1_700_000_000_000_000_000, 20_000_000
NUMBERS = st.floats(-1e6, 1e6)


def write(path: Path, frame: str = "base", values: Sequence[float] = (0.0, 1.0, 2.0),
          compression: str = "") -> Path:  # fmt: skip
    """A report of a stack's own type and a turn rate of a standard one, a message every 20 ms."""
    store = get_typestore(Stores.ROS1_NOETIC)
    store.register(get_types_from_msg(STEER, "acme_msgs/msg/Steer"))
    store.register(get_types_from_msg(REPORT, "acme_msgs/msg/Report"))
    types: Mapping[str, type] = store.types
    writer = Writer(path)
    if compression:
        writer.set_compression(Writer.CompressionFormat[compression])
    with writer:
        report, turn = (
            writer.add_connection(topic, ros_type, typestore=store)
            for topic, ros_type in (
                ("/report", "acme_msgs/msg/Report"),
                ("/turn", "geometry_msgs/msg/Vector3Stamped"),
            )
        )
        for i, value in enumerate(values):
            stamp_ns = START_NS + i * 20_000_000
            stamp = types["builtin_interfaces/msg/Time"](stamp_ns // NS, stamp_ns % NS)
            header = types["std_msgs/msg/Header"](i, stamp, frame)
            messages = {
                report: types["acme_msgs/msg/Report"](
                    header, value / 2, np.full(2, value), stamp,
                    types["acme_msgs/msg/Steer"](header, -value)),
                turn: types["geometry_msgs/msg/Vector3Stamped"](
                    header, types["geometry_msgs/msg/Vector3"](0.0, 0.0, value)),
            }  # fmt: skip
            for connection, message in messages.items():
                writer.write(connection, stamp_ns + LATE_NS,
                             store.serialize_ros1(message, connection.msgtype))  # fmt: skip
    return path


@IN_TMP
@given(st.lists(NUMBERS, min_size=1, max_size=5), st.text("abc/", max_size=9),
       st.sampled_from(["", "BZ2", "LZ4"]))  # fmt: skip
def test_every_number_of_a_message_with_a_header_comes_back(
    tmp_path: Path, values: list[float], frame: str, compression: str
) -> None:
    path = tmp_path / "old.bag"
    path.unlink(missing_ok=True)
    log = open_log(write(path, frame, values, compression))
    for name in ("/turn:vector.z", "/report:wheels[1]"):
        np.testing.assert_array_equal(log.column(name).values, values)
    np.testing.assert_array_equal(log.column("/report:steer.angle_deg").values, np.negative(values))
    speed = log.column("/report:speed")
    np.testing.assert_array_equal(speed.values, np.float32(np.divide(values, 2)))
    stamps_s = START_NS / NS + 0.02 * np.arange(len(values))
    np.testing.assert_allclose(speed.times[HEADER], stamps_s, atol=1e-6)
    np.testing.assert_allclose(speed.times[RECEIVE], stamps_s + LATE_NS / NS, atol=1e-6)


def test_a_ros_1_bag_is_read_by_a_mapping(tmp_path: Path) -> None:
    rules = Rules(channels={
        "tractor_yaw_rate_radps": Source("/turn:vector.z", "deg/s"),
        "steering_wheel_angle_rad": Source("/report:steer.angle_deg", "deg"),
    })  # fmt: skip
    read = read_recording(write(tmp_path / "old.bag"), mapping=rules)
    np.testing.assert_allclose(np.degrees(read["tractor_yaw_rate_radps"].value), [0.0, 1.0, 2.0])
    np.testing.assert_allclose(np.degrees(read["steering_wheel_angle_rad"].value), [0, -1.0, -2.0])
    assert any("/turn is received 0.020 s after its header stamp" in note for note in read.notes)


def test_two_types_on_a_topic_are_refused(tmp_path: Path) -> None:
    store = get_typestore(Stores.ROS1_NOETIC)
    path = tmp_path / "two.bag"
    with Writer(path) as writer:
        for ros_type in ("std_msgs/msg/Float32", "std_msgs/msg/Int32"):
            topic = writer.add_connection("/speed", ros_type, typestore=store)
            data = store.serialize_ros1(store.types[ros_type](1), ros_type)
            writer.write(topic, START_NS, data)
    with pytest.raises(InputError, match=r"two types, std_msgs/msg/Float32 and std_msgs/msg/Int32"):
        open_log(path)


@pytest.fixture(scope="module", params=["", "LZ4"])
def bag_bytes(tmp_path_factory: pytest.TempPathFactory, request: pytest.FixtureRequest) -> bytes:
    folder = tmp_path_factory.mktemp("ros1")
    return write(folder / "old.bag", compression=request.param).read_bytes()


@IN_TMP
@given(st.randoms(use_true_random=False), st.booleans())
def test_damage_gives_a_log_or_one_line(
    tmp_path: Path, bag_bytes: bytes, dice: random.Random, cut: bool
) -> None:
    data = bytearray(bag_bytes)
    for _ in range(4):
        data[dice.randrange(len(data))] = dice.randrange(256)
    path = tmp_path / "damaged.bag"
    path.write_bytes(data[: dice.randrange(len(data))] if cut else data)
    line = ""
    try:
        log = open_log(path)
        for name in log.names:
            log.column(name)
    except InputError as error:
        line = str(error)
    assert "\n" not in line
