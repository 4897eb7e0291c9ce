"""Our bags in readers that others wrote: mcap, mcap-ros2-support, rosbags, JavaScript."""

from __future__ import annotations

import json
import shutil
import subprocess
from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mcap.reader import make_reader
from mcap.stream_reader import StreamReader
from mcap_ros2.decoder import DecoderFactory
from rosbags.highlevel import AnyReader
from rosbags.rosbag2 import Reader
from rosbags.typesys import Stores, get_typestore

from truck_blowout_sim.recordings import ATMOSPHERE_PA, Recording, write_recording

JAVASCRIPT = Path(__file__).with_name("javascript")


@pytest.fixture(scope="module")
def bag(tmp_path_factory: pytest.TempPathFactory, full_recording: Recording) -> Path:
    return write_recording(full_recording, tmp_path_factory.mktemp("foreign") / "bag")


def expected_counts(recording: Recording) -> dict[str, int]:
    return {
        "/truck/throttle": len(recording["throttle"]),
        "/truck/tractor/odometry": len(recording["tractor_x_m"]),
        "/truck/brake_chambers/steer_left/pressure": len(recording["brake_chamber_steer_left_pa"]),
        "/truck/tires/steer_left/pressure": len(recording["tire_pressure_steer_left_pa"]),
        "/truck/blowout": 3,
    }


def test_mcap_reads_it_with_checksums(bag: Path, full_recording: Recording) -> None:
    with (bag / "bag_0.mcap").open("rb") as file:
        reader = make_reader(file, validate_crcs=True)
        summary = reader.get_summary()
        assert summary is not None
        assert summary.statistics is not None
        counts: Counter[str] = Counter()
        last = 0
        for _, channel, message in reader.iter_messages():
            counts[channel.topic] += 1
            assert message.log_time == message.publish_time >= last
            last = message.log_time
    assert sum(counts.values()) == summary.statistics.message_count
    assert counts.items() >= expected_counts(full_recording).items()
    for channel in summary.channels.values():
        assert channel.topic.startswith("/truck/")
        assert channel.metadata["topic_type_hash"].startswith("RIHS01_")
        assert "reliability: reliable" in channel.metadata["offered_qos_profiles"]


def test_mcap_stream_reader_sees_messages_in_order_of_time(bag: Path) -> None:
    with (bag / "bag_0.mcap").open("rb") as file:
        times = [r.log_time for r in StreamReader(file, validate_crcs=True).records
                 if type(r).__name__ == "Message"]  # fmt: skip
    assert times == sorted(times)
    assert times[0] == 0


def test_mcap_ros2_support_decodes_the_numbers(bag: Path, full_recording: Recording) -> None:
    with (bag / "bag_0.mcap").open("rb") as file:
        reader = make_reader(file, decoder_factories=[DecoderFactory()])
        found = {
            channel.topic: message
            for _, channel, _, message in reader.iter_decoded_messages(ending_before=1)
        }
    check_first_instant(full_recording, found)
    assert found["/truck/tires/steer_left/pressure"].header.frame_id == "steer_left"


def test_rosbags_reads_the_folder(bag: Path, full_recording: Recording) -> None:
    with Reader(bag) as reader:
        assert reader.message_count == sum(c.msgcount for c in reader.connections)
        counts = {c.topic: c.msgcount for c in reader.connections}
        (blowout,) = (c for c in reader.connections if c.topic == "/truck/blowout")
        (profile,) = blowout.ext.offered_qos_profiles
        assert (profile.durability.name, profile.depth) == ("TRANSIENT_LOCAL", 100)
        assert reader.ros_distro == "kilted"
    assert counts.items() >= expected_counts(full_recording).items()
    with AnyReader([bag], default_typestore=get_typestore(Stores.ROS2_JAZZY)) as reader:
        found = {}
        for connection, stamp, data in reader.messages(stop=1):
            assert stamp == 0
            found[connection.topic] = reader.deserialize(data, connection.msgtype)
    check_first_instant(full_recording, found)


def test_javascript_reads_it(bag: Path, javascript: Path, full_recording: Recording) -> None:
    """As Foxglove does: by index, definitions from the file."""
    done = subprocess.run(
        ["node", str(javascript / "read_bag.mjs"), str(bag / "bag_0.mcap")],
        capture_output=True, text=True, check=False, timeout=120,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    topics: dict[str, Any] = json.loads(done.stdout)
    counts = {topic: entry["count"] for topic, entry in topics.items()}
    assert counts.items() >= expected_counts(full_recording).items()
    pressure = topics["/truck/tires/steer_left/pressure"]["first"]["fluid_pressure"]
    gauge = full_recording["tire_pressure_steer_left_pa"].value[0]
    assert pressure == pytest.approx(gauge + ATMOSPHERE_PA)
    speeds = topics["/truck/joint_states"]["first"]
    spin = speeds["velocity"][speeds["name"].index("drive_1_left_spin")]
    assert spin == full_recording["hub_speed_drive_1_left_radps"].value[0]


@pytest.fixture(scope="module")
def javascript(tmp_path_factory: pytest.TempPathFactory) -> Path:
    if not shutil.which("npm"):
        pytest.skip("npm is not installed")
    folder = tmp_path_factory.mktemp("javascript")
    for name in ("package.json", "read_bag.mjs"):
        shutil.copy(JAVASCRIPT / name, folder)
    words = ["npm", "install", "--no-audit", "--no-fund", "--prefer-offline"]
    try:
        done = subprocess.run(
            words, cwd=folder, capture_output=True, text=True, check=False, timeout=120
        )
    except subprocess.TimeoutExpired:
        pytest.skip("npm registry does not answer")
    if done.returncode:
        pytest.skip(f"npm packages cannot be had: {done.stderr.strip().splitlines()[-1:]}")
    return folder


def check_first_instant(recording: Recording, found: dict[str, Any]) -> None:
    """Numbers of time 0 in decoded messages of whichever reader."""

    def value(name: str) -> float:
        assert recording[name].time_s[0] == 0.0
        return float(recording[name].value[0])

    odometry = found["/truck/tractor/odometry"]
    assert odometry.pose.pose.position.x == value("tractor_x_m")
    assert odometry.twist.twist.linear.x == value("tractor_vx_mps")
    assert odometry.twist.covariance[7] == 1e9, "vy has no sample at 0"
    assert odometry.child_frame_id == "tractor/base_link"
    imu = found["/truck/trailer/imu"]
    assert imu.linear_acceleration.z == value("trailer_az_mps2")
    assert imu.angular_velocity.x == value("trailer_roll_rate_radps")
    w = imu.orientation
    assert np.hypot(np.hypot(w.x, w.y), np.hypot(w.z, w.w)) == pytest.approx(1.0)
    joints = found["/truck/joint_states"]
    position = dict(zip(joints.name, joints.position, strict=True))
    assert position["articulation"] == value("articulation_rad")
    assert position["steer_left_steer"] == value("steer_left_steer_rad")
    chamber = found["/truck/brake_chambers/trailer_1_left/pressure"]
    gauge = value("brake_chamber_trailer_1_left_pa")
    assert chamber.fluid_pressure == pytest.approx(gauge + ATMOSPHERE_PA)
