"""Other stacks over DDS with their real messages, where they are built.

scripts/build_ros_messages.py builds them into a virtual environment.
"""

# ruff: noqa: ANN401 (fixtures and messages come from rclpy, which has no types for them)
from __future__ import annotations

import math
import time
from typing import Any

import pytest

pytest.importorskip("rclpy", reason="rclpy is not installed")

from geometry_msgs.msg import AccelWithCovarianceStamped
from nav_msgs.msg import Odometry
from rclpy.action.client import ActionClient
from std_srvs.srv import Trigger

START_MPS = 15.0
WAIT_S = 30.0


@pytest.fixture(scope="module")
def simulator(start: Any) -> Any:
    node = start("simulator", "--initial-speed-mps", START_MPS)
    node.wait_for("ready")
    return node


class Autoware:
    """What Autoware's gate sends, and what its planner hears."""

    def __init__(self, client: Any) -> None:
        control = pytest.importorskip("autoware_control_msgs.msg", reason="messages are not built")
        self.msg = pytest.importorskip("autoware_vehicle_msgs.msg", reason="messages are not built")
        self.srv = pytest.importorskip("autoware_vehicle_msgs.srv")
        self.client, self._control = client, control.Control
        self.heard = {
            name: client.listen(kind, topic)
            for name, kind, topic in (
                ("velocity", self.msg.VelocityReport, "/vehicle/status/velocity_status"),
                ("steering", self.msg.SteeringReport, "/vehicle/status/steering_status"),
                ("gear", self.msg.GearReport, "/vehicle/status/gear_status"),
                ("mode", self.msg.ControlModeReport, "/vehicle/status/control_mode"),
                ("place", Odometry, "/localization/kinematic_state"),
                ("acceleration", AccelWithCovarianceStamped, "/localization/acceleration"),
            )
        }
        self._command = client.talk(control.Control, "/control/command/control_cmd")
        self._gear = client.talk(self.msg.GearCommand, "/control/command/gear_cmd")

    def last(self, name: str) -> Any:
        self.client.until(lambda: self.heard[name], WAIT_S, name)
        return self.heard[name][-1]

    def command(self, steer_rad: float, speed_mps: float, done: Any, what: str) -> None:
        """Command at 50 Hz until something is so."""
        message = self._control()
        message.lateral.steering_tire_angle = steer_rad
        message.longitudinal.velocity = speed_mps
        message.longitudinal.is_defined_acceleration = False
        end_s = time.monotonic() + WAIT_S
        while not done():
            assert time.monotonic() < end_s, what
            self._command.publish(message)
            self.client.spin(0.02)

    def shift(self, gear: int) -> None:
        self._gear.publish(self.msg.GearCommand(command=gear))

    def mode(self, wanted: int) -> bool:
        request = self.srv.ControlModeCommand.Request(mode=wanted)
        answer = self.client.call(
            self.srv.ControlModeCommand, "/control/control_mode_request", request)  # fmt: skip
        return bool(answer.success)


@pytest.fixture
def autoware(simulator: Any, client: Any) -> Autoware:
    return Autoware(client)


def test_autoware_steers_and_hears_where_the_truck_is(autoware: Autoware) -> None:
    autoware.command(0.03, START_MPS, lambda: autoware.heard["steering"] and
                     autoware.last("steering").steering_tire_angle > 0.025, "the wheels to turn")
    autoware.command(0.03, START_MPS, lambda: autoware.last("velocity").heading_rate > 0.03,
                     "the truck to turn left")  # fmt: skip
    velocity, place = autoware.last("velocity"), autoware.last("place")
    assert velocity.header.frame_id == "base_link"
    assert velocity.longitudinal_velocity == pytest.approx(START_MPS, abs=2.0)
    assert (place.header.frame_id, place.child_frame_id) == ("map", "base_link")
    assert place.twist.twist.linear.x == pytest.approx(velocity.longitudinal_velocity, abs=0.5)
    centripetal = velocity.longitudinal_velocity * velocity.heading_rate
    assert autoware.last("acceleration").accel.accel.linear.y == pytest.approx(centripetal, abs=0.4)
    assert autoware.last("gear").report == autoware.msg.GearReport.DRIVE
    assert autoware.last("mode").mode == autoware.msg.ControlModeReport.AUTONOMOUS


