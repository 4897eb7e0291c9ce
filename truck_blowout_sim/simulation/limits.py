"""Which inputs and starts a truck takes: those that the table of channels takes for a recording."""

from __future__ import annotations

import math
import operator
from dataclasses import replace

from truck_blowout_sim.errors import InputError, quoted
from truck_blowout_sim.recordings.channels import by_name, channels_for
from truck_blowout_sim.simulation.equilibrium import InitialState
from truck_blowout_sim.simulation.inputs import Inputs, opening
from truck_blowout_sim.simulation.plausible import MOST_SPEED_MPS
from truck_blowout_sim.vehicle import Packed

_ROWS = by_name(channels_for())
_MOST_WHEEL_RAD = _ROWS["steering_wheel_angle_rad"].highest
_LEAST_PA, _MOST_PA = (getattr(_ROWS["brake_pressure_steer_pa"], end)
                       for end in ("lowest", "highest"))
# A start's field, and the channel that has its bounds.
_START = {
    "speed_mps": "tractor_vx_mps", "lateral_speed_mps": "tractor_vy_mps",
    "yaw_rate_radps": "tractor_yaw_rate_radps", "x_m": "tractor_x_m", "y_m": "tractor_y_m",
    "yaw_rad": "tractor_yaw_rad",
}


def check_inputs(inputs: Inputs) -> None:
    """Refuse inputs that are none, but for a throttle beyond its ends, which `opening` sees to.

    Raises:
        InputError: says which one, and what is possible.
    """
    if not isinstance(inputs, Inputs):
        raise InputError(f"inputs are {quoted(inputs)}",
                         expected=f"Inputs({', '.join(Inputs._fields)})")
    wheel, throttle, steer, drive, trailer = inputs
    try:
        # one chain of comparisons, in which NaN fails as well: this runs at every step of a caller
        if (-_MOST_WHEEL_RAD <= wheel <= _MOST_WHEEL_RAD and throttle <= math.inf
                and _LEAST_PA <= steer <= _MOST_PA and _LEAST_PA <= drive <= _MOST_PA
                and _LEAST_PA <= trailer <= _MOST_PA):
            return
    except (TypeError, ValueError):
        pass  # no number: told below
    for name, value in zip(Inputs._fields, inputs, strict=True):
        _check(name, value, _ROWS[name].lowest, _ROWS[name].highest)


def checked_start(initial: InitialState, packed: Packed) -> InitialState:
    """A start that a truck can make, its throttle cut to 0 to 1.

    Raises:
        InputError: says which field cannot be, and what is possible.
    """
    for name, channel in _START.items():
        _check(name, getattr(initial, name), _ROWS[channel].lowest, _ROWS[channel].highest)
    most_mps = MOST_SPEED_MPS[packed.vehicle.spec.brakes]
    _check("speed_mps", initial.speed_mps, -most_mps, most_mps)
    # beyond half a turn it is another angle of the same trailer
    _check("articulation_rad", initial.articulation_rad, -math.pi, math.pi)
    if not math.isfinite(initial.time_s):
        raise InputError(f"time_s is {initial.time_s!r}", expected="a finite time")
    check_inputs(initial.inputs)
    inputs = initial.inputs._replace(throttle=opening(initial.inputs.throttle))
    return replace(initial, inputs=inputs)


def check_steps(n_steps: int) -> None:
    """Refuse a number of steps that is none.

    Raises:
        InputError: not a whole number, or below 0.
    """
    try:
        whole = operator.index(n_steps)
    except TypeError:
        raise InputError(f"n_steps is {quoted(n_steps)}", expected="a whole number of steps"
                         ) from None
    if whole < 0:
        raise InputError(f"n_steps is {n_steps}", expected="0 steps or more")


def _check(name: str, value: float, low: float, high: float) -> None:
    try:
        fits = bool(low <= value <= high)
    except (TypeError, ValueError):
        raise InputError(f"{name} is {quoted(value)}", expected=f"a number, {low:g} to {high:g}"
                         ) from None
    if not fits:
        raise InputError(f"{name} is {value:g}", expected=f"{low:g} to {high:g}")
