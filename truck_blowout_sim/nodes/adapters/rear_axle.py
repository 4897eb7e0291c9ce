"""Motion of the front unit at Autoware's `base_link`: mid rear axle, on the ground.

Knows nothing of ROS. A tandem's `base_link` lies midway between its axles.

References: rigid-body kinematics, v_p = v + w x r, a_p = a + dw/dt x r + w x (w x r).
Known limits: the angular acceleration is a difference between two periods; the point moves with
the body, so it stands on the road only where the body does not roll or pitch.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.recordings.angles import quaternion
from truck_blowout_sim.vehicle import Vehicle
from truck_blowout_sim.vehicle.places import hub_places

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Motion:
    """Pose in `map`, twist and acceleration in the body's axes, at the rear axle.

    Attributes:
        place_m: x, y, z.
        turn: quaternion x, y, z, w.
        velocity_mps, rate_radps: linear and angular velocity.
        acceleration_mps2: kinematic, gravity taken off.
    """

    place_m: FloatArray
    turn: FloatArray
    velocity_mps: FloatArray
    rate_radps: FloatArray
    acceleration_mps2: FloatArray


class RearAxle:
    """Moves what the instruments at the unit's own `base_link` read.

    Args:
        vehicle: its front unit is taken.
        output_names: names of the model's output vector.
    """

    def __init__(self, vehicle: Vehicle, output_names: Sequence[str]) -> None:
        unit = vehicle.units[0]
        names = list(output_names)

        def columns(*keys: str) -> list[int]:
            return [names.index(f"{unit}_{key}") for key in keys]

        rear = [hub.x_m for hub in hub_places(vehicle) if hub.unit == unit and not hub.steered]
        ground_m = -vehicle.unit_specs[unit].base_link.z_m
        self.offset_m = np.array([sum(rear) / len(rear) if rear else 0.0, 0.0, ground_m])
        self._place = columns("x_m", "y_m", "z_m")
        self._angles = columns("roll_rad", "pitch_rad", "yaw_rad")
        self._velocity = columns("vx_mps", "vy_mps", "vz_mps")
        self._rates = columns("roll_rate_radps", "pitch_rate_radps", "yaw_rate_radps")
        self._force = columns("ax_mps2", "ay_mps2", "az_mps2")
        self._gravity_mps2 = vehicle.road.gravity_mps2
        self._last: tuple[int, FloatArray] | None = None

    def motion(self, stamp_ns: int, outputs: FloatArray) -> Motion:
        """Motion of one instant; instants come in order."""
        roll, pitch, yaw = outputs[self._angles]
        turn = np.asarray(quaternion(roll, pitch, yaw))
        body = _matrix(roll, pitch, yaw)
        rate, at = outputs[self._rates], self.offset_m
        spin = self._angular_acceleration(stamp_ns, rate)
        free = outputs[self._force] - body.T @ np.array([0.0, 0.0, self._gravity_mps2])
        return Motion(
            place_m=outputs[self._place] + body @ at,
            turn=turn,
            velocity_mps=outputs[self._velocity] + np.cross(rate, at),
            rate_radps=rate,
            acceleration_mps2=free + np.cross(spin, at) + np.cross(rate, np.cross(rate, at)),
        )

    def _angular_acceleration(self, stamp_ns: int, rate: FloatArray) -> FloatArray:
        last, self._last = self._last, (stamp_ns, rate.copy())
        if last is None or stamp_ns <= last[0]:
            return np.zeros(3)
        return np.asarray((rate - last[1]) / ((stamp_ns - last[0]) * 1e-9))


def _matrix(roll: float, pitch: float, yaw: float) -> FloatArray:
    (sr, sp, sy), (cr, cp, cy) = np.sin([roll, pitch, yaw]), np.cos([roll, pitch, yaw])
    return np.array([
        [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
        [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
        [-sp, cp * sr, cp * cr],
    ])  # fmt: skip