def test_autoware_gives_the_wheel_back_and_parks(autoware: Autoware) -> None:
    modes = autoware.srv.ControlModeCommand.Request
    assert autoware.mode(modes.MANUAL)
    assert not autoware.mode(modes.AUTONOMOUS_STEER_ONLY)
    manual = autoware.msg.ControlModeReport.MANUAL
    autoware.client.until(lambda: autoware.last("mode").mode == manual, WAIT_S)
    assert autoware.mode(modes.AUTONOMOUS)
    autoware.shift(autoware.msg.GearCommand.PARK)
    parked = autoware.msg.GearReport.PARK
    autoware.client.until(lambda: autoware.last("gear").report == parked, WAIT_S)
    before_mps = autoware.last("velocity").longitudinal_velocity
    autoware.command(0.0, START_MPS, lambda: autoware.last("velocity").longitudinal_velocity <
                     before_mps - 2.0, "the parked truck to brake")  # fmt: skip


def test_ackermann_steers(simulator: Any, client: Any) -> None:
    msg = pytest.importorskip("ackermann_msgs.msg", reason="messages are not built")
    talk = client.talk(msg.AckermannDriveStamped, "/truck/ackermann_cmd")
    seen = client.listen(Odometry, "/truck/tractor/odometry")
    command = msg.AckermannDriveStamped()
    command.drive.steering_angle, command.drive.speed = -0.05, START_MPS
    end_s = time.monotonic() + WAIT_S
    while not (seen and seen[-1].twist.twist.angular.z < -0.02):
        assert time.monotonic() < end_s, "the truck to turn right"
        talk.publish(command)
        client.spin(0.02)


def test_frames_are_published_live(simulator: Any, client: Any) -> None:
    msg = pytest.importorskip("tf2_msgs.msg", reason="messages are not built")
    heard = client.first(msg.TFMessage, "/tf")
    frames = {(one.header.frame_id, one.child_frame_id) for one in heard.transforms}
    assert ("map", "tractor/base_link") in frames
    assert client.first(msg.TFMessage, "/tf_static", client.latched).transforms
    turn = heard.transforms[0].transform.rotation
    assert math.hypot(turn.x, turn.y, turn.z, turn.w) == pytest.approx(1.0, abs=1e-9)


def test_simulation_interfaces_pause_step_and_reset(simulator: Any, client: Any) -> None:
    srv = pytest.importorskip("simulation_interfaces.srv", reason="messages are not built")
    from simulation_interfaces.action import SimulateSteps
    from simulation_interfaces.msg import Result, SimulationState, SimulatorFeatures

    client.call(Trigger, "/truck/reset")
    client.call(Trigger, "/truck/resume")
    found = client.call(srv.GetSimulatorFeatures, "/truck/get_simulator_features")
    assert SimulatorFeatures.STEP_SIMULATION_ACTION in found.features.features
    pause = srv.SetSimulationState.Request(state=SimulationState(state=2))
    assert pause.state.state == SimulationState.STATE_PAUSED
    answer = client.call(srv.SetSimulationState, "/truck/set_simulation_state", pause)
    assert answer.result.result == Result.RESULT_OK
    seen = client.listen(Odometry, "/truck/tractor/odometry")
    client.meet("/truck/simulator")
    steps = srv.StepSimulation.Request(steps=5)

    def step() -> int:
        answer = client.call(srv.StepSimulation, "/truck/step_simulation", steps)
        assert answer.result.result == Result.RESULT_OK
        client.spin(0.1)
        return len(seen)

    # the reader may be found a moment after its node
    client.until(step, WAIT_S, "outputs of a step")
    seen.clear()
    client.until(lambda: step() >= 5, WAIT_S, "the outputs of every period")
    action = ActionClient(client.node, SimulateSteps, "/truck/simulate_steps")
    client.until(action.server_is_ready, what="the action")
    told: list[int] = []
    goal = action.send_goal_async(
        SimulateSteps.Goal(steps=4),
        feedback_callback=lambda one: told.append(one.feedback.completed_steps),
    )
    client.until(goal.done, what="the goal")
    result = goal.result().get_result_async()
    client.until(result.done, what="the result")
    assert result.result().result.result.result == Result.RESULT_OK
    client.until(lambda: len(told) == 4, what="feedback of every step")
    reset = srv.ResetSimulation.Request(scope=srv.ResetSimulation.Request.SCOPE_STATE)
    answer = client.call(srv.ResetSimulation, "/truck/reset_simulation", reset)
    assert answer.result.result == Result.RESULT_OK
