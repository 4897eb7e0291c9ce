"""From the states of the car to the columns of a recording: y left, z up, pitch nose down."""

from __future__ import annotations

import numpy as np

from proving_ground.car.rig import CarTruth
from proving_ground.channels import road_rates, smooth
from proving_ground.layout import FloatArray

WHEELS = ("front_left", "front_right", "rear_left", "rear_right")
COMMANDS = ("steering_wheel_angle_rad", "throttle", "brake_pressure_steer_pa",
            "brake_pressure_drive_pa", "brake_pressure_trailer_pa")


def columns() -> list[str]:
    """All channel names in the order of a CSV, without time."""
    motion = ("x_m", "y_m", "yaw_rad", "roll_rad", "pitch_rad", "vx_mps", "vy_mps",
              "yaw_rate_radps", "roll_rate_radps", "pitch_rate_radps", "ax_mps2", "ay_mps2",
              "az_mps2")
    return [*COMMANDS, *(f"tractor_{name}" for name in motion),
            *(f"hub_speed_{wheel}_radps" for wheel in WHEELS)]


def ideal(truth: CarTruth) -> dict[str, FloatArray]:
    """Every channel as perfect, band-limited instruments at the center of gravity would read it."""
    s, f = truth.states, truth.rates
    grade, bank = truth.slopes[:, 0], truth.slopes[:, 1]
    yaw = -np.unwrap(s[:, 4])
    along = grade * np.cos(yaw) + bank * np.sin(yaw)
    across = bank * np.cos(yaw) - grade * np.sin(yaw)
    roll, pitch = s[:, 6] + across, -s[:, 8] - along
    vx, vy, rate = s[:, 3], -s[:, 10], -s[:, 5]
    # Specific force: motion less gravity, along the rolling and pitching axes.
    ax = f[:, 3] - rate * vy - 9.81 * np.sin(pitch)
    ay = -f[:, 10] + rate * vx + 9.81 * np.sin(roll)
    az = -f[:, 12] + 9.81 * np.cos(roll) * np.cos(pitch)
    along_rate, across_rate = road_rates(grade, bank, yaw)
    turning = gyros(roll, pitch, s[:, 7] - along * rate + across_rate,
                    -s[:, 9] - across * rate - along_rate, rate)
    motion = smooth(np.stack([vx, vy, *turning, ax, ay, az], axis=1), 20.0)
    parts = [s[:, 0], -s[:, 1], yaw, roll, pitch, *motion.T]
    hubs = [smooth(s[:, 23 + k], 10.0) for k in range(4)]
    values = [*truth.commands.T, *parts, *hubs]
    return {name: np.array(value) for name, value in zip(columns(), values, strict=True)}


def gyros(roll: FloatArray, pitch: FloatArray, roll_change: FloatArray, pitch_change: FloatArray,
          yaw_change: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Yaw, roll and pitch rate as gyros fixed to the body read them.

    The model states how angles change. A rolled body in a steady turn also turns about its own
    pitching axis.
    """
    level = yaw_change * np.cos(pitch)
    return (level * np.cos(roll) - pitch_change * np.sin(roll),
            roll_change - yaw_change * np.sin(pitch),
            pitch_change * np.cos(roll) + level * np.sin(roll))
