"""What a bag or a live display needs beside the measurements, as serialised messages.

`robot_description` and `/tf_static` once, `/tf` and `tire_forces` at every instant.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.display.arrows import MARKERS, ForceArrows
from truck_blowout_sim.display.frames import TF_MESSAGE, MovingFrames, fixed_frames
from truck_blowout_sim.display.joints import DisplayJoints
from truck_blowout_sim.display.urdf import urdf_of
from truck_blowout_sim.recordings.bag_export import Extra
from truck_blowout_sim.recordings.cdr import template
from truck_blowout_sim.recordings.channels import STRING, channels_for
from truck_blowout_sim.recordings.recording import Blowout
from truck_blowout_sim.vehicle import Vehicle

TF, TF_STATIC = "/tf", "/tf_static"
ROBOT_DESCRIPTION, TIRE_FORCES = "robot_description", "tire_forces"
TYPES: Mapping[str, str] = {
    TF: TF_MESSAGE, TF_STATIC: TF_MESSAGE, ROBOT_DESCRIPTION: STRING, TIRE_FORCES: MARKERS,
}  # fmt: skip
LATCHED = (ROBOT_DESCRIPTION, TF_STATIC)
"""Topics said once, which late joiners must hear, too."""

CLOCK, CLOCK_TYPE = "/clock", "rosgraph_msgs/msg/Clock"
_ARROWS_EVERY_S = 0.1

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Said:
    """One serialised message: topic, type and bytes."""

    topic: str
    ros_type: str
    data: bytes


class Scene:
    """Makes the messages of one vehicle.

    Args:
        vehicle: a loaded vehicle.
        output_names: names of the model's output vector.
        joints: /tf carries the joints of the robot model, too, not the units alone.
        display: shared with the joint states that are published; its own if not given.
        placed: /tf places the units in `map`.
    """

    def __init__(
        self,
        vehicle: Vehicle,
        output_names: Sequence[str],
        *,
        joints: bool = True,
        display: DisplayJoints | None = None,
        placed: bool = True,
    ) -> None:
        self._display = display or DisplayJoints(vehicle, output_names)
        names = [*output_names, *(row.name for row in self._display.channels)]
        positions = _joint_columns(vehicle, self._display, names)
        self._columns = np.array(list(positions.values()), dtype=np.intp)
        order = {joint: at for at, joint in enumerate(positions)}
        self._frames = MovingFrames(vehicle, output_names, order, joints=joints, placed=placed)
        self._arrows = ForceArrows(vehicle, output_names)
        self.latched = (
            Said(ROBOT_DESCRIPTION, STRING, template(STRING, data=urdf_of(vehicle))),
            Said(TF_STATIC, TF_MESSAGE, fixed_frames(vehicle, joints=joints)),
        )

    def frames(
        self, stamp_ns: int, outputs: FloatArray, display: FloatArray | None = None
    ) -> bytes:
        """/tf of one instant.

        Args:
            stamp_ns: simulated time.
            outputs: output vector of the model.
            display: values of the display joints, where they are known already.
        """
        shown = self._display.values(outputs, 0.0) if display is None else display
        return self._frames.fill(stamp_ns, outputs, np.concatenate((outputs, shown))[self._columns])

    def arrows(self, stamp_ns: int, outputs: FloatArray, blown: Collection[str]) -> bytes:
        """`tire_forces` of one instant; tires named in `blown` are red."""
        return self._arrows.fill(stamp_ns, outputs, blown)


def beside(
    vehicle: Vehicle,
    output_names: Sequence[str],
    times_s: FloatArray,
    outputs: FloatArray,
    blowouts: Sequence[Blowout],
    *,
    placed: bool = True,
    arrows: bool = True,
) -> Iterator[Extra]:
    """What a bag of a run needs to show the truck by itself, in order of time.

    Args:
        vehicle: whose run.
        output_names: names of the model's outputs.
        times_s: instants, shape (n,); stamps count from 0 or from the first, if that is earlier.
        outputs: shape (n, outputs).
        blowouts: events of the run.
        placed: where the truck was is known; without it, /tf holds no transform from `map`.
        arrows: the tire forces are known.
    """
    scene = Scene(vehicle, output_names, placed=placed)
    origin_s = min(0.0, float(times_s[0])) if len(times_s) else 0.0
    arrows_s = -np.inf
    for number, (time_s, row) in enumerate(zip(times_s.tolist(), outputs, strict=True)):
        if number == 0:
            yield from (Extra(time_s, s.topic, s.ros_type, s.data) for s in scene.latched)
        stamp_ns = round((time_s - origin_s) * 1e9)
        clock = template(CLOCK_TYPE, clock__sec=stamp_ns // 10**9, clock__nanosec=stamp_ns % 10**9)
        yield Extra(time_s, CLOCK, CLOCK_TYPE, clock)
        yield Extra(time_s, TF, TF_MESSAGE, scene.frames(stamp_ns, row))
        if arrows and time_s >= arrows_s - 1e-9:
            arrows_s = time_s + _ARROWS_EVERY_S
            blown = {tire for b in blowouts if b.time_s <= time_s for tire in b.tires}
            yield Extra(time_s, TIRE_FORCES, MARKERS, scene.arrows(stamp_ns, row, blown))


def _joint_columns(
    vehicle: Vehicle, display: DisplayJoints, names: Sequence[str]
) -> dict[str, int]:
    """Where each joint's position stands among outputs and display joints together."""
    steered = [h for h in vehicle.hubs if vehicle.spec.axles[vehicle.axle_of_hub(h)].steered]
    rows = (*channels_for(vehicle.hubs, vehicle.tires, vehicle.units, steered), *display.channels)
    column = {name: at for at, name in enumerate(names)}
    return {
        place.field[len("position[") : -1]: column[row.name]
        for row in rows for place in row.places
        if place.field.startswith("position[") and row.name in column
    }  # fmt: skip
