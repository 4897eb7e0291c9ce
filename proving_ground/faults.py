"""Instrument faults by name: which channels, how large at severity one."""

from __future__ import annotations

from dataclasses import dataclass

from proving_ground.effects.base import Strength
from proving_ground.instruments import DEG, Fault

MOTION = ("vx_mps", "vy_mps", "yaw_rate_radps", "roll_rate_radps", "pitch_rate_radps", "ax_mps2",
          "ay_mps2", "az_mps2", "x_m", "y_m", "yaw_rad", "roll_rad", "pitch_rad")


@dataclass(frozen=True)
class FaultKind:
    """A family of instrument faults: channel sets it may sit in, size per severity, unit."""

    name: str
    places: tuple[tuple[str, ...], ...]
    size: float
    unit: str
    measure: str
    needs: str
    signed: bool = True

    def make(self, severity: float, place: int, sign: float) -> Fault:
        """The fault at a severity."""
        channels = self.places[place % len(self.places)]
        size = self.size * severity * (sign if self.signed else 1.0)
        if self.name == "lateral_accel_roll":
            size = min(size, 1.0)
        return Fault(self.name, channels, size, (0.8, 0.35 * sign, 0.3))

    def strength(self, fault: Fault) -> Strength:
        """Its size in words."""
        return Strength(self.measure, fault.size, self.unit)


def _one(*channels: str) -> tuple[tuple[str, ...], ...]:
    return tuple((channel,) for channel in channels)


def _instrument(unit: str) -> tuple[str, ...]:
    return tuple(f"{unit}_{name}" for name in MOTION)


KINDS = (
    FaultKind("yaw_rate_bias", _one("tractor_yaw_rate_radps", "trailer_yaw_rate_radps"),
              1.0 * DEG, "rad/s", "offset", "any"),
    FaultKind("yaw_rate_scale", _one("tractor_yaw_rate_radps", "trailer_yaw_rate_radps"),
              0.25, "1", "relative gain error", "steer"),
    FaultKind("lateral_accel_scale", _one("tractor_ay_mps2", "trailer_ay_mps2"),
              0.30, "1", "relative gain error", "steer"),
    FaultKind("lateral_accel_roll", _one("tractor_ay_mps2"), 1.0, "1", "part of gravity leaked",
              "steer", signed=False),
    FaultKind("speed_scale", _one("tractor_vx_mps", "trailer_vx_mps"), 0.05, "1",
              "relative gain error", "any"),
    FaultKind("steering_angle_offset", _one("steering_wheel_angle_rad"), 8.0 * DEG, "rad",
              "offset", "steer"),
    FaultKind("channel_delay", (*_one("tractor_yaw_rate_radps", "tractor_ay_mps2",
              "trailer_yaw_rate_radps"), _instrument("tractor"), _instrument("trailer")),
              0.20, "s", "delay", "steer", signed=False),
    FaultKind("lever_arm", (_instrument("tractor"), _instrument("trailer")), 1.5, "1",
              "multiple of (0.8, +-0.35, 0.3) m", "steer"),
)
IN_TABLES = tuple(kind.name for kind in KINDS)
# Faults without an amount: they are there or not.
WHOLE = (
    FaultKind("channel_sign", _one("tractor_yaw_rate_radps", "tractor_ay_mps2",
              "tractor_roll_rad", "steering_wheel_angle_rad", "trailer_yaw_rate_radps"),
              1.0, "1", "inverted", "steer", signed=False),
    FaultKind("channel_swap", (("tractor_ax_mps2", "tractor_ay_mps2"),
              ("tractor_roll_rate_radps", "tractor_pitch_rate_radps"),
              ("tractor_roll_rad", "tractor_pitch_rad"),
              ("hub_speed_steer_left_radps", "hub_speed_steer_right_radps"),
              ("trailer_ax_mps2", "trailer_ay_mps2")),
              1.0, "1", "exchanged", "steer", signed=False),
    FaultKind("gravity_convention", tuple(
              tuple(f"{unit}_{axis}_mps2" for axis in ("ax", "ay", "az"))
              for unit in ("tractor", "trailer")),
              1.0, "1", "gravity not as stated", "steer", signed=False),
)
FAULTS: dict[str, FaultKind] = {kind.name: kind for kind in (*KINDS, *WHOLE)}
