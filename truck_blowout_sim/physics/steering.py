"""Steering: hand wheel, ratio, lag, lash, compliance, friction, kingpin moments by vectors.

References: kingpin moment = k . (lever x F + M), k tilted by inclination and caster and rolled with
the axle; the part about the spin axis turns the wheel, not the knuckle. Values: docs/physics.md.
A gear whose ratio bends: the angle grows with its cube, even about straight ahead (variable-ratio
gears, T. D. Gillespie, Fundamentals of Vehicle Dynamics, chapter 8). The lag of an actuator, of
hydraulics or of the column is of first order.
Known limits: one degree of freedom for both road wheels; no hand-wheel inertia (an input);
single tires on the steered axle; no camber from the kingpin's tilt as the wheel turns.
Validated with: test/physics/test_steering.py (lever of drag: ground offset 63 mm inflated, 77 mm
flat when braked, spindle offset 115 mm when rolling; static compliance; lash dead zone).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics.choose import shared, where
from truck_blowout_sim.physics.jit import core
from truck_blowout_sim.physics.layout import GLOBAL_S, STEER, STEER_AT
from truck_blowout_sim.physics.scalar import clip, deadzone, hysteresis
from truck_blowout_sim.physics.trig import turned

Floats = NDArray[np.float64]
_STOP_RAD = 0.9  # of the mean road-wheel angle: beyond the 45 deg at which trucks' stops are set
_FASTEST_RADPS = 20.0  # keeps a wheel that is torn around within what a step resolves


@core
def wheel_angle_rad(x: Floats, p: Floats, side: float, half_track_m: float) -> float:
    """Steer angle of one steered wheel (side +1 left) from the mean angle, Ackermann share."""
    mean = x[GLOBAL_S.steer_rad]
    share = p[STEER_AT + STEER.ackermann_fraction] * half_track_m / p[STEER_AT + STEER.wheelbase_m]
    return mean + side * share * mean * mean


@core
def kingpin_axis(p: Floats) -> tuple[float, float, float]:
    """Direction of the left kingpin while the axle is level: backward, inward, up; unit length."""
    cos_c, sin_c = turned(p[STEER_AT + STEER.caster_rad])
    cos_k, sin_k = turned(p[STEER_AT + STEER.kingpin_inclination_rad])
    tan_c, tan_k = sin_c / cos_c, sin_k / cos_k
    size = math.sqrt(1.0 + tan_c * tan_c + tan_k * tan_k)
    return tan_c / size, tan_k / size, 1.0 / size


@core
def kingpin_moment_nm(p: Floats, axis: tuple[float, float, float], side: float, roll_rad: float,
                      steer_rad: float, radius_m: float, force: tuple[float, float, float],
                      aligning_nm: float, brake_nm: float, gyro_nm: float) -> float:
    """Moment [N m] about one kingpin, positive steering left.

    ``axis``: `kingpin_axis`; ``force``: tire force in wheel axes (forward, left, up);
    ``radius_m``: loaded radius;
    ``brake_nm``: reaction of the brake on the knuckle; ``gyro_nm``: gyroscopic moment about z.
    """
    ct, st = turned(roll_rad)
    kx = -axis[0]
    ky = -side * axis[1] * ct - axis[2] * st
    kz = axis[2] * ct - side * axis[1] * st
    cd, sd = turned(steer_rad)
    fx, fy, fz = force[0] * cd - force[1] * sd, force[0] * sd + force[1] * cd, force[2]
    # spin axis, pointing left
    ax, ay, az = -sd * ct, cd * ct, st
    off = side * p[STEER_AT + STEER.kingpin_offset_m]
    lx, ly, lz = off * ax, off * ay, off * az
    mx, my, mz = ly * fz - lz * fy, lz * fx - lx * fz, lx * fy - ly * fx
    # tire wrench at the wheel centre without its part about the spin axis
    dy, dz = radius_m * st, -radius_m * ct
    tx, ty, tz = dy * fz - dz * fy, dz * fx, -dy * fx + aligning_nm
    spin = tx * ax + ty * ay + tz * az
    mx += tx - spin * ax + brake_nm * ax
    my += ty - spin * ay + brake_nm * ay
    mz += tz - spin * az + brake_nm * az + gyro_nm
    return kx * mx + ky * my + kz * mz


@core
def commanded_rad(p: Floats, hand_wheel_rad: float) -> float:
    """Mean road-wheel angle that a hand-wheel angle asks for: the ratio and its curve."""
    gear = (hand_wheel_rad - p[STEER_AT + STEER.offset_rad]) / p[STEER_AT + STEER.ratio]
    return gear * (1.0 + p[STEER_AT + STEER.ratio_curve_prad2] * gear * gear)


@core
def advance_steering(x: Floats, p: Floats, hand_wheel_rad: float, moment_nm: float,
                     dt: float) -> None:
    """Turn the road wheels by hand wheel and kingpin moment for one step."""
    target = commanded_rad(p, hand_wheel_rad)
    lag = p[STEER_AT + STEER.lag_s]
    before = x[GLOBAL_S.steer_command_rad]
    target = where(lag > 0.0, before + dt / (lag + dt) * (target - before), target)
    x[GLOBAL_S.steer_command_rad] = target
    x[GLOBAL_S.kingpin_moment_nm] = moment_nm
    if shared(p[STEER_AT + STEER.compliance_on]) == 0.0:
        x[GLOBAL_S.steer_rad] = clip(target, -_STOP_RAD, _STOP_RAD)
        x[GLOBAL_S.steer_rate_radps] = 0.0
        return
    lash = p[STEER_AT + STEER.lash_rad] + p[STEER_AT + STEER.lash_extra_rad]
    play = max(0.5 * lash / p[STEER_AT + STEER.ratio], 0.0)
    stiffness = p[STEER_AT + STEER.stiffness_nmprad] * p[STEER_AT + STEER.stiffness_gain]
    rate = x[GLOBAL_S.steer_rate_radps]
    x[GLOBAL_S.steer_friction_nm] = hysteresis(
        x[GLOBAL_S.steer_friction_nm], rate * dt, p[STEER_AT + STEER.friction_nm],
        p[STEER_AT + STEER.friction_transition_rad])
    link = stiffness * deadzone(target - x[GLOBAL_S.steer_rad], play)
    damping = p[STEER_AT + STEER.damping_nmsprad]
    inertia = p[STEER_AT + STEER.inertia_kgm2]
    push = moment_nm + link - x[GLOBAL_S.steer_friction_nm]
    rate = (rate + dt * push / inertia) / (1.0 + dt * damping / inertia)
    rate = clip(rate, -_FASTEST_RADPS, _FASTEST_RADPS)
    angle = x[GLOBAL_S.steer_rad] + dt * rate
    x[GLOBAL_S.steer_rad] = clip(angle, -_STOP_RAD, _STOP_RAD)
    x[GLOBAL_S.steer_rate_radps] = where(abs(angle) < _STOP_RAD, rate, 0.0)
