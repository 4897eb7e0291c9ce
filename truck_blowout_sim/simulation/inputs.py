"""What drives the truck."""

from __future__ import annotations

from typing import NamedTuple

from truck_blowout_sim.errors import InputError

PEDAL_SLACK = 0.05  # beyond its ends a throttle sensor reads so far, as in the table of channels


class Inputs(NamedTuple):
    """Driver inputs, held between step edges."""

    steering_wheel_angle_rad: float = 0.0  # at the hand wheel, left positive
    throttle: float = 0.0  # 0..1
    brake_pressure_steer_pa: float = 0.0  # gauge, control pressure of the circuit
    brake_pressure_drive_pa: float = 0.0
    brake_pressure_trailer_pa: float = 0.0


STANDSTILL = Inputs()


def opening(throttle: float, file: str = "") -> float:
    """A throttle cut to 0 to 1, in which a sensor reads a little beyond; NaN stays.

    Raises:
        InputError: farther beyond than a sensor reads.
    """
    if throttle < -PEDAL_SLACK or throttle > 1.0 + PEDAL_SLACK:
        raise InputError(f"throttle is {throttle:g}", file=file or None,
                         expected="0 to 1; a larger one is likely in per cent")
    return 0.0 if throttle < 0.0 else 1.0 if throttle > 1.0 else throttle
