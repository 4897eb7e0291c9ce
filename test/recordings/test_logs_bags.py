"""Bags of other stacks: foreign message types, SQLite, compressed."""

from __future__ import annotations

import random
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import read_recording
from truck_blowout_sim.recordings.logs import open_log
from truck_blowout_sim.recordings.mapping.rules import Rules, Source, TimeRule

IN_TMP = settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=25)
REPORT = "std_msgs/Header header\nfloat32 speed\nfloat64[4] wheels\nstring mode\n"
ANGLE = "float64 angle\n"
N, NS, START_NS, LATE_NS = 50, 1_000_000_000, 1_700_000_000_000_000_000, 120_000_000
SPEED, STEER = "/vehicle/report:speed", "/can/wheel:angle"
RULES = Rules(channels={
    "tractor_vx_mps": Source(SPEED, "km/h"),
    "steering_wheel_angle_rad": Source(STEER, "deg"),
    "hub_speed_steer_left_radps": Source("/vehicle/report:wheels[1]", "rpm"),
    "tractor_yaw_rad": Source("/ins/odom:pose.pose.orientation.yaw"),
    "tractor_roll_rad": Source("/ins/odom:pose.pose.orientation.roll"),
})  # fmt: skip


def write(path: Path, storage: StoragePlugin = StoragePlugin.MCAP,
          compression: CompressionMode | None = None, late_ns: int = LATE_NS,
          roll_variance: float = 0.0) -> Path:
    store = get_typestore(Stores.ROS2_JAZZY)
    store.register(get_types_from_msg(REPORT, "acme_msgs/msg/Report"))
    store.register(get_types_from_msg(ANGLE, "acme_msgs/msg/Angle"))
    types = store.types
    writer = Writer(path, version=9, storage_plugin=storage)
    if compression:
        writer.set_compression(compression, CompressionFormat.ZSTD)
    with writer:
        report, angle, odom = (
            writer.add_connection(topic, ros_type, typestore=store) for topic, ros_type in (
                ("/vehicle/report", "acme_msgs/msg/Report"), ("/can/wheel", "acme_msgs/msg/Angle"),
                ("/ins/odom", "nav_msgs/msg/Odometry")))
        zeros = np.zeros(36)
        variances = zeros.copy()
        variances[21] = roll_variance
        pose, twist = (types[f"geometry_msgs/msg/{n}"] for n in ("Pose", "Twist"))
        vector, point = (types[f"geometry_msgs/msg/{n}"] for n in ("Vector3", "Point"))
        for i in range(N):
            stamp_ns = START_NS + i * 20_000_000
            time = types["builtin_interfaces/msg/Time"](stamp_ns // NS, stamp_ns % NS)
            header = types["std_msgs/msg/Header"](time, "base")
            message = types["acme_msgs/msg/Report"](
                header, 72.0 + i, np.array([0.0, 30.0, 0.0, 0.0]), "auto" * (i % 3))
            received_ns = stamp_ns + late_ns
            writer.write(report, received_ns, store.serialize_cdr(message, report.msgtype))
            writer.write(angle, received_ns, store.serialize_cdr(
                types["acme_msgs/msg/Angle"](float(i)), angle.msgtype))
            half = 0.005 * i
            turn = types["geometry_msgs/msg/Quaternion"](0.0, 0.0, np.sin(half), np.cos(half))
            place = types["geometry_msgs/msg/PoseWithCovariance"](
                pose(point(float(i), 0.0, 0.0), turn), variances)
            moving = types["geometry_msgs/msg/TwistWithCovariance"](
                twist(vector(20.0, 0.0, 0.0), vector(0.0, 0.0, 0.1)), zeros)
            odometry = types["nav_msgs/msg/Odometry"](header, "base", place, moving)
            writer.write(odom, received_ns, store.serialize_cdr(odometry, odom.msgtype))
    return path


@pytest.mark.parametrize("storage", [StoragePlugin.MCAP, StoragePlugin.SQLITE3])
@pytest.mark.parametrize("compression", [None, CompressionMode.FILE, CompressionMode.MESSAGE])
def test_any_storage_and_type_is_read_by_field_path(
    tmp_path: Path, storage: StoragePlugin, compression: CompressionMode | None
) -> None:
    bag = write(tmp_path / "bag", storage, compression)
    read = read_recording(bag, mapping=RULES)
    np.testing.assert_allclose(read["tractor_vx_mps"].value, (72.0 + np.arange(N)) / 3.6)
    np.testing.assert_allclose(read["tractor_vx_mps"].time_s, 0.02 * np.arange(N), atol=1e-6)
    np.testing.assert_allclose(read["tractor_yaw_rad"].value, 0.01 * np.arange(N), atol=1e-12)
    assert read["hub_speed_steer_left_radps"].value[0] == pytest.approx(np.pi)
    np.testing.assert_allclose(
        read["steering_wheel_angle_rad"].time_s, 0.12 + 0.02 * np.arange(N), atol=1e-6)
    assert any("received 0.120 s after its header stamp" in note for note in read.notes)


def test_planar_odometry_is_no_measured_roll(tmp_path: Path) -> None:
    read = read_recording(write(tmp_path / "bag"), mapping=RULES)
    assert "tractor_roll_rad" not in read
    assert any("planar odometry): tractor_roll_rad" in note for note in read.notes)


PLANAR = Rules(topics={"tractor/odometry": "/ins/odom"})


def test_planar_odometry_of_a_mapped_topic_is_no_measured_roll(tmp_path: Path) -> None:
    bag = write(tmp_path / "bag")
    read = read_recording(bag, mapping=PLANAR)
    assert set(read.channels) == {f"tractor_{stem}" for stem in (
        "x_m", "y_m", "yaw_rad", "vx_mps", "yaw_rate_radps")}  # fmt: skip
    assert any("planar odometry): tractor_roll_rad, tractor_pitch_rad" in n for n in read.notes)
    unused = next(note for note in read.notes if "unused" in note)
    assert SPEED in unused
    assert "/ins/odom" not in unused
    remapped = read_recording(bag, remap={"/ins/odom": "tractor/odometry"})
    assert set(remapped.channels) == set(read.channels)


@pytest.mark.parametrize("rules", [PLANAR, RULES])
@pytest.mark.parametrize(("variance", "told"), [(1.0, False), (2.5, True), (1e6, True)])
def test_a_variance_that_no_instrument_has_says_not_measured(
    tmp_path: Path, rules: Rules, variance: float, told: bool
) -> None:
    read = read_recording(write(tmp_path / "bag", roll_variance=variance), mapping=rules)
    assert "tractor_roll_rad" not in read
    words = "not measured, as the log itself says: tractor_roll_rad"
    assert (words in read.notes) == told


@pytest.mark.parametrize("rules", [PLANAR, RULES])
@pytest.mark.parametrize("variance", [0.0, 1e9])
def test_a_channel_that_is_mapped_and_was_dropped_may_be_excluded(
    tmp_path: Path, rules: Rules, variance: float
) -> None:
    bag = write(tmp_path / "bag", roll_variance=variance)
    read = read_recording(bag, mapping=replace(rules, exclude=("tractor_roll_rad",)))
    assert "tractor_roll_rad" not in read
    with pytest.raises(InputError, match="'tractor_rol_rad' is not recorded"):
        read_recording(bag, mapping=replace(rules, exclude=("tractor_rol_rad",)))


def test_receive_stamps_are_taken_where_asked_for(tmp_path: Path) -> None:
    rules = Rules(channels=RULES.channels, time=TimeRule("receive stamp"))
    for late_ns in (LATE_NS, 2 * NS):
        read = read_recording(write(tmp_path / f"{late_ns}", late_ns=late_ns), mapping=rules)
        assert read["tractor_vx_mps"].time_s[0] == 0.0
        assert read["steering_wheel_angle_rad"].time_s[0] == 0.0
        assert any("after its header stamp" in n and "the receive stamp is taken" in n
                   for n in read.notes)  # fmt: skip
        assert not any("header stamp is taken" in n or "no header" in n for n in read.notes)


@pytest.mark.parametrize(("late_ns", "words"), [
    (300_000_000, "receive stamps are taken, probably late by 0.300 s"),
    (2 * NS, "receive stamps are moved by -2.000 s"),
])  # fmt: skip
def test_what_becomes_of_a_topic_without_header_is_told(
    tmp_path: Path, late_ns: int, words: str
) -> None:
    read = read_recording(write(tmp_path / "bag", late_ns=late_ns), mapping=RULES)
    assert [n for n in read.notes if f"/can/wheel has no header stamp: its {words}" in n]


def test_a_recorder_on_another_clock_is_laid_on_the_stamps(tmp_path: Path) -> None:
    bag = write(tmp_path / "bag", late_ns=90 * 10**9)
    read = read_recording(bag, mapping=RULES)
    assert read["steering_wheel_angle_rad"].time_s[0] == pytest.approx(0.0, abs=1e-6)


def test_a_bare_sqlite_file(tmp_path: Path) -> None:
    folder = write(tmp_path / "bag", StoragePlugin.SQLITE3)
    (file,) = folder.glob("*.db3")
    assert SPEED in open_log(file).names


def test_a_field_that_is_not_there_names_the_nearest(tmp_path: Path) -> None:
    rules = Rules(channels={"tractor_vx_mps": Source("/vehicle/report:sped", "km/h")})
    with pytest.raises(InputError, match=r"expected /vehicle/report:speed"):
        read_recording(write(tmp_path / "bag"), mapping=rules)


@pytest.fixture(scope="module")
def sqlite_bytes(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    folder = write(tmp_path_factory.mktemp("bags") / "bag", StoragePlugin.SQLITE3)
    return next(folder.glob("*.db3")).read_bytes()


@IN_TMP
@given(st.randoms(use_true_random=False))
def test_damage_gives_a_recording_or_one_line(
    tmp_path: Path, sqlite_bytes: bytes, dice: random.Random
) -> None:
    data = bytearray(sqlite_bytes)
    for _ in range(20):
        data[dice.randrange(len(data))] = dice.randrange(256)
    path = tmp_path / "damaged.db3"
    path.write_bytes(data)
    line = ""
    try:
        read_recording(path, mapping=RULES)
    except InputError as error:
        line = str(error)
    assert "\n" not in line
