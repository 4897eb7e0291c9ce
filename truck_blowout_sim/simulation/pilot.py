"""The compiled driver: speed held, a path followed, and what a blowout makes him do.

References: pure pursuit (Coulter, CMU-RI-TR-92-01), with the understeer of the vehicle added.
Reaction as a pause and then an action: Olson & Farber, Forensic Aspects of Driver Perception and
Response; what the thesis asks for as further work (driver reaction to the blowout).
Known limits: the driver knows the truck's true state; he holds speed with the throttle alone; until
he reacts he keeps hands and feet exactly still.
Validated with: test/simulation/test_driver.py, test/simulation/test_reaction.py.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics.jit import core
from truck_blowout_sim.physics.layout import (
    DRIVE,
    DRIVE_AT,
    GLOBAL_S,
    INPUT,
    N_INPUTS,
    STATE_UNIT_AT,
    STEER,
    STEER_AT,
    UNIT,
    UNIT_AT,
    UNIT_S,
)
from truck_blowout_sim.physics.scalar import EDGE_S, clip

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
_FOLLOW_S = 0.1  # time constant with which an imposed speed is followed


class PilotParams(NamedTuple):
    """Positions in the driver's parameter vector, and its memory behind them."""

    hold: int = 0  # 1: the speed column is held with the throttle, 0: imposed on the truck
    hold_gain_spm: int = 1
    hold_integral_pm: int = 2
    follow: int = 3  # 1: steer along the path
    preview_s: int = 4
    least_preview_m: int = 5
    lag_s: int = 6
    fastest_radps: int = 7
    most_rad: int = 8
    understeer_rads2pm: int = 9
    follow_until_s: int = 10
    trim_radpms: int = 11
    react: int = 12  # 1: a blowout, or a condition, changes what the driver does
    react_watch: int = 13  # number of the condition; -1: the first tire that bursts
    react_time_s: int = 14
    react_steering: int = 15  # position in REACT_STEERING
    react_throttle: int = 16  # position in REACT_THROTTLE
    react_throttle_over_s: int = 17
    react_brake_pa: int = 18
    react_brake_delay_s: int = 19
    react_brake_over_s: int = 20
    throttle_sum: int = 21  # memory: integral part of the throttle
    hand_wheel_rad: int = 22  # memory: hand wheel now
    path_index: int = 23  # memory: segment of the path beside the truck
    beside_m: int = 24  # memory: how far left of the truck the path runs
    trim_rad: int = 25  # memory: road-wheel angle that keeps the truck on the path
    noticed_s: int = 26  # memory: instant of what the driver reacts to
    noticed_speed_mps: int = 27  # memory: speed then
    kept: int = 28  # memory: first of the inputs as they were then


PILOT = PilotParams()
PILOT_SIZE = PILOT.kept + N_INPUTS
REACT_STEERING = ("as_before", "held")
REACT_THROTTLE = ("as_before", "lifted", "speed_held")
_HELD, _LIFTED, _SPEED_HELD = 1.0, 1.0, 2.0


@core
def drive_inputs(x: Floats, p: Floats, inputs: Floats, k: int, dt: float, speed: Floats,
                 mass_kg: float, pilot: Floats, path: Floats) -> None:
    """What is worked at step ``k``: fills the columns that a driver, or an imposed speed, rules."""
    driver = pilot.size > 0
    since = x[GLOBAL_S.time_s] - pilot[PILOT.noticed_s] if driver else -1.0
    still = since >= 0.0 and since < pilot[PILOT.react_time_s] - EDGE_S
    # an imposed speed is nobody's doing, so it goes on while the driver keeps still
    if speed.size > 0 and not (still and pilot[PILOT.hold] + pilot[PILOT.react_throttle] > 0.0):
        _drive_speed(x, p, inputs, k, dt, speed, mass_kg, pilot, since)
    if still:
        _keep_still(p, inputs, k, pilot)
        return
    if driver and pilot[PILOT.follow] > 0.0:
        _steer(x, p, pilot, path, dt)
        inputs[k, INPUT.steering_wheel_angle_rad] = pilot[PILOT.hand_wheel_rad]
    if since >= 0.0:
        _react(x, inputs, k, dt, pilot, since - pilot[PILOT.react_time_s])


