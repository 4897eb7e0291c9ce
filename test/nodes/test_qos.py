"""Quality of service: every reader matches, overrides reach the topic they name, bags tell."""

# ruff: noqa: ANN401 (fixtures and messages come from rclpy, which has no types for them)
from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
import yaml
from mcap.reader import make_reader
from rcl_interfaces.srv import ListParameters
from rclpy.qos import QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import Imu
from std_srvs.srv import Trigger

IMU = "/truck/tractor/imu"
OTHER_IMU = "/truck/trailer/imu"
THROTTLE = "/truck/throttle"
BEST_EFFORT, RELIABLE = ReliabilityPolicy.BEST_EFFORT, ReliabilityPolicy.RELIABLE


def overrides(*words: str) -> tuple[str, ...]:
    """`-p qos_overrides.<word>` for each."""
    return ("--ros-args", *(part for word in words for part in ("-p", f"qos_overrides.{word}")))


def profiles(folder: Path) -> dict[str, dict[str, Any]]:
    """QoS profile by topic, as metadata.yaml has it."""
    tree = yaml.safe_load((folder / "metadata.yaml").read_text())["rosbag2_bagfile_information"]
    topics = [one["topic_metadata"] for one in tree["topics_with_message_count"]]
    return {one["name"]: one["offered_qos_profiles"][0] for one in topics}


def mcap_profiles(folder: Path) -> dict[str, dict[str, Any]]:
    """The same from the MCAP file alone."""
    (path,) = folder.glob("*.mcap")
    with path.open("rb") as stream:
        summary = make_reader(stream).get_summary()
    assert summary is not None
    return {
        channel.topic: yaml.safe_load(channel.metadata["offered_qos_profiles"])[0]
        for channel in summary.channels.values()
    }


@pytest.mark.parametrize("reliability", [BEST_EFFORT, RELIABLE], ids=["best_effort", "reliable"])
def test_a_reader_of_either_kind_hears_the_simulator(
    start: Any, client: Any, reliability: ReliabilityPolicy
) -> None:
    node = start("simulator")
    node.wait_for("ready")
    heard = client.listen(Imu, IMU, QoSProfile(depth=10, reliability=reliability))
    client.until(lambda: len(heard) > 5, what="the IMU")
    assert node.stop() == 0


def test_an_override_reaches_its_topic_alone_and_the_bag_says_so(
    start: Any, client: Any, tmp_path: Path
) -> None:
    words = (
        f"{IMU}.publisher.reliability:=best_effort",
        f"{IMU}.publisher.depth:=3",
        f"{THROTTLE}.subscription.reliability:=best_effort",
    )
    node = start("simulator", "--record-path", tmp_path / "bag", *overrides(*words))

    def offered(topic: str) -> set[ReliabilityPolicy]:
        ends = client.node.get_publishers_info_by_topic(topic)
        return {end.qos_profile.reliability for end in ends}

    for topic, wanted in ((IMU, BEST_EFFORT), (OTHER_IMU, RELIABLE), ("/clock", RELIABLE)):
        client.until(lambda topic=topic: offered(topic), what=topic)
        assert offered(topic) == {wanted}, topic
    heard = client.listen(Imu, IMU, QoSProfile(depth=10, reliability=BEST_EFFORT))
    client.until(lambda: heard, what="the IMU")
    assert node.stop() == 0
    for found in (profiles(tmp_path / "bag"), mcap_profiles(tmp_path / "bag")):
        lossy = {t for t, qos in found.items() if qos["reliability"] == "best_effort"}
        assert lossy == {IMU, THROTTLE}
        assert (found[IMU]["depth"], found[OTHER_IMU]["depth"]) == (3, 10)


def test_every_topic_can_be_overridden_and_only_what_is_shows(start: Any, client: Any) -> None:
    asked = (
        "/clock.publisher.depth:=5", "/diagnostics.publisher.reliability:=reliable",
        "/truck/tire_forces.publisher.depth:=2", "/truck/blowout.publisher.depth:=50",
        f"{THROTTLE}.subscription.depth:=4",
    )  # fmt: skip
    node = start("simulator", *overrides(*asked))
    node.wait_for("ready")
    reply = client.call(ListParameters, "/truck/simulator/list_parameters")
    shown = {name for name in reply.result.names if name.startswith("qos_overrides.")}
    assert {f"qos_overrides.{word.split(':=')[0]}" for word in asked} <= shown
    # rclpy shows depth, history and reliability of a topic that is named
    assert {name.rsplit(".", 2)[0] for name in shown} == {
        f"qos_overrides.{word.rsplit('.', 2)[0]}" for word in asked
    }
    client.call(Trigger, "/truck/blowout/steer_left")  # makes its publisher once more
    assert client.call(Trigger, "/truck/reset").success
    assert node.stop() == 0


@pytest.mark.parametrize(
    ("word", "said"),
    [
        (f"{IMU}.publisher.reliability:=now_and_then", "now_and_then"),
        (f"{IMU}.publisher.depth:=-1", "depth -1"),
        (f"{IMU}.publisher.depth:=many", "many"),
    ],
)
def test_an_override_that_makes_no_sense_is_one_line_and_status_2(
    start: Any, word: str, said: str
) -> None:
    node = start("simulator", *overrides(word))
    assert node.wait() == 2
    assert f"qos_overrides.{IMU}.publisher" in node.output
    assert said in node.output
    assert "Traceback" not in node.output
