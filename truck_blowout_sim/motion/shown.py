"""What a bag of a log needs beside its channels, so that the bag alone shows the truck.

Frames and forces are made from the log's motion; what it lacks follows from the vehicle, and is
said. Only the place of the truck is never made up: without a recorded position there is no
transform from `map`.

Validated with: test/motion/test_shown.py.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from truck_blowout_sim.display.scene import beside
from truck_blowout_sim.motion.motion import Motion, motion_of
from truck_blowout_sim.motion.source import Floats
from truck_blowout_sim.motion.tracks import PLACE
from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.recordings.bag_export import Extra
from truck_blowout_sim.vehicle import Vehicle

_POSE = ("x_m", "y_m", "z_m", "roll_rad", "pitch_rad", "yaw_rad")


@dataclass(frozen=True)
class Shown:
    """What is written beside a recording's channels.

    Attributes:
        messages: robot description, frames, clock and tire forces, in order of time; to be read
            once.
        assumptions: what was not recorded and how it was filled, a sentence each.
    """

    messages: Iterable[Extra]
    assumptions: tuple[str, ...]


def shown(recording: Recording, vehicle: Vehicle, *, rate_hz: float = 50.0) -> Shown:
    """Frames, robot description and the like for a bag of a recording.

    Args:
        recording: measured or simulated, of any completeness.
        vehicle: whose robot model is shown.
        rate_hz: frames a second.

    Raises:
        InputError: nothing was recorded, or a blown tire is none of the vehicle's.
    """
    motion = motion_of(recording, vehicle, rate_hz=rate_hz)
    columns = _columns(motion, vehicle)
    placed = all(f"{vehicle.units[0]}_{axis}_m" in recording for axis in "xy")
    arrows = any(wheel.forces_n for wheel in motion.wheels.values())
    messages = beside(
        vehicle, tuple(columns), motion.times_s, np.stack(list(columns.values()), axis=1),
        recording.blowouts, placed=placed, arrows=arrows,
    )  # fmt: skip
    return Shown(messages, _assumptions(motion, vehicle.units[0], placed=placed))


def _assumptions(motion: Motion, unit: str, *, placed: bool) -> tuple[str, ...]:
    if placed:
        return motion.assumptions
    words = f"{PLACE} {unit}: not recorded, so /tf holds no transform from map to {unit}/base_link"
    return (words, *(one for one in motion.assumptions if not one.startswith(PLACE)))


def _columns(motion: Motion, vehicle: Vehicle) -> dict[str, Floats]:
    """The motion under the names of the model's outputs."""
    units = {unit: motion.units[unit] for unit in vehicle.units}
    columns = {f"{unit}_{key}": getattr(track, key)
               for unit, track in units.items() for key in _POSE}  # fmt: skip
    if len(units) > 1:
        front, rear = units.values()
        columns["articulation_rad"] = rear.yaw_rad - front.yaw_rad
    unknown_n = np.zeros((3, motion.times_s.size))
    for hub, wheel in motion.wheels.items():
        columns[f"{hub}_steer_rad"] = wheel.steer_rad
        columns[f"hub_spin_angle_{hub}_rad"] = wheel.spin_rad
        for tire in wheel.air:
            columns[f"tire_loaded_radius_{tire}_m"] = wheel.height_m
            forces_n = wheel.forces_n.get(tire, unknown_n)
            columns |= {f"tire_f{axis}_{tire}_n": forces_n[at] for at, axis in enumerate("xyz")}
    return columns