@core
def notice(x: Floats, p: Floats, inputs: Floats, k: int, pilot: Floats) -> None:
    """What the driver reacts to happens now: remember speed, hands and feet."""
    pilot[PILOT.noticed_s] = x[GLOBAL_S.time_s]
    pilot[PILOT.noticed_speed_mps] = forward_speed(x, p)
    for i in range(N_INPUTS):
        pilot[PILOT.kept + i] = inputs[max(k - 1, 0), i]
    pilot[PILOT.hand_wheel_rad] = pilot[PILOT.kept + INPUT.steering_wheel_angle_rad]


@core
def _keep_still(p: Floats, inputs: Floats, k: int, pilot: Floats) -> None:
    for i in range(N_INPUTS):
        inputs[k, i] = pilot[PILOT.kept + i]
    if pilot[PILOT.react_throttle] > 0.0:
        p[DRIVE_AT + DRIVE.push_n] = 0.0


@core
def _react(x: Floats, inputs: Floats, k: int, dt: float, pilot: Floats, since_s: float) -> None:
    """Hands held or not, throttle lifted, brakes pressed; ``since_s`` after the first action."""
    if pilot[PILOT.react_steering] == _HELD:
        inputs[k, INPUT.steering_wheel_angle_rad] = (
            pilot[PILOT.kept + INPUT.steering_wheel_angle_rad])
    if pilot[PILOT.react_throttle] == _LIFTED:
        left = 1.0 - _share(since_s, pilot[PILOT.react_throttle_over_s])
        inputs[k, INPUT.throttle] = left * pilot[PILOT.kept + INPUT.throttle]
    pressed = _share(since_s - pilot[PILOT.react_brake_delay_s], pilot[PILOT.react_brake_over_s])
    for i in range(INPUT.brake_pressure_steer_pa, N_INPUTS):
        inputs[k, i] = max(inputs[k, i], pressed * pilot[PILOT.react_brake_pa])


@core
def _share(since_s: float, over_s: float) -> float:
    """0 before, 1 after, a straight line of ``over_s`` between."""
    if over_s > 0.0:
        return clip(since_s / over_s, 0.0, 1.0)
    return 1.0 if since_s >= -EDGE_S else 0.0


@core
def forward_speed(x: Floats, p: Floats) -> float:
    """Forward speed [m/s] at the tractor's base_link."""
    q, r = x[STATE_UNIT_AT + UNIT_S.q_radps], x[STATE_UNIT_AT + UNIT_S.r_radps]
    return (x[STATE_UNIT_AT + UNIT_S.u_mps] + q * p[UNIT_AT + UNIT.base_z_m]
            - r * p[UNIT_AT + UNIT.base_y_m])


@core
def _drive_speed(x: Floats, p: Floats, inputs: Floats, k: int, dt: float, speed: Floats,
                 mass_kg: float, pilot: Floats, since_s: float) -> None:
    """Push the truck along the imposed speed, or let the driver hold it with the throttle."""
    reacts = since_s >= 0.0
    if reacts and pilot[PILOT.react_throttle] == _SPEED_HELD:
        p[DRIVE_AT + DRIVE.push_n] = 0.0
        inputs[k, INPUT.throttle] = _throttle(
            pilot[PILOT.noticed_speed_mps] - forward_speed(x, p), pilot, dt)
        return
    if reacts and pilot[PILOT.react_throttle] == _LIFTED:
        p[DRIVE_AT + DRIVE.push_n] = 0.0
        return
    if pilot.size > 0 and pilot[PILOT.hold] > 0.0:
        if not np.isnan(speed[k]):
            inputs[k, INPUT.throttle] = _throttle(speed[k] - forward_speed(x, p), pilot, dt)
        return
    n = speed.size
    ahead = speed[min(k + 1, n - 1)] - speed[max(k - 1, 0)]
    rate = ahead / (2.0 * dt) + (speed[k] - forward_speed(x, p)) / _FOLLOW_S
    p[DRIVE_AT + DRIVE.push_n] = mass_kg * rate


