"""Autoware: takes `control_cmd`, reports velocity and steering under Autoware's own names.

| topic | type | is |
|---|---|---|
| /control/command/control_cmd | autoware_control_msgs/Control | subscribed; steering_tire_angle, velocity, acceleration where it is defined |
| /vehicle/status/velocity_status | autoware_vehicle_msgs/VelocityReport | published at `publish_rate_hz` |
| /vehicle/status/steering_status | autoware_vehicle_msgs/SteeringReport | same |

Gear, turn signals and control mode are left to Autoware's own dummies.
"""  # noqa: E501  # a table

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy.node import Node

from truck_blowout_sim.nodes.adapters.commands import ForeignCommands
from truck_blowout_sim.nodes.clock import NS
from truck_blowout_sim.nodes.qos import publisher, reliable, subscription

if TYPE_CHECKING:
    from truck_blowout_sim.nodes.simulator_node import Simulator

COMMAND = "/control/command/control_cmd"
VELOCITY = "/vehicle/status/velocity_status"
STEERING = "/vehicle/status/steering_status"
_FRAME = "base_link"


def attach(node: Node, simulator: Simulator) -> bool:
    """Subscribe and publish, if Autoware's messages are installed; returns whether they are."""
    try:
        from autoware_control_msgs.msg import Control
        from autoware_vehicle_msgs.msg import SteeringReport, VelocityReport
    except ImportError:
        return False
    commands = ForeignCommands(simulator)

    def take(message: Any) -> None:  # noqa: ANN401  # a message class without types
        longitudinal = message.longitudinal
        wanted_mps2 = longitudinal.acceleration if longitudinal.is_defined_acceleration else 0.0
        commands.take(message.lateral.steering_tire_angle, longitudinal.velocity, wanted_mps2)

    subscription(node, Control, COMMAND, take, reliable(1))
    velocity = publisher(node, VelocityReport, VELOCITY, reliable(1))
    steering = publisher(node, SteeringReport, STEERING, reliable(1))
    names = list(simulator.plant.output_names)
    columns = [names.index(f"tractor_{key}") for key in ("vx_mps", "vy_mps", "yaw_rate_radps")]

    def report(now_ns: int) -> None:
        outputs = simulator.plant.outputs()
        speed = VelocityReport()
        speed.header.frame_id = _FRAME
        speed.header.stamp.sec, speed.header.stamp.nanosec = divmod(now_ns, NS)
        speed.longitudinal_velocity, speed.lateral_velocity, speed.heading_rate = (
            float(outputs[column]) for column in columns
        )
        velocity.publish(speed)
        angle = SteeringReport()
        angle.stamp.sec, angle.stamp.nanosec = divmod(now_ns, NS)
        angle.steering_tire_angle = commands.steer_rad
        steering.publish(angle)

    simulator.outputs.also(report)
    return True
