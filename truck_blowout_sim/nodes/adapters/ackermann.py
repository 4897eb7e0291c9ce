"""ackermann_msgs: `ackermann_cmd` (AckermannDriveStamped) steers, drives and brakes the truck.

| field | becomes |
|---|---|
| drive.steering_angle | mean road-wheel angle times the steering ratio: `steering_wheel_angle` |
| drive.speed, drive.acceleration | `throttle`, and one pressure for all three brake circuits |

`steering_angle_velocity` and `jerk` are not used.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy.node import Node

from truck_blowout_sim.nodes.adapters.commands import ForeignCommands
from truck_blowout_sim.nodes.qos import reliable, subscription

if TYPE_CHECKING:
    from truck_blowout_sim.nodes.simulator_node import Simulator

TOPIC = "ackermann_cmd"


def attach(node: Node, simulator: Simulator) -> bool:
    """Subscribe, if ackermann_msgs is installed; returns whether it is."""
    try:
        from ackermann_msgs.msg import AckermannDriveStamped
    except ImportError:
        return False
    commands = ForeignCommands(simulator)

    def take(message: Any) -> None:  # noqa: ANN401  # a message class without types
        drive = message.drive
        commands.take(drive.steering_angle, drive.speed, drive.acceleration)

    subscription(node, AckermannDriveStamped, TOPIC, take, reliable())
    return True
