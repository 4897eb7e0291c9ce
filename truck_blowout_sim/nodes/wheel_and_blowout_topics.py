"""Commands beside the five inputs: a road-wheel angle, and blowouts named on a topic."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rclpy.node import Node
from std_msgs.msg import Float64, String

from truck_blowout_sim.nodes.blowout_topic import BLOWOUT
from truck_blowout_sim.nodes.qos import reliable, subscription
from truck_blowout_sim.nodes.steering_gear import hand_wheel_rad

if TYPE_CHECKING:
    from truck_blowout_sim.nodes.simulator_node import Simulator

ROAD_WHEEL = "road_wheel_angle"


class RoadWheelTopic:
    """`road_wheel_angle`: mean angle of the steered wheels, rad, left positive.

    Becomes the hand-wheel angle that asks for it, with the same checks and timeout. The topic that
    sent last counts; where both sent since the last tick, this one.
    """

    def __init__(self, node: Node, simulator: Simulator) -> None:
        self._vehicle = simulator.plant.vehicle
        (self._wheel,) = (
            one for one in simulator.commands if one.guarded.name == "steering_wheel_angle_rad"
        )
        self._subscription = subscription(node, Float64, ROAD_WHEEL, self._take, reliable())
        self._wheel.share(self._subscription, self._take)

    def _take(self, message: Float64) -> None:
        self._wheel.take(hand_wheel_rad(self._vehicle, message.data), via=ROAD_WHEEL)


class BlowoutTopic:
    """`blowout` as an input (`blowout_input`): whatever tire is named there is blown.

    The simulator hears its own announcements there, too; a tire that is blown already stays so.
    """

    def __init__(self, node: Node, simulator: Simulator) -> None:
        self._simulator = simulator
        self._subscription = subscription(node, String, BLOWOUT, self._take, reliable(100))

    def forget(self) -> None:
        """Leave out what was named before a reset."""
        handle = self._subscription.handle
        with handle:
            while handle.take_message(String, False) is not None:
                pass

    def _take(self, message: String) -> None:
        simulator = self._simulator
        for part in filter(None, message.data.split("+")):
            if not simulator.plant.ready:
                simulator.log.warning(f"blowout of {part} ignored: {simulator.ready()[1]}")
            elif part not in simulator.plant.parts:
                simulator.log.warning(f"{part!r} on blowout is no tire of this vehicle")
            elif not simulator.plant.is_blown(part):
                simulator.blow(part)


def accept_wheel_and_blowout(node: Node, simulator: Simulator) -> BlowoutTopic | None:
    """Create the subscriptions; returns the one to blowouts if it is wanted."""
    RoadWheelTopic(node, simulator)
    return BlowoutTopic(node, simulator) if simulator.values["blowout_input"] else None
