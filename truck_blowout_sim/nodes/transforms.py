"""/tf and /tf_static, where tf2_msgs is installed: each `base_link` in `map`, and the hitches."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from geometry_msgs.msg import TransformStamped
from numpy.typing import NDArray
from rclpy.node import Node

from truck_blowout_sim.nodes.clock import NS
from truck_blowout_sim.nodes.qos import event, publisher, reliable
from truck_blowout_sim.recordings.angles import quaternion
from truck_blowout_sim.vehicle import Vehicle
from truck_blowout_sim.vehicle.places import hitch_of


def tf_message_class() -> type[Any] | None:
    """tf2_msgs/TFMessage, or None where the package is not installed."""
    try:
        from tf2_msgs.msg import TFMessage
    except ImportError:
        return None
    return TFMessage


class Transforms:
    """Publishes the frames of a vehicle.

    Args:
        node: owner of the publishers.
        vehicle: whose frames.
        output_names: names of the model's output vector.
        message: class of the message.
    """

    def __init__(
        self, node: Node, vehicle: Vehicle, output_names: Sequence[str], message: type[Any]
    ) -> None:
        names = list(output_names)
        self._columns = [
            [names.index(f"{unit}_{key}") for key in
             ("x_m", "y_m", "z_m", "roll_rad", "pitch_rad", "yaw_rad")]
            for unit in vehicle.units
        ]  # fmt: skip
        moving = [_frame("map", f"{unit}/base_link") for unit in vehicle.units]
        self.message = message(transforms=moving)
        self._publisher = publisher(node, message, "/tf", reliable(100))
        self._static = publisher(node, message, "/tf_static", event())
        self._static.publish(message(transforms=hitch_frames(vehicle)))

    def publish(self, stamp_ns: int, outputs: NDArray[np.float64]) -> None:
        """Publish one instant."""
        seconds, nanoseconds = divmod(stamp_ns, NS)
        for frame, columns in zip(self.message.transforms, self._columns, strict=True):
            frame.header.stamp.sec, frame.header.stamp.nanosec = seconds, nanoseconds
            place, turn = frame.transform.translation, frame.transform.rotation
            place.x, place.y, place.z = outputs[columns[:3]].tolist()
            turn.x, turn.y, turn.z, turn.w = quaternion(*outputs[columns[3:]]).tolist()
        self._publisher.publish(self.message)


def hitch_frames(vehicle: Vehicle) -> list[TransformStamped]:
    """Fixed frames: fifth wheel and kingpin."""
    if len(vehicle.units) < 2:
        return []
    frames = []
    for unit, name in zip(vehicle.units, ("fifth_wheel", "kingpin"), strict=True):
        frame = _frame(f"{unit}/base_link", f"{unit}/{name}")
        place = frame.transform.translation
        place.x, place.y, place.z = hitch_of(vehicle, unit)
        frames.append(frame)
    return frames


def _frame(parent: str, child: str) -> TransformStamped:
    frame = TransformStamped(child_frame_id=child)
    frame.header.frame_id = parent
    frame.transform.rotation.w = 1.0
    return frame
