"""A driver's law for keeping a straight lane: preview, yaw damping, slow integral, speed.

Knows nothing of ROS or of the model.

References: optimal preview steering reduced to one preview point (MacAdam 1981); the curvature of
the arc from here to the preview point is 2 e / d^2.
Known limits: straight lanes along a fixed heading; no braking.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

_LOWEST_SPEED_MPS = 2.0


@dataclass(frozen=True)
class Lane:
    """A straight line through (x_m, y_m) along heading_rad, in `map`."""

    x_m: float
    y_m: float
    heading_rad: float

    def errors(self, x_m: float, y_m: float, yaw_rad: float) -> tuple[float, float]:
        """Offset to the left (m) and heading error (rad, in -pi..pi) of a pose."""
        c, s = math.cos(self.heading_rad), math.sin(self.heading_rad)
        offset_m = c * (y_m - self.y_m) - s * (x_m - self.x_m)
        heading = math.remainder(yaw_rad - self.heading_rad, 2 * math.pi)
        return offset_m, heading


@dataclass
class LaneKeeper:
    """Hand-wheel angle from pose and motion.

    Attributes:
        lane: what to follow.
        ratio: hand-wheel angle per road-wheel angle.
        wheelbase_m: of the front unit.
        understeer_s2pm: road-wheel angle per lateral acceleration.
        preview_s: how far ahead the driver looks.
        damping_s: road-wheel angle per yaw rate in excess of the wanted one.
        integral_radpms: road-wheel angle per offset and second.
        limit_rad, rate_limit_radps: of the hand wheel.
    """

    lane: Lane
    ratio: float = 22.0
    wheelbase_m: float = 5.8
    understeer_s2pm: float = 0.002
    preview_s: float = 1.2
    damping_s: float = 0.15
    integral_radpms: float = 0.004
    limit_rad: float = 12.0
    rate_limit_radps: float = 12.0
    integral_rad: float = 0.0
    wheel_rad: float = 0.0

    def update(
        self, pose: tuple[float, float, float], vx_mps: float, vy_mps: float,
        yaw_rate_radps: float, elapsed_s: float,
    ) -> float:  # fmt: skip
        """Hand-wheel angle for now, rad.

        Args:
            pose: x, y (m) and yaw (rad) in `map`.
            vx_mps, vy_mps: forward and to the left.
            yaw_rate_radps: yaw rate.
            elapsed_s: time since the last call.
        """
        speed = max(vx_mps, _LOWEST_SPEED_MPS)
        offset_m, heading = self.lane.errors(*pose)
        ahead_m = speed * self.preview_s
        drift = math.sin(heading) * speed + math.cos(heading) * vy_mps
        error_m = -(offset_m + drift * self.preview_s)
        curvature = 2 * error_m / ahead_m**2
        excess = yaw_rate_radps - curvature * speed
        self.integral_rad += -self.integral_radpms * offset_m * elapsed_s
        steer = (
            curvature * (self.wheelbase_m + self.understeer_s2pm * speed**2)
            - self.damping_s * excess
            + self.integral_rad
        )
        return self._limited(steer * self.ratio, elapsed_s)

    def _limited(self, wanted_rad: float, elapsed_s: float) -> float:
        step = self.rate_limit_radps * elapsed_s
        wanted = max(-self.limit_rad, min(self.limit_rad, wanted_rad))
        self.wheel_rad += max(-step, min(step, wanted - self.wheel_rad))
        return self.wheel_rad


@dataclass
class CruiseControl:
    """Throttle from speed: proportional and integral, clamped to 0..1."""

    speed_mps: float
    gain_spm: float = 0.25
    integral_pm: float = 0.05
    integral: float = 0.3

    def update(self, vx_mps: float, elapsed_s: float) -> float:
        """Throttle for now."""
        error = self.speed_mps - vx_mps
        throttle = self.gain_spm * error + self.integral
        if 0.0 < throttle < 1.0:
            self.integral += self.integral_pm * error * elapsed_s
        return max(0.0, min(1.0, throttle))
