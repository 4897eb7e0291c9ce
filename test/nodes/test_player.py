"""The player: what it publishes, when, its services, foreign bags, its end."""

# ruff: noqa: ANN401 (fixtures and messages come from rclpy, which has no types for them)
from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from nav_msgs.msg import Odometry
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import SetParameters
from rclpy.serialization import deserialize_message
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import FluidPressure, Imu
from std_msgs.msg import Float64, String
from std_srvs.srv import Trigger

from truck_blowout_sim import Blowout, Recording, Series, write_recording
from truck_blowout_sim.nodes.playlist import Playlist
from truck_blowout_sim.recordings.channels import channels_for

ALONE = ("--wait-for-simulator-s", 0)
TIMES_S = np.arange(0.0, 1.5, 0.01)


@pytest.fixture(scope="module")
def log(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A second and a half of an instrumented test, tire pressure at 20 Hz."""
    ramp = Series(TIMES_S, 0.2 * TIMES_S)
    channels = {
        "steering_wheel_angle_rad": ramp,
        "tractor_vx_mps": Series(TIMES_S, 20.0 - TIMES_S),
        "tractor_yaw_rate_radps": Series(TIMES_S, 0.01 * TIMES_S),
        "tractor_ay_mps2": Series(TIMES_S, 0.3 * TIMES_S),
        "tire_pressure_steer_left_pa": Series(TIMES_S[::5], 700e3 - 1e5 * TIMES_S[::5]),
    }
    recording = Recording("log", channels, (Blowout(1.0, ("steer_left",)),))
    path = tmp_path_factory.mktemp("log") / "log.csv"
    write_recording(recording, path)
    return path


def stamp_s(message: Any) -> float:
    return message.header.stamp.sec + message.header.stamp.nanosec * 1e-9


def play(start: Any, client: Any, topic: str, *words: object) -> Any:
    """A player that begins once the test hears it."""
    player = start("player", *words, "--start-paused", *ALONE)
    client.until(lambda: client.node.count_publishers(topic), what=topic)
    client.meet("/truck/player")
    client.call(Trigger, "/truck/player/resume")
    return player


def test_plays_commands_measurements_and_the_event(start: Any, client: Any, log: Path) -> None:
    wheel = client.listen(Float64, "/truck/steering_wheel_angle")
    odometry = client.listen(Odometry, "/truck/measured/tractor/odometry")
    pressure = client.listen(FluidPressure, "/truck/measured/tires/steer_left/pressure")
    blowout = client.listen(String, "/truck/measured/blowout", client.latched)
    player = play(start, client, "/truck/steering_wheel_angle", log)
    assert player.wait() == 0
    client.until(lambda: len(wheel) >= 150 and len(odometry) >= 150, what="all of it")
    client.until(lambda: len(pressure) >= 30 and blowout, what="all of it")
    assert "/truck/steering_wheel_angle (std_msgs/msg/Float64): 150 messages" in player.output
    assert [m.data for m in wheel] == pytest.approx((0.2 * TIMES_S).tolist(), abs=1e-9)
    speeds = [m.twist.twist.linear.x for m in odometry]
    assert speeds == pytest.approx((20.0 - TIMES_S).tolist(), abs=1e-9)
    assert np.diff([stamp_s(m) for m in odometry]) == pytest.approx(0.01, abs=1e-6)
    assert len(pressure) == 30
    assert pressure[0].fluid_pressure == pytest.approx(801325.0)
    assert [m.data for m in blowout] == ["steer_left"]
    assert "nobody serves blowout/steer_left, 1.000 s into" in player.output
    assert "end of the recording: " in player.output


def test_what_was_not_measured_says_so(start: Any, client: Any, log: Path) -> None:
    imu = client.listen(Imu, "/truck/measured/tractor/imu")
    player = play(start, client, "/truck/measured/tractor/imu", log)
    client.until(lambda: imu, what="imu")
    assert imu[0].orientation_covariance[0] == -1.0
    assert player.wait() == 0


def test_rate_scales_time(start: Any, client: Any, log: Path) -> None:
    odometry = client.listen(Odometry, "/truck/measured/tractor/odometry")
    player = play(start, client, "/truck/measured/tractor/odometry", log, "--rate", 0.5)
    client.until(lambda: len(odometry) > 50, what="odometry")
    assert np.diff([stamp_s(m) for m in odometry]) == pytest.approx(0.02, abs=1e-6)
    assert player.stop() == 0


def test_offset_and_duration_cut_the_recording(start: Any, client: Any, log: Path) -> None:
    player = start("player", log, "--start-offset", 0.5, "--playback-duration", 0.25, *ALONE)
    assert player.wait() == 0
    assert "0.250 s from 0.500 s on" in player.output
    assert "no tire blown" in player.output


def test_play_next_seek_and_toggle(start: Any, client: Any, log: Path) -> None:
    player = start("player", log, "--start-paused", *ALONE)
    player.wait_for("blowout of steer_left")
    wheel = client.listen(Float64, "/truck/steering_wheel_angle")
    client.meet("/truck/player")
    assert client.call(Trigger, "/truck/player/is_paused").success
    for expected in ("played 0.000 s", "played 0.010 s"):
        assert client.call(Trigger, "/truck/player/play_next").message == expected
    client.until(lambda: len(wheel) == 2, what="two messages")
    value = ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=1.2)
    request = SetParameters.Request(parameters=[Parameter(name="seek_to_s", value=value)])
    client.call(SetParameters, "/truck/player/set_parameters", request)
    assert client.call(Trigger, "/truck/player/seek").success
    client.call(Trigger, "/truck/player/play_next")
    client.until(lambda: len(wheel) == 3, what="a third message")
    assert wheel[-1].data == pytest.approx(0.24)
    client.call(Trigger, "/truck/player/toggle_paused")
    assert not client.call(Trigger, "/truck/player/play_next").success
    assert player.wait() == 0
    client.until(lambda: len(wheel) >= 2 + 30, what="the rest")
    assert len(wheel) == 2 + 30


def test_loop_begins_again(start: Any, client: Any, log: Path) -> None:
    wheel = client.listen(Float64, "/truck/steering_wheel_angle")
    player = play(start, client, "/truck/steering_wheel_angle", log, "--loop", "--rate", 3)
    client.until(lambda: len(wheel) > 350, what="three rounds")
    values = np.array([m.data for m in wheel])
    assert (np.diff(values) < -0.25).sum() >= 2
    assert player.stop() == 0
    assert "stopped by SIGINT" in player.output


def test_a_foreign_bag_plays_by_remapping(start: Any, client: Any, tmp_path: Path) -> None:
    store = get_typestore(Stores.ROS2_HUMBLE)
    bag = tmp_path / "oxts"
    template = _foreign_odometry(store)
    with Writer(bag, version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        connection = writer.add_connection("/ins/odometry", template.__msgtype__, typestore=store)
        for i in range(50):
            template.twist.twist.linear.x = 10.0 + i
            stamp_ns = 1_700_000_000_000_000_000 + i * 10_000_000
            template.header.stamp.sec, template.header.stamp.nanosec = divmod(stamp_ns, 10**9)
            data = store.serialize_cdr(template, template.__msgtype__)
            writer.write(connection, stamp_ns, data)
    odometry = client.listen(Odometry, "/truck/measured/tractor/odometry")
    topic = "/truck/measured/tractor/odometry"
    player = play(start, client, topic, bag, "--remap", "/ins/odometry:=tractor/odometry")
    assert player.wait() == 0, player.output
    client.until(lambda: len(odometry) >= 50, what="all of it")
    assert [m.twist.twist.linear.x for m in odometry[-10:]] == [50.0 + i for i in range(10)]


def _foreign_odometry(store: Any) -> Any:
    from truck_blowout_sim.recordings.cdr import template
    from truck_blowout_sim.recordings.channels import ODOMETRY

    return store.deserialize_cdr(template(ODOMETRY, child_frame_id="ins"), ODOMETRY)


def test_a_clock_that_stands_a_rounding_before_a_message_does_not_hold_it(
    start: Any, client: Any, tmp_path: Path
) -> None:
    """At 1000 times the speed a nanosecond of the clock is a microsecond of the recording."""
    path = tmp_path / "fine.csv"
    angle = Series(np.array([0.0, 0.0100005, 0.02]), np.array([0.1, 0.2, 0.3]))
    write_recording(Recording("fine", {"steering_wheel_angle_rad": angle}), path)
    wheel = client.listen(Float64, "/truck/steering_wheel_angle")
    player = start("player", path, "--rate", 1000, *ALONE, "--delay", 2.0,
                   "--ros-args", "-p", "use_sim_time:=true")  # fmt: skip
    client.until(lambda: client.node.count_publishers("/truck/steering_wheel_angle"), what="player")
    client.meet("/truck/player")
    clock = client.node.create_publisher(Clock, "/clock", 10)

    def heard(messages: int, clock_ns: int) -> bool:
        message = Clock()
        message.clock.nanosec = clock_ns
        clock.publish(message)
        return len(wheel) == messages

    for messages, clock_ns in ((1, 0), (2, 10_000), (3, 20_000)):
        client.until(lambda m=messages, at=clock_ns: heard(m, at), 20.0, f"message {messages}")
    assert player.wait(20.0) == 0


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ((), "no recording named"),
        (("missing.csv",), "missing.csv"),
        (("LOG", "--remap", "nonsense"), "'nonsense' is no remapping"),
        (("LOG", "--start-offset", "99"), "start_offset 99 s lies behind its end"),
        (("LOG", "--rate", "0"), "rate"),
        (("LOG", "--no-such-option"), "unrecognized arguments"),
        (("LOG", "--measured", "a b"), "measured: 'a b'"),
        (("LOG", "--simulator", "a//b"), "simulator: 'a//b'"),
        (("LOG", "--ros-args", "-p", "also:=5"), "also: 5 is no list of texts"),
        (("LOG", "--ros-args", "-p", "also:=[1, 2]"), "also: "),
        (("LOG", "--ros-args", "-p", "also:=other.csv"), "other.csv: "),
        (("LOG", "--ros-args", "-p", "remap:=nonsense"), "'nonsense' is no remapping"),
        (("LOG", "--ros-args", "-r", "__ns:=/a b"), "a b"),
    ],
)
def test_bad_usage_is_one_line_and_status_2(
    start: Any, log: Path, words: tuple[str, ...], said: str
) -> None:
    player = start("player", *(str(log) if word == "LOG" else word for word in words))
    assert player.wait() == 2
    assert said in player.output
    assert "Traceback" not in player.output


def test_a_gauge_that_reads_below_zero_at_rest_is_no_refused_command() -> None:
    """Noise around a released pedal: the simulator would hold the last value before it."""
    times = np.array([0.0, 0.1, 0.2])
    log = Recording("log", {"brake_pressure_trailer_pa": Series(times, [2e5, 3e3, -700.0]),
                            "throttle": Series(times, [-0.02, 0.5, 1.03]),
                            "steering_wheel_angle_rad": Series(times, [-0.5, 0.0, 0.5])})
    (track,) = Playlist(log).tracks
    sent = dict(zip((c.name for c in log_rows(log)), track.values.T.tolist(), strict=True))
    assert sent == {"steering_wheel_angle_rad": [-0.5, 0.0, 0.5], "throttle": [0.0, 0.5, 1.0],
                    "brake_pressure_trailer_pa": [2e5, 3e3, 0.0]}


def test_what_was_commanded_before_an_instant_holds_there() -> None:
    """Commands of three rates, begun at 1 s: a pedal held since 0.3 s, one that is due itself."""
    log = Recording("log", {
        "throttle": Series(np.array([0.0, 0.3, 2.0]), np.array([0.1, 0.4, 0.9])),
        "steering_wheel_angle_rad": Series(np.array([0.9, 1.0, 1.1]), np.array([0.1, 0.2, 0.3])),
        "brake_pressure_steer_pa": Series(np.array([1.5, 1.6]), np.array([1e5, 2e5])),
    })  # fmt: skip
    held = Playlist(log).held(1.0)
    assert {topic: deserialize_message(data, Float64).data for topic, data in held.items()} == {
        "throttle": 0.4
    }


def log_rows(log: Recording) -> list[Any]:
    return [row for row in channels_for() if row.name in log]
