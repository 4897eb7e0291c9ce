"""Paced by the wall, as fast as possible, following /clock with pauses and jumps."""

# ruff: noqa: ANN401 (fixtures and messages come from rclpy, which has no types for them)
from __future__ import annotations

import time
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticArray
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import FluidPressure
from std_srvs.srv import Trigger

from truck_blowout_sim import read_recording
from truck_blowout_sim.nodes import clock_topics
from truck_blowout_sim.nodes.clock import FollowPace
from truck_blowout_sim.nodes.clock_topics import FollowedClock


def stamp_s(message: Any) -> float:
    return message.header.stamp.sec + message.header.stamp.nanosec * 1e-9


def clock_at(seconds: float) -> Clock:
    message = Clock()
    nanoseconds = round(seconds * 1e9)
    message.clock.sec, message.clock.nanosec = divmod(nanoseconds, 1_000_000_000)
    return message


def pace_of(message: DiagnosticArray) -> dict[str, str]:
    pace = next(status for status in message.status if status.name.endswith("pace"))
    return {pair.key: pair.value for pair in pace.values} | {"message": pace.message}


def simulated_per_second(client: Any, topic: str, wall_s: float) -> float:
    heard = client.listen(Odometry, topic)
    client.until(lambda: heard, what=topic)
    begin = time.monotonic(), stamp_s(heard[-1])
    client.spin(wall_s)
    return (stamp_s(heard[-1]) - begin[1]) / (time.monotonic() - begin[0])


@pytest.mark.parametrize("factor", [0.5, 1.0, 3.0])
def test_paced_by_the_wall_at_any_factor(start: Any, client: Any, factor: float) -> None:
    node = start("simulator", "--real-time-factor", factor)
    node.wait_for("ready")
    reports = client.listen(DiagnosticArray, "/diagnostics")
    # messages under way at either end count as time
    assert simulated_per_second(client, "/truck/tractor/odometry", 3.0) < 1.3 * factor
    client.until(lambda: len(reports) >= 4, what="diagnostics")
    for pace in map(pace_of, reports[1:]):
        got = float(pace["real_time_factor"])
        assert got < 1.05 * factor
        # A machine that is busy with other things loses time, and then the node says so.
        assert got > 0.9 * factor or "cannot keep pace" in pace["message"]
    assert node.stop() == 0


def test_as_fast_as_possible_is_far_faster_and_says_how_fast(start: Any, client: Any) -> None:
    node = start("simulator", "--real-time-factor", 0)
    node.wait_for("ready")
    reports = client.listen(DiagnosticArray, "/diagnostics")
    client.until(lambda: len(reports) >= 3, what="diagnostics")
    factor = float(pace_of(reports[-1])["real_time_factor"])
    assert factor > 2.0  # on an idle machine 50; this one may be busy
    assert node.stop() == 0


def test_a_factor_out_of_reach_is_reported_not_caught_up(start: Any, client: Any) -> None:
    node = start("simulator", "--real-time-factor", 1000)
    node.wait_for("ready")
    reports = client.listen(DiagnosticArray, "/diagnostics")
    client.until(lambda: len(reports) >= 3, what="diagnostics")
    assert "cannot keep pace" in pace_of(reports[-1])["message"]
    assert node.stop() == 0


def test_the_factor_can_be_changed_while_running(start: Any, client: Any) -> None:
    from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
    from rcl_interfaces.srv import SetParameters

    node = start("simulator", "--real-time-factor", 0.2)
    node.wait_for("ready")
    value = ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=2.0)
    request = SetParameters.Request(parameters=[Parameter(name="real_time_factor", value=value)])
    client.call(SetParameters, "/truck/simulator/set_parameters", request)
    # ten times as much is asked for; a busy machine gives some of it
    client.until(
        lambda: simulated_per_second(client, "/truck/tractor/odometry", 2.0) > 0.3, what="speed"
    )
    assert node.stop() == 0


