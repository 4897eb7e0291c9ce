"""The state a truck starts from: settled on its springs, rolling steadily, nothing moving.

The truck is placed at its design attitude and stepped in place with its travel held (speed, yaw
rate and course prescribed) while bounce, pitch and roll are damped away. What is left afterwards is
the equilibrium of the very step function that follows, so that nothing settles at t = 0.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics.jit import core
from truck_blowout_sim.physics.layout import (
    AXLE,
    AXLE_S,
    GLOBAL_S,
    N_WORK,
    TIRE,
    TIRE_S,
    TOPOLOGY,
    UNIT,
    UNIT_AT,
    UNIT_S,
    UNIT_SIZE,
)
from truck_blowout_sim.physics.places import (
    axle_params,
    axle_state,
    brake_line,
    hub_of,
    hub_state,
    tire_params,
    tire_state,
    unit_params,
    unit_state,
)
from truck_blowout_sim.physics.steering import commanded_rad
from truck_blowout_sim.physics.step import step
from truck_blowout_sim.physics.trig import heading
from truck_blowout_sim.simulation.flat import Flat, deflate, set_clock, while_settling
from truck_blowout_sim.simulation.inputs import STANDSTILL, Inputs
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
_SETTLE_S = 6.0
_SETTLE_WARM_S = 1.5
_DAMPING_PS = 8.0  # rate at which bounce, pitch and roll are taken out while settling


@dataclass(frozen=True, kw_only=True)
class InitialState:
    """Where and how fast the truck starts. Positions are of the tractor's base_link in map.

    ``flat``: tires that burst before, and how long before [s].
    """

    speed_mps: float = 0.0
    lateral_speed_mps: float = 0.0
    yaw_rate_radps: float = 0.0
    x_m: float = 0.0
    y_m: float = 0.0
    yaw_rad: float = 0.0
    articulation_rad: float = 0.0
    time_s: float = 0.0
    inputs: Inputs = STANDSTILL
    flat: tuple[Flat, ...] = ()


def initial_vector(packed: Packed, initial: InitialState, step_s: float,
                   warm: Floats | None = None) -> Floats:
    """State vector [n_state] in equilibrium at ``initial``; see the module's text.

    Nothing that is timed acts while the truck settles, not even what began before the start.

    ``warm``: the equilibrium of a similar truck at the same ``initial``, from which settling is
    shorter.
    """
    x, u = unsettled(packed, initial, warm)
    settle(x, while_settling(packed, initial.flat), packed.topology, u, step_s,
           settle_steps(step_s, warm), held_motion(packed, initial), np.zeros(N_WORK))
    place(x, packed, initial)
    return x


def settle_steps(step_s: float, warm: Floats | None) -> int:
    """How many steps a truck settles."""
    return int((_SETTLE_S if warm is None else _SETTLE_WARM_S) / step_s)


def unsettled(packed: Packed, initial: InitialState, warm: Floats | None) -> tuple[Floats, Floats]:
    """The state from which a truck settles, and the inputs held meanwhile."""
    x = _design_state(packed, initial) if warm is None else warm.copy()
    x[GLOBAL_S.time_s] = 0.0
    u = np.array(initial.inputs, dtype=np.float64)
    _fill_brakes(x, packed.topology, u)
    deflate(x, packed, initial.flat)
    return x, u


def _design_state(packed: Packed, initial: InitialState) -> Floats:
    """Everything at its design height, wheels rolling, tires inflated."""
    topo, p = packed.topology, packed.params
    x = np.zeros(topo[TOPOLOGY.n_state])
    for u in range(topo[TOPOLOGY.n_units]):
        s, a = unit_state(u), unit_params(u)
        x[s + UNIT_S.z_m] = p[a + UNIT.cg_height_m]
        x[s + UNIT_S.x_m] = 0.0 if u == 0 else (
            p[UNIT_AT + UNIT.hitch_x_m] - p[a + UNIT.hitch_x_m])
        x[s + UNIT_S.u_mps] = initial.speed_mps
    for i in range(topo[TOPOLOGY.n_axles]):
        s = axle_state(topo, i)
        x[s + AXLE_S.z_m] = p[axle_params(topo, i) + AXLE.center_height_m]
    for t in range(topo[TOPOLOGY.n_tires]):
        s, a = tire_state(topo, t), tire_params(topo, t)
        x[s + TIRE_S.pressure_pa] = p[a + TIRE.pressure_pa]
        x[s + TIRE_S.blown_time_s] = np.inf
        hub = hub_of(topo, t)
        radius = p[a + TIRE.unloaded_radius_m] - 0.01
        x[hub_state(topo, hub)] = initial.speed_mps / radius
    command = commanded_rad(p, initial.inputs.steering_wheel_angle_rad)
    x[GLOBAL_S.steer_rad] = x[GLOBAL_S.steer_command_rad] = command
    return x


def held_motion(packed: Packed, initial: InitialState) -> Floats:
    """Per unit: forward speed, lateral speed and yaw rate at its center of gravity, and yaw."""
    p, n, yaw_rate = packed.params, packed.topology[TOPOLOGY.n_units], initial.yaw_rate_radps
    base = (p[UNIT_AT + UNIT.base_x_m], p[UNIT_AT + UNIT.base_y_m])
    center = _moved((initial.speed_mps, initial.lateral_speed_mps), yaw_rate, base, (0.0, 0.0))
    held = np.zeros((n, 4))
    held[0] = (*center, yaw_rate, 0.0)
    if n > 1:
        held[1] = (*_trailer_motion(p, center, yaw_rate, initial.articulation_rad), yaw_rate,
                   initial.articulation_rad)
    return held


def _trailer_motion(p: Floats, tractor: tuple[float, float], yaw_rate: float,
                    articulation: float) -> tuple[float, float]:
    """Forward and lateral speed of the trailer that keep the kingpin on the fifth wheel."""
    hitches = [(p[at + UNIT.hitch_x_m], p[at + UNIT.hitch_y_m])
               for at in (UNIT_AT, UNIT_AT + UNIT_SIZE)]
    u, v = _moved(tractor, yaw_rate, (0.0, 0.0), hitches[0])
    c, s = math.cos(articulation), math.sin(articulation)
    return _moved((u * c + v * s, v * c - u * s), yaw_rate, hitches[1], (0.0, 0.0))


def _moved(speeds: tuple[float, float], yaw_rate: float, here: tuple[float, float],
           there: tuple[float, float]) -> tuple[float, float]:
    """Forward and lateral speed of one point of a rigid body, from those of another."""
    return (speeds[0] - yaw_rate * (there[1] - here[1]),
            speeds[1] + yaw_rate * (there[0] - here[0]))


def _fill_brakes(x: Floats, topo: Integers, inputs: Floats) -> None:
    """Delay lines and chambers as if the control pressures had been there for long."""
    n = topo[TOPOLOGY.line_length]
    for c in range(3):
        at = brake_line(topo, c)
        x[at:at + n] = inputs[2 + c]
    # chambers follow within the settling


@core
def settle(x: Floats, p: Floats, topo: Integers, inputs: Floats, dt: float, n_steps: int,
           held: Floats, work: Floats) -> None:
    """Step in place: travel held, bounce, pitch and roll damped, dry friction kept at zero."""
    keep = 1.0 - _DAMPING_PS * dt
    for _ in range(n_steps):
        step(x, p, topo, inputs, dt, work)
        x[GLOBAL_S.time_s] = 0.0
        x[GLOBAL_S.steer_friction_nm] = 0.0
        x[GLOBAL_S.coupling_friction_nm] = 0.0
        x[GLOBAL_S.steer_rate_radps] *= keep
        for u in range(topo[TOPOLOGY.n_units]):
            _hold_unit(x, p, u, held, keep)
        for i in range(topo[TOPOLOGY.n_axles]):
            s = axle_state(topo, i)
            x[s + AXLE_S.vz_mps] *= keep
            x[s + AXLE_S.roll_rate_radps] *= keep
            x[s + AXLE_S.friction_left_n] = 0.0
            x[s + AXLE_S.friction_right_n] = 0.0


@core
def _hold_unit(x: Floats, p: Floats, u: int, held: Floats, keep: float) -> None:
    """Prescribe travel of one unit and keep the kingpin over the fifth wheel."""
    s, a = unit_state(u), unit_params(u)
    x[s + UNIT_S.u_mps] = held[u, 0]
    x[s + UNIT_S.v_mps] = held[u, 1]
    x[s + UNIT_S.r_radps] = held[u, 2]
    x[s + UNIT_S.w_mps] *= keep
    x[s + UNIT_S.p_radps] *= keep
    x[s + UNIT_S.q_radps] *= keep
    x[s + UNIT_S.yaw_rad] = held[u, 3]
    x[s + UNIT_S.x_m] = 0.0
    x[s + UNIT_S.y_m] = 0.0
    if u == 1:
        c, sn = heading(held[1, 3])
        x[s + UNIT_S.x_m] = p[UNIT_AT + UNIT.hitch_x_m] - c * p[a + UNIT.hitch_x_m]
        x[s + UNIT_S.y_m] = p[UNIT_AT + UNIT.hitch_y_m] - sn * p[a + UNIT.hitch_x_m]


def place(x: Floats, packed: Packed, initial: InitialState) -> None:
    """Bring a settled truck to where and when it starts: its tractor's base_link to the pose."""
    p, c, s = packed.params, math.cos(initial.yaw_rad), math.sin(initial.yaw_rad)
    bx, by = p[UNIT_AT + UNIT.base_x_m], p[UNIT_AT + UNIT.base_y_m]
    for u in range(packed.topology[TOPOLOGY.n_units]):
        at = unit_state(u)
        dx, dy = x[at + UNIT_S.x_m] - bx, x[at + UNIT_S.y_m] - by
        x[at + UNIT_S.x_m] = initial.x_m + c * dx - s * dy
        x[at + UNIT_S.y_m] = initial.y_m + s * dx + c * dy
        x[at + UNIT_S.yaw_rad] += initial.yaw_rad
    x[GLOBAL_S.time_s] = initial.time_s
    set_clock(x, packed, initial.flat, initial.time_s)
