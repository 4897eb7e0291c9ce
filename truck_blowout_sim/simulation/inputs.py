"""What drives the truck."""

from __future__ import annotations

from typing import NamedTuple


class Inputs(NamedTuple):
    """Driver inputs, held between step edges."""

    steering_wheel_angle_rad: float = 0.0  # at the hand wheel, left positive
    throttle: float = 0.0  # 0..1
    brake_pressure_steer_pa: float = 0.0  # gauge, control pressure of the circuit
    brake_pressure_drive_pa: float = 0.0
    brake_pressure_trailer_pa: float = 0.0


STANDSTILL = Inputs()
