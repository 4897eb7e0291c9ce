"""From the state of a truck to the columns of a recording, still without instrument errors."""

from __future__ import annotations

import numpy as np
from scipy.signal import butter, filtfilt

from proving_ground.layout import FloatArray
from proving_ground.run import Truth
from proving_ground.sheet import HUBS, TIRES

COMMANDS = ("steering_wheel_angle_rad", "throttle", "brake_pressure_steer_pa",
            "brake_pressure_drive_pa", "brake_pressure_trailer_pa")
POSE = ("x_m", "y_m", "yaw_rad", "roll_rad", "pitch_rad")
MOTION = ("vx_mps", "vy_mps", "yaw_rate_radps", "roll_rate_radps", "pitch_rate_radps",
          "ax_mps2", "ay_mps2", "az_mps2")
UNITS = ("tractor", "trailer")
RATE_HZ = 100.0


def columns() -> list[str]:
    """All channel names in the order of a CSV, without time and event."""
    names = list(COMMANDS)
    names += [f"{unit}_{name}" for unit in UNITS for name in POSE + MOTION]
    names += [f"hub_speed_{hub}_radps" for hub in HUBS]
    names += [f"tire_pressure_{tire}_pa" for tire in TIRES]
    return names + [f"brake_chamber_{hub}_pa" for hub in HUBS]


def smooth(values: FloatArray, cutoff_hz: float) -> FloatArray:
    """Zero-phase low-pass as the instruments apply it."""
    b, a = butter(2, cutoff_hz / (0.5 * RATE_HZ))
    return np.asarray(filtfilt(b, a, values, axis=0, padlen=min(30, len(values) - 2)))


def quaternion_angles(q: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Roll, pitch, yaw (z-y-x, rad) of quaternion rows (w, x, y, z); yaw unwrapped."""
    w, x, y, z = q.T
    roll = np.arctan2(2.0 * (w * x + y * z), 1.0 - 2.0 * (x * x + y * y))
    pitch = np.arcsin(np.clip(2.0 * (w * y - z * x), -1.0, 1.0))
    yaw = np.unwrap(np.arctan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z)))
    return roll, pitch, yaw


def ideal(truth: Truth) -> dict[str, FloatArray]:
    """Every channel as perfect, band-limited instruments would read it."""
    s = truth.samples
    out: dict[str, FloatArray] = dict(zip(COMMANDS, truth.commands.T.copy(), strict=True))
    grade, bank = s[:, 70], s[:, 71]
    for number, unit in enumerate(UNITS):
        out.update(_unit(s[:, 16 * number:16 * number + 16], unit, grade, bank))
    for k, hub in enumerate(HUBS):
        out[f"hub_speed_{hub}_radps"] = smooth(s[:, 32 + k], 10.0)
    for k, tire in enumerate(TIRES):
        out[f"tire_pressure_{tire}_pa"] = s[:, 42 + k].copy()
    for k, hub in enumerate(HUBS):
        out[f"brake_chamber_{hub}_pa"] = s[:, 60 + k].copy()
    return {name: out[name] for name in columns()}


def road_rates(grade: FloatArray, bank: FloatArray, yaw: FloatArray
               ) -> tuple[FloatArray, FloatArray]:
    """How fast the road itself turns along and across a vehicle that enters a slope, rad/s.

    A gyro feels that; it does not feel that a vehicle turns on a slope which stays as it is.
    """
    grading, banking = np.gradient(grade) * RATE_HZ, np.gradient(bank) * RATE_HZ
    return (grading * np.cos(yaw) + banking * np.sin(yaw),
            banking * np.cos(yaw) - grading * np.sin(yaw))


def _unit(s: FloatArray, unit: str, grade: FloatArray, bank: FloatArray) -> dict[str, FloatArray]:
    """Pose and motion of one unit; tilt is against the true horizontal, so slopes add to it."""
    roll, pitch, yaw = quaternion_angles(s[:, 3:7])
    motion = smooth(s[:, 7:16], 20.0)
    along = grade * np.cos(yaw) + bank * np.sin(yaw)
    across = bank * np.cos(yaw) - grade * np.sin(yaw)
    along_rate, across_rate = road_rates(grade, bank, yaw)
    values = {
        "x_m": s[:, 0], "y_m": s[:, 1], "yaw_rad": yaw,
        "roll_rad": roll + across, "pitch_rad": pitch - along,
        "vx_mps": motion[:, 0], "vy_mps": motion[:, 1],
        "yaw_rate_radps": motion[:, 5],
        "roll_rate_radps": motion[:, 3] + across_rate,
        "pitch_rate_radps": motion[:, 4] - along_rate,
        "ax_mps2": motion[:, 6], "ay_mps2": motion[:, 7], "az_mps2": motion[:, 8],
    }
    return {f"{unit}_{name}": np.array(value) for name, value in values.items()}
