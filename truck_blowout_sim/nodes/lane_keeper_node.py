"""An example of a controller: keeps the truck in its lane through a blowout, by topics alone.

`ros2 run truck_blowout_sim lane_keeper`. Reads `tractor/odometry` and `blown_tires`, writes
`steering_wheel_angle` and `throttle`, one message each for every odometry message, in simulated
time.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from nav_msgs.msg import Odometry
from rclpy.executors import Executor
from rclpy.node import Node
from std_msgs.msg import Float64, String

from truck_blowout_sim.nodes import runtime
from truck_blowout_sim.nodes.lane_control import CruiseControl, Lane, LaneKeeper
from truck_blowout_sim.nodes.parameters import Spec
from truck_blowout_sim.nodes.qos import publisher, reliable, state, subscription
from truck_blowout_sim.nodes.signals import StopFlag

ABOUT = ("Keeps a straight lane, also when a tire blows, using the simulator's topics alone."
         " Example: truck-blowout-lane-keeper --speed-mps 20")

_FASTEST_MPS = 60.0
_NOISE_M = 1.0

SPECS = (
    Spec("speed_mps", 20.0, "Speed to hold.", "m/s", 1, 40),
    Spec("lane_x_m", 0.0, "A point of the lane in `map`.", "m", -1e6, 1e6),
    Spec("lane_y_m", 0.0, "Same, to the left.", "m", -1e6, 1e6),
    Spec("lane_heading_rad", 0.0, "Heading of the lane.", "rad", -7, 7),
    Spec("steering_ratio", 22.0, "Hand-wheel angle per road-wheel angle.", "", 1, 100),
    Spec("wheelbase_m", 5.8, "Wheelbase of the front unit.", "m", 1, 10),
    Spec("preview_s", 1.2, "How far ahead the driver looks.", "s", 0.2, 5),
    Spec("release_on_blowout", True, "Take the foot off the throttle when a tire blows."),
)


class LaneKeeperNode:
    """The node's parts."""

    def __init__(self, node: Node, values: dict[str, Any]) -> None:
        lane = Lane(values["lane_x_m"], values["lane_y_m"], values["lane_heading_rad"])
        self.keeper = LaneKeeper(
            lane, ratio=values["steering_ratio"], wheelbase_m=values["wheelbase_m"],
            preview_s=values["preview_s"],
        )  # fmt: skip
        self.cruise = CruiseControl(values["speed_mps"])
        self.log = node.get_logger()
        self.released = False
        self.release = bool(values["release_on_blowout"])
        self.speed_mps = float(values["speed_mps"])
        self._last_s: float | None = None
        self._last_m: tuple[float, float] | None = None
        self._wheel = publisher(node, Float64, "steering_wheel_angle", reliable())
        self._throttle = publisher(node, Float64, "throttle", reliable())
        subscription(node, Odometry, "tractor/odometry", self._drive, reliable(1))
        subscription(node, String, "blown_tires", self._blown, state())

    def run(self, executor: Executor, stop: StopFlag) -> int:
        """Answer every odometry message until asked to end."""
        self.log.info("keeping the lane; ready")
        while not stop:
            executor.spin_once(timeout_sec=0.1)
        return 0

    def close(self) -> None:
        """Nothing is left open."""

    def _drive(self, message: Odometry) -> None:
        now_s = message.header.stamp.sec + message.header.stamp.nanosec * 1e-9
        elapsed_s = now_s - self._last_s if self._last_s is not None else 0.0
        self._last_s = now_s
        place, turn = message.pose.pose.position, message.pose.pose.orientation
        if elapsed_s < 0.0 or self._was_moved(place.x, place.y, elapsed_s):
            self._begin_again()
            elapsed_s = 0.0
        yaw_rad = math.atan2(
            2 * (turn.w * turn.z + turn.x * turn.y), 1 - 2 * (turn.y**2 + turn.z**2)
        )
        motion = message.twist.twist
        wheel_rad = self.keeper.update(
            (place.x, place.y, yaw_rad), motion.linear.x, motion.linear.y, motion.angular.z,
            elapsed_s,
        )  # fmt: skip
        throttle = 0.0 if self.released else self.cruise.update(motion.linear.x, elapsed_s)
        self._wheel.publish(Float64(data=wheel_rad))
        self._throttle.publish(Float64(data=throttle))

    def _was_moved(self, x_m: float, y_m: float, elapsed_s: float) -> bool:
        """Whether the truck is where it cannot have driven: somebody called `reset`."""
        last_m, self._last_m = self._last_m, (x_m, y_m)
        if last_m is None:
            return False
        return math.dist(last_m, (x_m, y_m)) > _FASTEST_MPS * elapsed_s + _NOISE_M

    def _begin_again(self) -> None:
        """Another run, or another simulator: nothing learned in the last one holds."""
        self.log.info("the truck was put back: beginning again")
        self.keeper.integral_rad, self.keeper.wheel_rad = 0.0, 0.0
        self.cruise = CruiseControl(self.speed_mps)

    def _blown(self, message: String) -> None:
        """The state, not the event: a reset makes tires whole, a restarted simulator too."""
        if message.data:
            self.log.info(f"blown: {message.data.replace('+', ' and ')}")
        self.released = self.release and bool(message.data)


def main(arguments: Sequence[str] | None, stop: StopFlag) -> int:
    """Run the node; see `door.open_node`."""
    return runtime.run(
        "lane_keeper", SPECS, LaneKeeperNode, about=ABOUT, arguments=arguments, stop=stop
    )
