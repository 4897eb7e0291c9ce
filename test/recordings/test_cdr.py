"""CDR messages taken apart and put together, with `rosbags` as the second opinion."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from rosbags.typesys import Stores, get_typestore

from truck_blowout_sim.recordings import channels_for
from truck_blowout_sim.recordings.cdr import MalformedMessageError, blocks, template, walk
from truck_blowout_sim.recordings.encoder import RowEncoder

STORE = get_typestore(Stores.ROS2_JAZZY)
TYPES = sorted({c.ros_type for c in channels_for() if c.place})


def joint_state(names: list[str], values: list[float]) -> bytes:
    return template("sensor_msgs/msg/JointState", name=names, velocity=np.array(values))


@pytest.mark.parametrize("ros_type", TYPES)
def test_every_number_is_found_where_rosbags_puts_it(ros_type: str) -> None:
    """Fill every float with a number of its own, serialise with rosbags, read at our places."""
    data = bytearray(template(ros_type, **({"name": ["a", "bcd"]} if "Joint" in ros_type else {})))
    layout = walk(bytes(data), ros_type)
    floats = {p: at for p, (at, code) in layout.numbers.items() if code == "f8"}
    for i, at in enumerate(floats.values()):
        data[at : at + 8] = np.float64(i + 0.5).tobytes()
    message = STORE.deserialize_cdr(bytes(data), ros_type)
    for i, path in enumerate(floats):
        value = message
        for step in path.replace("]", "").replace("[", ".").split("."):
            value = value[int(step)] if step.isdigit() else getattr(value, step)
        assert value == i + 0.5, path


def test_messages_of_several_layouts_are_sorted_into_blocks() -> None:
    messages = [
        joint_state(["a_spin", "b_spin"], [1.0, 2.0]),
        joint_state(["b_spin", "a_spin"], [3.0, 4.0]),
        joint_state(["a_spin", "b_spin"], [5.0, 6.0]),
        joint_state(["a_spin"], [7.0]),
    ]
    found = list(blocks(messages, "sensor_msgs/msg/JointState"))
    assert [b.index.tolist() for b in found] == [[0, 2], [1], [3]]
    assert found[0].number("velocity[1]").tolist() == [2.0, 6.0]
    assert found[1].layout.texts["name[0]"] == "b_spin"


def test_padding_of_another_writer_does_not_matter() -> None:
    """Some serialisers leave rubbish between fields."""
    pressure = "sensor_msgs/msg/FluidPressure"
    one = bytearray(template(pressure, header__frame_id="x", fluid_pressure=5.0))
    two = bytearray(one)
    at = walk(bytes(one), pressure).numbers["fluid_pressure"][0]
    two[at - 1] = 0xAA
    (block,) = blocks([bytes(one), bytes(two)], pressure)
    assert block.number("fluid_pressure").tolist() == [5.0, 5.0]


def test_big_endian_messages_are_read() -> None:
    data = b"\x00\x00\x00\x00" + np.array([2.5], dtype=">f8").tobytes()
    (block,) = blocks([data], "std_msgs/msg/Float64")
    assert block.number("data").tolist() == [2.5]


@pytest.mark.parametrize("ros_type", TYPES)
def test_cut_messages_are_refused_not_guessed(ros_type: str) -> None:
    whole = template(ros_type, **({"name": ["a"]} if "Joint" in ros_type else {}))
    for size in range(len(whole)):
        with pytest.raises(MalformedMessageError):
            walk(whole[:size], ros_type)


@given(st.sampled_from(TYPES), st.binary(max_size=400))
def test_random_bytes_never_surprise(ros_type: str, data: bytes) -> None:
    refused_at = 0
    try:
        list(blocks([data], ros_type))
    except MalformedMessageError as error:
        refused_at = error.args[1]
    assert refused_at == 0


def test_encoded_rows_are_what_rosbags_would_have_written() -> None:
    """Byte for byte, padding included."""
    table = [c for c in channels_for() if c.place]
    encoder = RowEncoder(table)
    rng = np.random.default_rng(1)
    messages = encoder.messages(5_000_000_007, rng.uniform(-1, 1, len(table)))
    assert len(messages) == len(encoder.slots) == len({c.topic for c in table})
    for slot in encoder.slots:
        message = STORE.deserialize_cdr(messages[slot.topic], slot.ros_type)
        assert bytes(STORE.serialize_cdr(message, slot.ros_type)) == messages[slot.topic]
        if hasattr(message, "header"):
            assert (message.header.stamp.sec, message.header.stamp.nanosec) == (5, 7)


@pytest.mark.parametrize("topics", [
    ("tractor/odometry",), ("trailer/imu", "tractor/yaw_rate"), ("joint_states",),
    ("tires/steer_left/pressure", "trailer/odometry"), ("no_such_topic",),
])  # fmt: skip
def test_some_topics_alone_are_filled_alike(topics: tuple[str, ...]) -> None:
    table = [c for c in channels_for() if c.place]
    encoder, values = RowEncoder(table), np.random.default_rng(2).uniform(-1, 1, len(table))
    every = encoder.messages(7_000_000_005, values)
    some = encoder.only(topics).messages(7_000_000_005, values)
    assert some == {topic: every[topic] for topic in topics if topic in every}


def test_what_was_not_measured_says_so() -> None:
    names = ("tractor_x_m", "tractor_yaw_rad", "tractor_yaw_rate_radps", "tractor_ay_mps2",
             "hub_speed_steer_left_radps")  # fmt: skip
    table = [c for c in channels_for() if c.name in names]
    encoder = RowEncoder(table, variances={"tractor_x_m": 0.04})
    messages = encoder.messages(0, np.arange(len(table)))
    odometry = STORE.deserialize_cdr(messages["tractor/odometry"], "nav_msgs/msg/Odometry")
    diagonal = odometry.pose.covariance[::7]
    assert diagonal.tolist() == [0.04, 1e9, 1e9, 1e9, 1e9, 0.0]
    assert odometry.twist.covariance[::7].tolist() == [1e9] * 5 + [0.0]
    assert (odometry.header.frame_id, odometry.child_frame_id) == ("map", "tractor/base_link")
    imu = STORE.deserialize_cdr(messages["tractor/imu"], "sensor_msgs/msg/Imu")
    assert imu.orientation_covariance[::4].tolist() == [1e9, 1e9, 0.0]
    assert imu.linear_acceleration_covariance[::4].tolist() == [1e9, 0.0, 1e9]
    joints = STORE.deserialize_cdr(messages["joint_states"], "sensor_msgs/msg/JointState")
    assert (joints.name, joints.velocity.tolist()) == (["steer_left_spin"], [4.0])
    assert not len(joints.position)
