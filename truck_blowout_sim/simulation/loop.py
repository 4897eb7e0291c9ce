"""The compiled loop: many steps, driver, blowouts at steps, outputs every so many steps.

The driver stands in this file because compiled code is cached by the file of its caller.

References: pure pursuit (Coulter, CMU-RI-TR-92-01), with the understeer of the vehicle added.
Known limits: the driver knows the truck's true state; he holds speed with the throttle alone.
Validated with: test/simulation/test_driver.py.
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
    STATE_UNIT_AT,
    STEER,
    STEER_AT,
    UNIT,
    UNIT_AT,
    UNIT_S,
)
from truck_blowout_sim.physics.observe import observe
from truck_blowout_sim.physics.scalar import clip
from truck_blowout_sim.physics.step import step

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
    throttle_sum: int = 12  # memory: integral part of the throttle
    hand_wheel_rad: int = 13  # memory: hand wheel now
    path_index: int = 14  # memory: segment of the path beside the truck
    beside_m: int = 15  # memory: how far left of the truck the path runs
    trim_rad: int = 16  # memory: road-wheel angle that keeps the truck on the path


PILOT = PilotParams()


@core
def run_loop(x: Floats, p: Floats, topo: Integers, inputs: Floats, dt: float, every: int,
             first: int, last: int, origin_s: float, blow_steps: Integers, blow_slots: Integers,
             speed: Floats, mass_kg: float, pilot: Floats, path: Floats, work: Floats,
             out: Floats) -> bool:
    """Run the steps ``first`` .. ``last`` of a run; row k of ``out`` is the truck after k * every.

    A run may be cut anywhere: the parts give the same bits as the whole.

    Args:
        x, p, topo, work: state (advanced in place), parameters, topology, scratch.
        inputs: [n_steps, 5] of the whole run, held over each step; a driver writes his into it.
        origin_s: time at step 0.
        blow_steps, blow_slots: step index and state position of each blowout time.
        speed: [n_steps] forward speed [m/s] at the tractor's base_link, imposed or held by the
            driver; NaN where neither; or empty.
        mass_kg: mass an imposed speed moves.
        pilot: a driver (``PILOT``), or empty.
        path: [n, 2] points for the driver.
        out: [n_rows, n_outputs] of the whole run.

    Returns:
        False once the state stopped being finite.
    """
    n = inputs.shape[0]
    for k in range(first, last + 1):
        if x[GLOBAL_S.nonfinite] > 0.0:
            return False
        x[GLOBAL_S.time_s] = origin_s + k * dt
        # the part's last instant is the next part's first
        if k % every == 0 and (k < last or k == n):
            observe(x, p, topo, work, out[k // every])
        if k == last:
            break
        for b in range(blow_steps.size):
            if blow_steps[b] == k and x[blow_slots[b]] == np.inf:
                x[blow_slots[b]] = x[GLOBAL_S.time_s]
        if speed.size > 0:
            _drive_speed(x, p, inputs, k, dt, speed, mass_kg, pilot)
        if pilot.size > 0 and pilot[PILOT.follow] > 0.0:
            _steer(x, p, pilot, path, dt)
            inputs[k, 0] = pilot[PILOT.hand_wheel_rad]
        step(x, p, topo, inputs[k], dt, work)
    return x[GLOBAL_S.nonfinite] == 0.0


@core
def forward_speed(x: Floats, p: Floats) -> float:
    """Forward speed [m/s] at the tractor's base_link."""
    q, r = x[STATE_UNIT_AT + UNIT_S.q_radps], x[STATE_UNIT_AT + UNIT_S.r_radps]
    return (x[STATE_UNIT_AT + UNIT_S.u_mps] + q * p[UNIT_AT + UNIT.base_z_m]
            - r * p[UNIT_AT + UNIT.base_y_m])


@core
def _drive_speed(x: Floats, p: Floats, inputs: Floats, k: int, dt: float, speed: Floats,
                 mass_kg: float, pilot: Floats) -> None:
    """Push the truck along the imposed speed, or let the driver hold it with the throttle."""
    if pilot.size > 0 and pilot[PILOT.hold] > 0.0:
        if not np.isnan(speed[k]):
            inputs[k, 1] = _throttle(speed[k] - forward_speed(x, p), pilot, dt)
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
    if x[GLOBAL_S.time_s] > pilot[PILOT.follow_until_s]:
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
