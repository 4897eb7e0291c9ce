"""Arrows for tire forces: one for each tire, where it meets the road; red when it is blown."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.display.prepared import Prepared
from truck_blowout_sim.recordings.cdr import blank
from truck_blowout_sim.vehicle import Vehicle
from truck_blowout_sim.vehicle.places import hub_places

MARKERS = "visualization_msgs/msg/MarkerArray"
METERS_PER_NEWTON = 1.0 / 20000.0
"""Length of an arrow: 1 m for 20 kN."""

_MARKER, _POINT = "visualization_msgs/msg/Marker", "geometry_msgs/msg/Point"
_ARROW, _ADD = 0, 0
_WHOLE, _BLOWN = (0.1, 0.7, 0.2, 0.9), (0.9, 0.1, 0.1, 0.9)
_SIZE_M = (0.06, 0.12, 0.15)
FloatArray = NDArray[np.float64]


class ForceArrows:
    """Fills a visualization_msgs/MarkerArray.

    Args:
        vehicle: whose tires.
        output_names: names of the model's output vector.
    """

    def __init__(self, vehicle: Vehicle, output_names: Sequence[str]) -> None:
        column = {name: i for i, name in enumerate(output_names)}
        tires = [(hub, tire, y_m) for hub in hub_places(vehicle) for tire, y_m, _ in hub.tires]
        self._tires = [tire for _, tire, _ in tires]
        forces = [[column[f"tire_f{axis}_{tire}_n"] for axis in "xyz"] for tire in self._tires]
        self._forces = np.array(forces, dtype=np.intp)
        self._feet = np.array(
            [(hub.x_m, hub.y_m + y_m, hub.z_m - hub.tires[0][2]) for hub, _, y_m in tires]
        )
        steer = [column.get(f"{hub.hub}_steer_rad", -1) for hub, _, _ in tires]
        self._steered = np.array(steer, dtype=np.intp)
        self._blown: frozenset[str] = frozenset()
        message: Any = blank(MARKERS)
        message.markers = [
            _arrow(tire, hub.unit, number)
            for number, (hub, tire, _) in enumerate(tires, start=1)
        ]  # fmt: skip
        fields = [
            f"markers[{i}].points[{end}].{axis}"
            for i in range(len(tires)) for end in (0, 1) for axis in "xyz"
        ]  # fmt: skip
        self._message = Prepared(MARKERS, message, fields)

    def fill(self, stamp_ns: int, outputs: FloatArray, blown: Collection[str]) -> bytes:
        """The message for one instant.

        Args:
            stamp_ns: simulated time.
            outputs: output vector of the model.
            blown: names of blown tires, drawn red.
        """
        if self._blown != frozenset(blown):
            self._blown = frozenset(blown)
            self._paint()
        turn = np.where(self._steered >= 0, outputs[self._steered], 0.0)
        fx_n, fy_n, fz_n = outputs[self._forces].T
        along = np.cos(turn) * fx_n - np.sin(turn) * fy_n
        across = np.sin(turn) * fx_n + np.cos(turn) * fy_n
        tips = self._feet + METERS_PER_NEWTON * np.stack((along, across, fz_n), axis=1)
        return self._message.fill(stamp_ns, np.stack((self._feet, tips), axis=1))

    def _paint(self) -> None:
        for number, tire in enumerate(self._tires):
            color = _BLOWN if tire in self._blown else _WHOLE
            for letter, value in zip("rgba", color, strict=True):
                self._message.put(f"markers[{number}].color.{letter}", value)


def _arrow(tire: str, unit: str, number: int) -> object:
    marker: Any = blank(_MARKER)
    marker.header.frame_id = f"{unit}/base_link"
    marker.ns, marker.id, marker.text = "tire_forces", number, tire
    marker.type, marker.action = _ARROW, _ADD
    marker.scale.x, marker.scale.y, marker.scale.z = _SIZE_M
    marker.color.r, marker.color.g, marker.color.b, marker.color.a = _WHOLE
    marker.points = [blank(_POINT), blank(_POINT)]
    return marker