class Followed:
    """A simulator that follows a clock which the test publishes."""

    def __init__(self, node: Any, client: Any) -> None:
        self.node, self.client = node, client
        self.clock = client.talk(Clock, "/clock")
        self.heard: list[Odometry] = client.listen(Odometry, "/truck/tractor/odometry")
        self.pressure: list[FluidPressure] = client.listen(
            FluidPressure, "/truck/tires/steer_left/pressure"
        )
        client.meet("/truck/simulator")

    def run(self, start_s: float, end_s: float, step_s: float = 0.02) -> None:
        """Publish a clock, and never be far ahead of the simulator."""
        for now_s in np.arange(start_s, end_s + step_s / 2, step_s):
            # at a jump nothing is published: that costs the whole patience
            for _ in range(50):
                self.clock.publish(clock_at(float(now_s)))
                self.client.spin(0.004)
                if self.at(float(now_s)):
                    break
        self.client.until(lambda: self.at(end_s), what=f"odometry of {end_s}")

    def at(self, time_s: float) -> bool:
        """Whether the simulator is there, and all of it has been heard."""
        ends = (self.heard, self.pressure)
        return all(one and abs(stamp_s(one[-1]) - time_s) < 0.005 for one in ends)

    @property
    def times_s(self) -> list[float]:
        return [stamp_s(message) for message in self.heard]


@pytest.fixture
def followed(start: Any, client: Any) -> Any:
    node = start("simulator", "--initial-speed-mps", 20, "--ros-args", "-p", "use_sim_time:=true")
    node.wait_for("ready")
    yield Followed(node, client)
    assert node.stop() == 0


def test_follows_a_clock_and_stands_while_it_stands(followed: Any, client: Any) -> None:
    followed.run(1000.0, 1001.0)
    assert np.allclose(np.diff([t for t in followed.times_s if t > 1000.0]), 0.01, atol=1e-9)
    count = len(followed.heard)
    for _ in range(20):
        followed.clock.publish(clock_at(1001.0))
        client.spin(0.02)
    assert len(followed.heard) == count
    followed.run(1001.02, 1001.5)
    assert followed.heard[-1].pose.pose.position.x == pytest.approx(30.0, abs=1.0)
    assert client.node.count_publishers("/clock") == 1


def test_a_bag_of_a_followed_run_begins_with_the_clock(
    start: Any, client: Any, tmp_path: Path
) -> None:
    node = start("simulator", "--record-path", tmp_path / "bag", "--ros-args", "-p",
                 "use_sim_time:=true")  # fmt: skip
    node.wait_for("ready")
    followed = Followed(node, client)
    followed.run(1_000_000.0, 1_000_000.5)
    assert node.stop() == 0
    bag = read_recording(tmp_path / "bag")
    assert bag.duration_s == pytest.approx(0.5, abs=0.02)


def test_a_second_clock_is_warned_of(start: Any, client: Any) -> None:
    node = start("simulator")
    client.node.create_publisher(Clock, "/clock", 10)
    node.wait_for("2 nodes publish /clock")
    assert node.stop() == 0


def test_a_jump_ahead_carries_the_truck_over(followed: Any) -> None:
    followed.run(50.0, 50.5)
    before = followed.heard[-1]
    followed.run(80.0, 80.1)
    after = followed.heard[-1]
    assert not [t for t in followed.times_s if 50.6 < t < 79.9]
    moved_m = after.pose.pose.position.x - before.pose.pose.position.x
    assert 0.0 < moved_m < 5.0
    followed.node.wait_for("jumped ahead from 50.5")


def test_a_jump_back_resets_and_says_so(followed: Any, client: Any) -> None:
    followed.run(50.0, 51.0)
    client.call(Trigger, "/truck/blowout/steer_left")
    followed.run(51.02, 52.0)
    assert followed.pressure[-1].fluid_pressure < 300e3
    followed.run(20.0, 20.2)
    followed.node.wait_for("jumped back from 52.000 to 20.000")
    assert followed.pressure[-1].fluid_pressure > 800e3
    assert followed.heard[-1].pose.pose.position.x == pytest.approx(4.0, abs=0.5)


def test_a_clock_below_zero_is_ignored(monkeypatch: pytest.MonkeyPatch) -> None:
    takes: list[Any] = []
    monkeypatch.setattr(
        clock_topics, "subscription", lambda _node, _kind, _topic, take, _qos: takes.append(take)
    )
    said: list[str] = []
    log = SimpleNamespace(warning=lambda words, **_: said.append(words), info=said.append)
    moved: list[int] = []
    plant = SimpleNamespace(ready=False, move_to=moved.append)
    pace = FollowPace(10_000_000)
    FollowedClock(cast(Any, None), cast(Any, SimpleNamespace(plant=plant, log=log)), pace, {})
    takes[0](clock_at(-5.0))
    assert (moved, pace.target_ns) == ([], None)
    assert said == ["a /clock below zero is ignored: no stamp has it"]
    takes[0](clock_at(5.0))
    assert moved == [5_000_000_000]
