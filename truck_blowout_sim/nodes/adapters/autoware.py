"""Autoware: takes commands, reports what a vehicle interface and a localization report.

| topic | type | is |
|---|---|---|
| /control/command/control_cmd | autoware_control_msgs/Control | subscribed; steering_tire_angle, velocity, acceleration where it is defined |
| /control/command/gear_cmd | autoware_vehicle_msgs/GearCommand | subscribed; the truck has forward gears only: what is no forward gear, neutral or park is refused |
| /vehicle/status/velocity_status | autoware_vehicle_msgs/VelocityReport | published, at the rear axle |
| /vehicle/status/steering_status | autoware_vehicle_msgs/SteeringReport | published |
| /vehicle/status/gear_status | autoware_vehicle_msgs/GearReport | published; the gear last commanded, DRIVE before that |
| /vehicle/status/control_mode | autoware_vehicle_msgs/ControlModeReport | published; AUTONOMOUS, or MANUAL if asked for |
| /localization/kinematic_state | nav_msgs/Odometry | published; `base_link` (rear axle, on the ground) in `map` |
| /localization/acceleration | geometry_msgs/AccelWithCovarianceStamped | published, there, in its axes |
| /control/control_mode_request | autoware_vehicle_msgs/ControlModeCommand | served; in MANUAL the truck listens to its own topics alone |
"""  # noqa: E501  # a table

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from geometry_msgs.msg import AccelWithCovarianceStamped
from nav_msgs.msg import Odometry
from rclpy.node import Node

from truck_blowout_sim.nodes.adapters.commands import ForeignCommands
from truck_blowout_sim.nodes.adapters.rear_axle import Motion, RearAxle
from truck_blowout_sim.nodes.clock import NS
from truck_blowout_sim.nodes.publishing import Readers
from truck_blowout_sim.nodes.qos import publisher, reliable, subscription

if TYPE_CHECKING:
    from truck_blowout_sim.nodes.simulator_node import Simulator

COMMAND, GEAR_COMMAND = "/control/command/control_cmd", "/control/command/gear_cmd"
MODE_REQUEST = "/control/control_mode_request"
VELOCITY, STEERING = "/vehicle/status/velocity_status", "/vehicle/status/steering_status"
GEAR, MODE = "/vehicle/status/gear_status", "/vehicle/status/control_mode"
KINEMATIC_STATE, ACCELERATION = "/localization/kinematic_state", "/localization/acceleration"
_FRAME, _MAP = "base_link", "map"


def attach(node: Node, simulator: Simulator) -> bool:
    """Subscribe and publish, if Autoware's messages are installed; returns whether they are."""
    try:
        from autoware_control_msgs.msg import Control
        from autoware_vehicle_msgs import msg, srv
    except ImportError:
        return False
    vehicle = AutowareVehicle(node, simulator, msg)
    subscription(node, Control, COMMAND, vehicle.take, reliable(1))
    subscription(node, msg.GearCommand, GEAR_COMMAND, vehicle.take_gear, reliable(1))
    node.create_service(srv.ControlModeCommand, MODE_REQUEST, vehicle.change_mode)
    simulator.outputs.also(vehicle.report)
    return True


