"""Joints that only a display needs, and the positions of all joints.

A robot model shows a dropped corner and a rolling trailer with `<hub>_travel`, `trailer_pitch` and
`trailer_roll`; the rates of steer and articulation complete the joint states.

Known limits: the road under one unit is taken as a plane along its axles, so travel shows how
corners differ, not the heave of the whole unit.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.recordings.channels import JOINT_STATE, Channel, Place
from truck_blowout_sim.vehicle import Vehicle
from truck_blowout_sim.vehicle.places import HubPlace, hub_places

FloatArray = NDArray[np.float64]


class DisplayJoints:
    """Computes the joints from the model's output vector.

    Args:
        vehicle: whose joints.
        output_names: names of the model's output vector.
    """

    def __init__(self, vehicle: Vehicle, output_names: Sequence[str]) -> None:
        hubs = hub_places(vehicle)
        column = {name: i for i, name in enumerate(output_names)}
        self._units = [_UnitTravel(unit, hubs, column) for unit in vehicle.units]
        self._angles = [
            [column[f"{unit}_{angle}_rad"] for angle in ("roll", "pitch", "yaw")]
            for unit in vehicle.units
        ]
        self._moving = [column[f"{hub.hub}_steer_rad"] for hub in hubs if hub.steered]
        if len(vehicle.units) > 1:
            self._moving.append(column["articulation_rad"])
        self._last: FloatArray = np.full(len(self._moving), math.nan)
        self.channels = self._rows(vehicle, hubs)

    def values(self, outputs: FloatArray, elapsed_s: float) -> FloatArray:
        """One value for each of `channels`.

        Args:
            outputs: output vector of the model.
            elapsed_s: simulated time since the last call; 0: rates are zero.
        """
        now = outputs[self._moving]
        known = elapsed_s > 0 and not np.isnan(self._last).any()
        rates = (now - self._last) / elapsed_s if known else np.zeros(now.size)
        self._last = now
        parts = [unit.values(outputs) for unit in self._units]
        if len(self._angles) > 1:
            front, rear = (outputs[columns] for columns in self._angles)
            parts.append(np.array(relative_pitch_roll(front.tolist(), rear.tolist())))
        return np.concatenate((*parts, rates))

    def _rows(self, vehicle: Vehicle, hubs: Sequence[HubPlace]) -> tuple[Channel, ...]:
        rows = [_row(f"{hub}_travel", "m", "position") for u in self._units for hub in u.hubs]
        steer = [f"{hub.hub}_steer" for hub in hubs if hub.steered]
        if len(vehicle.units) > 1:
            rows += [_row(f"trailer_{a}", "rad", "position") for a in ("pitch", "roll")]
            steer.append("articulation")
        rows += [_row(joint, "rad/s", "velocity") for joint in steer]
        return tuple(rows)


class _UnitTravel:
    """Heights of the wheel centers of one unit against its body."""

    def __init__(self, unit: str, hubs: Sequence[HubPlace], column: dict[str, int]) -> None:
        mine = [hub for hub in hubs if hub.unit == unit]
        self.hubs = [hub.hub for hub in mine]
        self._at = np.array([(hub.x_m, hub.y_m, hub.z_m) for hub in mine])
        self._radius = [column[f"tire_loaded_radius_{hub.tires[0][0]}_m"] for hub in mine]
        self._roll, self._pitch = column[f"{unit}_roll_rad"], column[f"{unit}_pitch_rad"]
        self._free_m = np.array([max(r for _, _, r in hub.tires) for hub in mine])

    def values(self, outputs: FloatArray) -> FloatArray:
        """Travel of each wheel center along the body's z, upward positive, m."""
        roll, pitch = float(outputs[self._roll]), float(outputs[self._pitch])
        up = np.array(
            [-math.sin(pitch), math.cos(pitch) * math.sin(roll), math.cos(pitch) * math.cos(roll)]
        )
        # what the body's attitude does to the mount, against what the road does to the wheel
        mount_m = self._at @ up - self._at[:, 2]
        wheel_m = outputs[self._radius] - self._free_m
        travel_m = wheel_m - mount_m
        return travel_m - _median(travel_m.tolist())


def _median(values: list[float]) -> float:
    # numpy's median costs thirty times as much for so few
    ordered, half = sorted(values), len(values) // 2
    return (ordered[half] + ordered[-half - 1]) / 2


def relative_pitch_roll(front: Sequence[float], rear: Sequence[float]) -> tuple[float, float]:
    """Pitch and roll that follow the articulation angle from the front unit to the rear one.

    Args:
        front, rear: roll, pitch, yaw of each unit (intrinsic z-y-x), rad.

    Returns:
        Pitch and roll, rad, of Rz(-articulation) R_front^T R_rear.
    """
    difference = _turn_z(_matrix(*front).T @ _matrix(*rear), front[2] - rear[2])
    pitch = math.asin(max(-1.0, min(1.0, -difference[2, 0])))
    return pitch, math.atan2(difference[2, 1], difference[2, 2])


def _turn_z(matrix: FloatArray, angle: float) -> FloatArray:
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]) @ matrix


def _matrix(roll: float, pitch: float, yaw: float) -> FloatArray:
    cr, sr = math.cos(roll), math.sin(roll)
    cp, sp = math.cos(pitch), math.sin(pitch)
    tilt = np.array([[cp, sp * sr, sp * cr], [0.0, cr, -sr], [-sp, cp * sr, cp * cr]])
    return _turn_z(tilt, yaw)


def _row(joint: str, unit: str, kind: str) -> Channel:
    suffix = {"m": "m", "rad": "rad", "rad/s": "rate_radps"}[unit]
    place = Place("joint_states", JOINT_STATE, f"{kind}[{joint}]")
    return Channel(
        f"display_{joint}_{suffix}", unit, f"{joint}, for display", "joint", "simulator",
        -math.inf, math.inf, place, standard=False,
    )  # fmt: skip
