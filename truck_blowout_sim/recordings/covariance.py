"""How messages say what was not measured: their covariances.

A variance of ``NOT_MEASURED`` stands for a number that carries no information; in an Imu the first
element of a covariance is -1 where that whole quantity is missing, as sensor_msgs defines. A
variance of 0 says that the noise is not stated. Other stacks state other large variances, mostly
1e3 to 1e6: one that is never below what no instrument has says the same.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.recordings.cdr import Block
from truck_blowout_sim.recordings.channel import IMU, ODOMETRY

NOT_MEASURED = 1.0e9
# Standard deviations that no instrument on a truck has: a quarter turn, more than a truck drives,
# spins or brakes (10 g), and farther than it goes in a test.
_LEAST_VARIANCE = {
    "orientation": (0.5 * np.pi) ** 2, "twist.twist.linear": 30.0**2, "angular": np.pi**2,
    "linear_acceleration": 100.0**2, "position": 1000.0**2,
}  # fmt: skip
_AXES = ("x", "y", "z")
_ANGLES = ("roll", "pitch", "yaw")
_ODOMETRY_FIELDS = (
    *(f"pose.pose.position.{axis}" for axis in _AXES),
    *(f"pose.pose.orientation:{angle}" for angle in _ANGLES),
    *(f"twist.twist.linear.{axis}" for axis in _AXES),
    *(f"twist.twist.angular.{axis}" for axis in _AXES),
)
_IMU_FIELDS = {
    "orientation": tuple(f"orientation:{angle}" for angle in _ANGLES),
    "angular_velocity": tuple(f"angular_velocity.{axis}" for axis in _AXES),
    "linear_acceleration": tuple(f"linear_acceleration.{axis}" for axis in _AXES),
}


def covariance_entries(ros_type: str, variance: Callable[[str], float | None]) -> dict[str, float]:
    """Diagonal elements to write, by field path.

    Args:
        ros_type: message type; others than Odometry and Imu have none.
        variance: of a field, None if it was not measured.
    """
    out: dict[str, float] = {}
    if ros_type == ODOMETRY:
        for path in _ODOMETRY_FIELDS:
            value = variance(path)
            out[_odometry_entry(path)] = NOT_MEASURED if value is None else value
    elif ros_type == IMU:
        for block, paths in _IMU_FIELDS.items():
            values = [variance(path) for path in paths]
            for i, value in enumerate(values):
                out[f"{block}_covariance[{4 * i}]"] = NOT_MEASURED if value is None else value
            if all(value is None for value in values):
                out[f"{block}_covariance[0]"] = -1.0
    return out


def measured(block: Block, ros_type: str, path: str) -> NDArray[np.bool_]:
    """In which of these messages a field was measured."""
    if ros_type == ODOMETRY and path in _ODOMETRY_FIELDS:
        return _told(block.number(_odometry_entry(path)), path)
    if ros_type == IMU and any(path in fields for fields in _IMU_FIELDS.values()):
        name = path.replace(":", ".").split(".")[0]
        row = _IMU_FIELDS[name].index(path)
        there = block.number(f"{name}_covariance[0]") != -1.0
        return there & _told(block.number(f"{name}_covariance[{4 * row}]"), path)
    return np.ones(len(block.index), dtype=np.bool_)


def _told(variance: NDArray[np.float64], path: str) -> NDArray[np.bool_]:
    """Where a variance is one of a measurement.

    That of dead reckoning grows beyond all limits, though what it says of one second to the next
    stays good: a limit counts only where the variance is beyond it from the first message on.
    """
    least = next(limit for part, limit in _LEAST_VARIANCE.items() if part in path)
    known = variance < NOT_MEASURED
    return np.asarray(known & np.any(variance < least))


def _odometry_entry(path: str) -> str:
    row = _ODOMETRY_FIELDS.index(path) % 6
    return f"{path.partition('.')[0]}.covariance[{7 * row}]"
