"""Instruments: mounting errors, noise, rounding, and the faults that a diagnosis must not miss.

One sigma of noise, quanta and mounting errors as stated in the recordings' own header lines.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from proving_ground.channels import RATE_HZ, smooth
from proving_ground.layout import FloatArray

DEG = float(np.pi / 180.0)


@dataclass(frozen=True)
class Noise:
    """White noise of a channel: constant part, part of the reading, quantum (all SI)."""

    sigma: float
    relative: float = 0.0
    quantum: float = 0.0


def noise_of(channel: str) -> Noise:
    """Noise of any channel by its name."""
    if channel.startswith("hub_speed"):
        return Noise(0.0, 0.002, 0.001)
    if channel.startswith("tire_pressure"):
        return Noise(0.0, 0.005, 1.0)
    if channel.startswith("brake_chamber"):
        return Noise(500.0, 0.005, 1.0)
    if channel.startswith("brake_pressure"):
        return Noise(150.0, 0.003, 1.0)
    if channel == "steering_wheel_angle_rad":
        return Noise(0.04 * DEG, 0.0, 0.05 * DEG)
    if channel == "throttle":
        return Noise(0.0)
    unit, name = channel.split("_", 1)
    tractor = unit == "tractor"
    table = {
        "vx_mps": (0.012, 0.025, 0.01), "vy_mps": (0.012, 0.025, 0.01),
        "ax_mps2": (0.03, 0.06, 0.01), "ay_mps2": (0.03, 0.06, 0.01),
        "az_mps2": (0.03, 0.06, 0.01), "x_m": (0.004, 0.006, 0.001), "y_m": (0.004, 0.006, 0.001),
        "yaw_rad": (0.04 * DEG, 0.08 * DEG, 0.01 * DEG),
        "roll_rad": (0.02 * DEG, 0.05 * DEG, 0.01 * DEG),
        "pitch_rad": (0.02 * DEG, 0.05 * DEG, 0.01 * DEG),
    }
    if name in table:
        own, other, quantum = table[name]
        return Noise(own if tractor else other, 0.0, quantum)
    return Noise((0.02 if tractor else 0.05) * DEG, 0.0, 0.01 * DEG)


@dataclass(frozen=True)
class Fault:
    """An instrument fault: a canonical name, the channels it sits in, its size (SI)."""

    name: str
    channels: tuple[str, ...]
    size: float
    offset_m: tuple[float, float, float] = (0.0, 0.0, 0.0)


def apply_fault(values: dict[str, FloatArray], fault: Fault) -> dict[str, FloatArray]:
    """Channels as a faulty instrument reads them, before noise; the input is left as it was."""
    out = dict(values)
    if fault.name == "lever_arm":
        return {**out, **_moved(values, fault)}
    if fault.name == "lateral_accel_roll":
        roll = values["tractor_roll_rad"]
        lateral = values["tractor_ay_mps2"] + fault.size * 9.81 * np.sin(roll)
        return {**out, "tractor_ay_mps2": lateral}
    if fault.name == "channel_swap":
        one, other = fault.channels
        return {**out, one: values[other], other: values[one]}
    if fault.name == "gravity_convention":
        level = without_gravity(values)
        return {**out, **{channel: level[channel] for channel in fault.channels}}
    time = np.arange(len(next(iter(values.values())))) / RATE_HZ
    for channel in fault.channels:
        signal = values[channel]
        if fault.name == "channel_sign":
            out[channel] = -signal
        elif fault.name == "channel_delay":
            out[channel] = np.interp(time - fault.size, time, signal)
        elif fault.name in ("yaw_rate_bias", "steering_angle_offset"):
            out[channel] = signal + fault.size
        elif fault.name in ("yaw_rate_scale", "lateral_accel_scale", "speed_scale"):
            out[channel] = signal * (1.0 + fault.size)
        else:
            raise ValueError(f"no instrument fault is called {fault.name!r}")
    return out


def without_gravity(values: dict[str, FloatArray]) -> dict[str, FloatArray]:
    """Accelerations in a level frame, as an inertial unit delivers them once tilt is known."""
    out = dict(values)
    for unit in ("tractor", "trailer"):
        if f"{unit}_roll_rad" not in values:
            continue  # a car tows nothing
        roll, pitch = values[f"{unit}_roll_rad"], values[f"{unit}_pitch_rad"]
        out[f"{unit}_ay_mps2"] = values[f"{unit}_ay_mps2"] - 9.81 * np.sin(roll) * np.cos(pitch)
        out[f"{unit}_ax_mps2"] = values[f"{unit}_ax_mps2"] + 9.81 * np.sin(pitch)
        out[f"{unit}_az_mps2"] = values[f"{unit}_az_mps2"] - 9.81 * np.cos(roll) * np.cos(pitch)
    return out


def _moved(values: dict[str, FloatArray], fault: Fault) -> dict[str, FloatArray]:
    """Position, velocity and acceleration of an instrument that sits elsewhere by an offset."""
    unit = fault.channels[0].split("_", 1)[0]
    arm = fault.size * np.asarray(fault.offset_m)
    names = ("roll_rate_radps", "pitch_rate_radps", "yaw_rate_radps")
    rates = np.stack([values[f"{unit}_{name}"] for name in names], axis=1)
    turn = smooth(np.gradient(rates, axis=0) * RATE_HZ, 15.0)
    velocity = np.cross(rates, arm)
    acceleration = np.cross(turn, arm) + np.cross(rates, velocity)
    yaw = values[f"{unit}_yaw_rad"]
    shift = {
        "vx_mps": velocity[:, 0], "vy_mps": velocity[:, 1], "ax_mps2": acceleration[:, 0],
        "ay_mps2": acceleration[:, 1], "az_mps2": acceleration[:, 2],
        "x_m": arm[0] * np.cos(yaw) - arm[1] * np.sin(yaw),
        "y_m": arm[0] * np.sin(yaw) + arm[1] * np.cos(yaw),
    }
    return {f"{unit}_{name}": values[f"{unit}_{name}"] + part for name, part in shift.items()}


@dataclass(frozen=True)
class Mounting:
    """Constant errors of one truck's instruments, drawn once per case."""

    constant: dict[str, float]
    gain: dict[str, float]

    @classmethod
    def draw(cls, seed: int, channels: list[str]) -> Mounting:
        """Gyro 0.006 deg/s, accelerometer 0.006 m/s2, tilt 0.05 deg; twice that on the trailer."""
        rng = np.random.default_rng([seed, 53])
        constant, gain = {}, {}
        for channel in channels:
            more = 2.0 if channel.startswith("trailer_") else 1.0
            if channel.endswith("_rate_radps"):
                constant[channel] = more * 0.006 * DEG * float(rng.standard_normal())
            elif channel.endswith("_mps2"):
                constant[channel] = more * 0.006 * float(rng.standard_normal())
            elif channel.endswith(("roll_rad", "pitch_rad", "yaw_rad")):
                constant[channel] = more * 0.05 * DEG * float(rng.standard_normal())
            elif channel.startswith("tire_pressure"):
                gain[channel] = 1.0 + 0.002 * float(rng.standard_normal())
        return cls(constant, gain)