@core
def _throttle(lack_mps: float, pilot: Floats, dt: float) -> float:
    """Proportional-integral throttle; the integral waits while the throttle is at its stop."""
    wanted = pilot[PILOT.throttle_sum] + pilot[PILOT.hold_gain_spm] * lack_mps
    if 0.0 < wanted < 1.0 or wanted * lack_mps < 0.0:
        pilot[PILOT.throttle_sum] += dt * pilot[PILOT.hold_integral_pm] * lack_mps
    return clip(wanted, 0.0, 1.0)


@core
def _steer(x: Floats, p: Floats, pilot: Floats, path: Floats, dt: float) -> None:
    """Turn the hand wheel towards the curvature that leads to the previewed point."""
    if x[GLOBAL_S.time_s] > pilot[PILOT.follow_until_s] + EDGE_S:
        return
    s = STATE_UNIT_AT
    yaw = x[s + UNIT_S.yaw_rad]
    c, sn = math.cos(yaw), math.sin(yaw)
    bx, by = p[UNIT_AT + UNIT.base_x_m], p[UNIT_AT + UNIT.base_y_m]
    px, py = x[s + UNIT_S.x_m] + c * bx - sn * by, x[s + UNIT_S.y_m] + sn * bx + c * by
    v = max(forward_speed(x, p), 0.0)
    tx, ty = _ahead(pilot, path, px, py, max(v * pilot[PILOT.preview_s],
                                             pilot[PILOT.least_preview_m]))
    dx, dy = tx - px, ty - py
    curvature = 2.0 * (c * dy - sn * dx) / max(dx * dx + dy * dy, 1.0)
    mean = curvature * (p[STEER_AT + STEER.wheelbase_m] + pilot[PILOT.understeer_rads2pm] * v * v)
    pilot[PILOT.trim_rad] += dt * pilot[PILOT.trim_radpms] * pilot[PILOT.beside_m]
    mean += pilot[PILOT.trim_rad]
    most, fastest = pilot[PILOT.most_rad], pilot[PILOT.fastest_radps]
    wanted = clip(mean * p[STEER_AT + STEER.ratio], -most, most)
    turn = (wanted - pilot[PILOT.hand_wheel_rad]) / (pilot[PILOT.lag_s] + dt)
    pilot[PILOT.hand_wheel_rad] += dt * clip(turn, -fastest, fastest)


@core
def _ahead(pilot: Floats, path: Floats, px: float, py: float, distance: float
           ) -> tuple[float, float]:
    """The path's point ``distance`` [m] of path ahead of the place beside (px, py)."""
    i, n = int(pilot[PILOT.path_index]), path.shape[0]
    along, length, sx, sy = 0.0, 0.0, 0.0, 0.0
    while True:
        sx, sy = path[i + 1, 0] - path[i, 0], path[i + 1, 1] - path[i, 1]
        length = math.sqrt(sx * sx + sy * sy)
        along = ((px - path[i, 0]) * sx + (py - path[i, 1]) * sy) / length
        if along <= length or i >= n - 2:
            break
        i += 1
    pilot[PILOT.path_index] = i
    pilot[PILOT.beside_m] = (sx * (path[i, 1] - py) - sy * (path[i, 0] - px)) / length
    rest = max(along, 0.0) + distance
    while rest > length and i < n - 2:
        rest -= length
        i += 1
        sx, sy = path[i + 1, 0] - path[i, 0], path[i + 1, 1] - path[i, 1]
        length = math.sqrt(sx * sx + sy * sy)
    # beyond the end the path goes straight on
    return (path[i, 0] + rest / length * (path[i + 1, 0] - path[i, 0]),
            path[i, 1] + rest / length * (path[i + 1, 1] - path[i, 1]))