class AutowareVehicle:
    """What Autoware takes for the vehicle.

    Args:
        node: owner of the publishers.
        simulator: whose truck it is.
        msg: the module autoware_vehicle_msgs.msg.
    """

    def __init__(self, node: Node, simulator: Simulator, msg: Any) -> None:  # noqa: ANN401
        self._plant = simulator.plant
        self._log = node.get_logger()
        self._commands = ForeignCommands(simulator)
        self._axle = RearAxle(simulator.plant.vehicle, simulator.plant.output_names)
        self._msg = msg
        self._gear: int = msg.GearReport.DRIVE
        self._mode: int = msg.ControlModeReport.AUTONOMOUS
        self._refused: int | None = None
        gears = [getattr(msg.GearCommand, f"DRIVE_{n}") for n in range(2, 19)]
        self._gears = {msg.GearCommand.DRIVE, msg.GearCommand.NEUTRAL, msg.GearCommand.PARK,
                       msg.GearCommand.LOW, msg.GearCommand.LOW_2, *gears}  # fmt: skip
        self._publishers = {
            topic: publisher(node, kind, topic, reliable(1))
            for topic, kind in (
                (VELOCITY, msg.VelocityReport), (STEERING, msg.SteeringReport),
                (GEAR, msg.GearReport), (MODE, msg.ControlModeReport),
                (KINEMATIC_STATE, Odometry), (ACCELERATION, AccelWithCovarianceStamped),
            )
        }  # fmt: skip
        self._readers = Readers(self._publishers)

    def take(self, message: Any) -> None:  # noqa: ANN401  # a message class without types
        """A control command."""
        if self._mode != self._msg.ControlModeReport.AUTONOMOUS:
            return
        wanted = message.longitudinal
        wanted_mps2 = wanted.acceleration if wanted.is_defined_acceleration else 0.0
        standing = self._gear in (self._msg.GearReport.PARK, self._msg.GearReport.NEUTRAL)
        speed_mps = 0.0 if standing else wanted.velocity
        self._commands.take(message.lateral.steering_tire_angle, speed_mps,
                            0.0 if standing else wanted_mps2)  # fmt: skip

    def take_gear(self, message: Any) -> None:  # noqa: ANN401
        """A gear command; in neutral and park the truck is braked to a stand."""
        if message.command in self._gears:
            self._gear = message.command
        elif message.command not in (self._msg.GearCommand.NONE, self._refused):
            self._refused = message.command
            self._log.warning(f"gear {message.command} refused: the truck drives forward only")

    def change_mode(self, request: Any, response: Any) -> Any:  # noqa: ANN401
        """Autonomous or manual; the modes between are not supported."""
        modes = self._msg.ControlModeReport
        known = {request.AUTONOMOUS: modes.AUTONOMOUS, request.MANUAL: modes.MANUAL}
        response.success = request.mode in known
        self._mode = known.get(request.mode, self._mode)
        return response

    def report(self, now_ns: int) -> None:
        """Publish the reports of one instant that somebody reads."""
        read = self._readers.topics()
        if read:
            motion = self._axle.motion(now_ns, self._plant.outputs())
            for topic in read:
                self._publishers[topic].publish(self._message(topic, now_ns, motion))

    def _message(self, topic: str, now_ns: int, motion: Motion) -> Any:  # noqa: ANN401
        if topic == KINEMATIC_STATE:
            return _odometry(now_ns, motion)
        if topic == ACCELERATION:
            return _acceleration(now_ns, motion)
        if topic == VELOCITY:
            return self._velocity(now_ns, motion)
        kind, key, value = {
            STEERING: (self._msg.SteeringReport, "steering_tire_angle", self._commands.steer_rad),
            GEAR: (self._msg.GearReport, "report", self._gear),
            MODE: (self._msg.ControlModeReport, "mode", self._mode),
        }[topic]
        message = kind()
        message.stamp.sec, message.stamp.nanosec = divmod(now_ns, NS)
        setattr(message, key, value)
        return message

    def _velocity(self, now_ns: int, motion: Motion) -> Any:  # noqa: ANN401
        out = self._msg.VelocityReport()
        _stamp(out.header, now_ns, _FRAME)
        out.longitudinal_velocity = float(motion.velocity_mps[0])
        out.lateral_velocity = float(motion.velocity_mps[1])
        out.heading_rate = float(motion.rate_radps[2])
        return out


def _odometry(now_ns: int, motion: Motion) -> Odometry:
    out = Odometry(child_frame_id=_FRAME)
    _stamp(out.header, now_ns, _MAP)
    place, turn = out.pose.pose.position, out.pose.pose.orientation
    place.x, place.y, place.z = motion.place_m.tolist()
    turn.x, turn.y, turn.z, turn.w = motion.turn.tolist()
    linear, angular = out.twist.twist.linear, out.twist.twist.angular
    linear.x, linear.y, linear.z = motion.velocity_mps.tolist()
    angular.x, angular.y, angular.z = motion.rate_radps.tolist()
    return out


def _acceleration(now_ns: int, motion: Motion) -> AccelWithCovarianceStamped:
    out = AccelWithCovarianceStamped()
    _stamp(out.header, now_ns, _FRAME)
    linear = out.accel.accel.linear
    linear.x, linear.y, linear.z = motion.acceleration_mps2.tolist()
    return out


def _stamp(header: Any, now_ns: int, frame: str) -> None:  # noqa: ANN401
    header.frame_id = frame
    header.stamp.sec, header.stamp.nanosec = divmod(now_ns, NS)