def measure(values: dict[str, FloatArray], mounting: Mounting, seed: int) -> dict[str, FloatArray]:
    """Readings: mounting errors, white noise, slow drift of positions, rounding."""
    rng = np.random.default_rng([seed, 59])
    out = {}
    for channel, signal in values.items():
        noise = noise_of(channel)
        reading = signal * mounting.gain.get(channel, 1.0) + mounting.constant.get(channel, 0.0)
        sigma = np.hypot(noise.sigma, noise.relative * np.abs(signal))
        if channel.endswith(("_x_m", "_y_m")):
            size = 0.015 if channel.startswith("tractor") else 0.02
            reading = reading + _drift(len(signal), size, rng)
        reading = reading + sigma * rng.standard_normal(len(signal))
        if noise.quantum > 0.0:
            reading = noise.quantum * np.round(reading / noise.quantum)
        if channel.endswith("_pa"):
            reading = np.maximum(reading, 0.0)
        out[channel] = reading
    return out


def _drift(count: int, size: float, rng: np.random.Generator) -> FloatArray:
    """A wander of a given one-sigma size that forgets itself over 8 s."""
    keep = float(np.exp(-1.0 / (8.0 * RATE_HZ)))
    push = size * np.sqrt(1.0 - keep * keep) * rng.standard_normal(count)
    value = size * float(rng.standard_normal())
    out = np.empty(count)
    for k in range(count):
        value = keep * value + push[k]
        out[k] = value
    return out
