"""Arrows for tire forces, for RViz and Foxglove: one for each tire, where it meets the road."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from builtin_interfaces.msg import Time
from geometry_msgs.msg import Point, Vector3
from numpy.typing import NDArray
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker, MarkerArray

from truck_blowout_sim.nodes.clock import NS
from truck_blowout_sim.vehicle import Vehicle
from truck_blowout_sim.vehicle.places import HubPlace, hub_places

METERS_PER_NEWTON = 1.0 / 20000.0
"""Length of an arrow: 1 m for 20 kN."""

_WHOLE = ColorRGBA(r=0.1, g=0.7, b=0.2, a=0.9)
_BLOWN = ColorRGBA(r=0.9, g=0.1, b=0.1, a=0.9)
_SIZE = Vector3(x=0.06, y=0.12, z=0.15)


class ForceMarkers:
    """Builds the MarkerArray; messages are made once and refilled."""

    def __init__(self, vehicle: Vehicle, output_names: Sequence[str]) -> None:
        column = {name: i for i, name in enumerate(output_names)}
        self.message = MarkerArray()
        self._tires: list[tuple[str, HubPlace, float, list[int], int | None]] = []
        for hub in hub_places(vehicle):
            steer = column.get(f"{hub.hub}_steer_rad")
            for tire, y_m, _ in hub.tires:
                forces = [column[f"tire_f{axis}_{tire}_n"] for axis in "xyz"]
                self._tires.append((tire, hub, hub.y_m + y_m, forces, steer))
                self.message.markers.append(_arrow(tire, hub.unit, len(self._tires)))

    def fill(
        self, stamp_ns: int, outputs: NDArray[np.float64], blown: Sequence[str]
    ) -> MarkerArray:
        """The message for one instant.

        Args:
            stamp_ns: simulated time.
            outputs: output vector of the model.
            blown: names of blown tires, drawn red.
        """
        seconds, nanoseconds = divmod(stamp_ns, NS)
        for marker, (tire, hub, y_m, forces, steer) in zip(
            self.message.markers, self._tires, strict=True
        ):
            marker.header.stamp = Time(sec=seconds, nanosec=nanoseconds)
            fx_n, fy_n, fz_n = (float(outputs[column]) for column in forces)
            turn = float(outputs[steer]) if steer is not None else 0.0
            foot = Point(x=hub.x_m, y=y_m, z=hub.z_m - hub.tires[0][2])
            along = math.cos(turn) * fx_n - math.sin(turn) * fy_n
            across = math.sin(turn) * fx_n + math.cos(turn) * fy_n
            tip = Point(
                x=foot.x + along * METERS_PER_NEWTON,
                y=foot.y + across * METERS_PER_NEWTON,
                z=foot.z + fz_n * METERS_PER_NEWTON,
            )
            marker.points = [foot, tip]
            marker.color = _BLOWN if tire in blown else _WHOLE
        return self.message


def _arrow(tire: str, unit: str, number: int) -> Marker:
    marker = Marker(ns="tire_forces", id=number, type=Marker.ARROW, action=Marker.ADD, scale=_SIZE)
    marker.header.frame_id = f"{unit}/base_link"
    marker.text = tire
    marker.pose.orientation.w = 1.0
    return marker
