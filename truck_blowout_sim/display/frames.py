"""/tf and /tf_static: every frame of the vehicle, as serialised tf2_msgs/TFMessage.

Each unit's `base_link` stands in `map`; below it hang the frames of the robot model, moved by its
joints, so that a display needs nothing else.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.display.model import Joint, joints_of
from truck_blowout_sim.display.prepared import Prepared
from truck_blowout_sim.recordings.angles import quaternion_of
from truck_blowout_sim.recordings.cdr import blank
from truck_blowout_sim.vehicle import Vehicle
from truck_blowout_sim.vehicle.places import hitch_of

TF_MESSAGE = "tf2_msgs/msg/TFMessage"
_TRANSFORM = "geometry_msgs/msg/TransformStamped"
_POSE = ("translation.x", "translation.y", "translation.z",
         "rotation.x", "rotation.y", "rotation.z", "rotation.w")  # fmt: skip
FloatArray = NDArray[np.float64]


class MovingFrames:
    """/tf of one instant.

    Args:
        vehicle: whose frames.
        output_names: names of the model's output vector.
        joint_columns: position of each moving joint, by name, in the joints' vector.
        joints: include the joints; without them, the units alone.
        placed: the units stand in `map`; without it, the joints alone.
    """

    def __init__(
        self,
        vehicle: Vehicle,
        output_names: Sequence[str],
        joint_columns: dict[str, int],
        *,
        joints: bool = True,
        placed: bool = True,
    ) -> None:
        names = list(output_names)
        placed_units = vehicle.units if placed else ()
        self._places = _columns(names, placed_units, ("x_m", "y_m", "z_m"))
        self._angles = _columns(names, placed_units, ("roll_rad", "pitch_rad", "yaw_rad"))
        moving = [j for j in joints_of(vehicle) if joints and j.kind != "fixed"]
        self._joints = np.array([joint_columns[j.name] for j in moving], dtype=np.intp)
        self._axis = np.array([j.axis for j in moving], dtype=np.float64).reshape(-1, 3)
        self._at = np.array([j.at for j in moving], dtype=np.float64).reshape(-1, 3)
        self._slides = np.array([j.kind == "prismatic" for j in moving], dtype=np.bool_)
        self._values = np.zeros((len(placed_units) + len(moving), 7))
        frames = [_frame("map", f"{unit}/base_link") for unit in placed_units]
        self._message = _prepared([*frames, *(_joint_frame(j) for j in moving)])

    def fill(self, stamp_ns: int, outputs: FloatArray, joints: FloatArray) -> bytes:
        """The message.

        Args:
            stamp_ns: simulated time.
            outputs: output vector of the model.
            joints: positions of the joints.
        """
        units, values = len(self._places), self._values
        values[:units, :3] = outputs[self._places]
        values[:units, 3:] = quaternion_of(outputs[self._angles])
        position = joints[self._joints]
        travel = np.where(self._slides, position, 0.0)
        half = np.where(self._slides, 0.0, 0.5 * position)
        values[units:, :3] = self._at + travel[:, None] * self._axis
        values[units:, 3:6] = np.sin(half)[:, None] * self._axis
        values[units:, 6] = np.cos(half)
        return self._message.fill(stamp_ns, values)


def fixed_frames(vehicle: Vehicle, *, joints: bool = True) -> bytes:
    """/tf_static: fifth wheel and kingpin, and the fixed joints of the robot model."""
    frames = []
    if len(vehicle.units) > 1:
        for unit, name in zip(vehicle.units, ("fifth_wheel", "kingpin"), strict=True):
            frames.append(_frame(f"{unit}/base_link", f"{unit}/{name}", hitch_of(vehicle, unit)))
    fixed = (j for j in joints_of(vehicle) if joints and j.kind == "fixed")
    frames += [_joint_frame(joint) for joint in fixed]
    values = [[*_point(frame), 0.0, 0.0, 0.0, 1.0] for frame in frames]
    return _prepared(frames).fill(0, np.array(values).reshape(-1, 7))


def _columns(names: list[str], units: Sequence[str], keys: Sequence[str]) -> NDArray[np.intp]:
    found = [[names.index(f"{unit}_{key}") for key in keys] for unit in units]
    return np.array(found, dtype=np.intp).reshape(-1, len(keys))


def _prepared(frames: Sequence[object]) -> Prepared:
    message: Any = blank(TF_MESSAGE)
    message.transforms = list(frames)
    fields = [f"transforms[{i}].transform.{key}" for i in range(len(frames)) for key in _POSE]
    return Prepared(TF_MESSAGE, message, fields)


def _joint_frame(joint: Joint) -> object:
    return _frame(joint.parent, joint.child, joint.at)


def _frame(parent: str, child: str, at: Sequence[float] = (0.0, 0.0, 0.0)) -> object:
    frame: Any = blank(_TRANSFORM)
    frame.header.frame_id, frame.child_frame_id = parent, child
    place = frame.transform.translation
    place.x, place.y, place.z = (float(value) for value in at)
    return frame


def _point(frame: Any) -> tuple[float, float, float]:  # noqa: ANN401  # a message of `rosbags`
    place = frame.transform.translation
    return place.x, place.y, place.z
