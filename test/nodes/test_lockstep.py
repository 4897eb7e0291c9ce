"""Steps on request: as many as asked, published before the reply, the same run twice."""

# ruff: noqa: ANN401 (fixtures and messages come from rclpy, which has no types for them)
from __future__ import annotations

from typing import Any

import pytest
from nav_msgs.msg import Odometry
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import SetParameters
from std_msgs.msg import Float64
from std_srvs.srv import Trigger


@pytest.fixture(scope="module")
def simulator(start: Any) -> Any:
    node = start("simulator", "--initial-speed-mps", 20, "--start-paused", "--blow",
                 "steer_left@0.5", "--step-awaits", "steering_wheel_angle,throttle")  # fmt: skip
    node.wait_for("ready")
    return node


def stamp_s(message: Any) -> float:
    return message.header.stamp.sec + message.header.stamp.nanosec * 1e-9


def set_parameter(client: Any, name: str, value: ParameterValue) -> Any:
    request = SetParameters.Request(parameters=[Parameter(name=name, value=value)])
    return client.call(SetParameters, "/truck/simulator/set_parameters", request).results[0]


def whole(value: int) -> ParameterValue:
    return ParameterValue(type=ParameterType.PARAMETER_INTEGER, integer_value=value)


def text(value: str) -> ParameterValue:
    return ParameterValue(type=ParameterType.PARAMETER_STRING, string_value=value)


Path = list[tuple[float, ...]]


def driven(client: Any, seen: list[Any], wheel: Any, pedal: Any, step: Any) -> Path:
    """A controller in the loop: 100 steps, each with commands from the last state."""
    client.call(Trigger, "/truck/reset")
    client.until(lambda: seen, what="the initial state")
    path = []
    for _ in range(100):
        place, motion = seen[-1].pose.pose.position, seen[-1].twist.twist
        wheel.publish(Float64(data=-2.0 * place.y - 3.0 * motion.angular.z))
        pedal.publish(Float64(data=max(0.0, 0.5 * (20.0 - motion.linear.x))))
        before = len(seen)
        future = step.call_async(Trigger.Request())
        client.until(future.done, what="step")
        assert future.result().success, future.result().message
        client.until(lambda before=before: len(seen) > before, what="the output of that instant")
        pose, motion = seen[-1].pose.pose, seen[-1].twist.twist
        path.append((pose.position.x, pose.position.y, pose.orientation.z, motion.angular.z))
    return path


def test_a_controller_in_the_loop_gives_the_same_run_twice(simulator: Any, client: Any) -> None:
    seen = client.listen(Odometry, "/truck/tractor/odometry")
    client.meet("/truck/simulator")
    wheel = client.talk(Float64, "/truck/steering_wheel_angle")
    pedal = client.talk(Float64, "/truck/throttle")
    step = client.node.create_client(Trigger, "/truck/step")
    client.until(step.service_is_ready, what="step")
    first = driven(client, seen, wheel, pedal, step)
    again = driven(client, seen, wheel, pedal, step)
    assert first == again
    # half way a tire blew, so that there was something to steer against
    rates = [abs(rate) for *_, rate in first]
    assert max(rates[50:]) > 10 * max(rates[:50])


def test_step_says_which_command_is_missing(simulator: Any, client: Any) -> None:
    wheel = client.talk(Float64, "/truck/steering_wheel_angle")
    wheel.publish(Float64(data=0.0))
    reply = client.call(Trigger, "/truck/step")
    assert not reply.success
    assert "no new message on throttle" in reply.message


def test_one_call_advances_many_periods(simulator: Any, client: Any) -> None:
    assert set_parameter(client, "step_awaits", text("")).successful
    assert set_parameter(client, "step_periods", whole(50)).successful
    seen = client.listen(Odometry, "/truck/tractor/odometry")
    client.meet("/truck/simulator")
    client.call(Trigger, "/truck/reset")
    client.until(lambda: seen, what="the initial state")
    begin_s = stamp_s(seen[-1])
    reply = client.call(Trigger, "/truck/step")
    assert reply.success
    assert reply.message.endswith("50 of 50 periods")
    client.until(lambda: stamp_s(seen[-1]) >= begin_s + 0.4999, what="outputs")
    assert len(seen) == 51
    assert stamp_s(seen[-1]) == pytest.approx(begin_s + 0.5, abs=1e-9)
    assert set_parameter(client, "step_periods", whole(1)).successful


def test_what_cannot_be_stepped_is_refused(simulator: Any, client: Any) -> None:
    assert not set_parameter(client, "step_periods", whole(0)).successful
    refused = set_parameter(client, "step_awaits", text("clutch"))
    assert not refused.successful
    assert "clutch" in refused.reason
    refused = set_parameter(client, "blow", text("steer_middle@3"))
    assert not refused.successful


def test_other_nodes_have_bags_written_under_one_folder_only(simulator: Any, client: Any) -> None:
    for path in ("/etc/bag", "../outside", "a/../../b"):
        refused = set_parameter(client, "record_path", text(path))
        assert not refused.successful
        assert "record_folder" in refused.reason
    assert set_parameter(client, "record_path", text("inside/bag")).successful
