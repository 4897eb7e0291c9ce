"""One step of one truck: (state, parameters, inputs, dt) -> state, in place.

Arrays of octets instead of floats step eight trucks abreast: `octet`, `choose`.

Semi-implicit Euler: forces from the state at the step's beginning, then velocities, then positions
with the new velocities. Inputs are held over the step. Nothing is allocated.

References: symplectic Euler (Hairer, Lubich, Wanner, Geometric Numerical Integration, I.1).
Known limits: first order; 1 ms resolves rim contact (17 Hz) and hub spin (20 Hz) with margin.
Validated with: test/physics/test_step.py (golden run, mirror symmetry, halved step, repeatability);
test/physics/test_energy.py (balance).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics import abs_logic, brakes, driveline, road, steering
from truck_blowout_sim.physics.aero import add_air
from truck_blowout_sim.physics.axle import move_axle, place_axle
from truck_blowout_sim.physics.body import add_force, solve_unit, start_unit, twist_frame
from truck_blowout_sim.physics.choose import any_of, shared, where
from truck_blowout_sim.physics.fifth_wheel import add_coupling
from truck_blowout_sim.physics.jit import core, entry, stack_floats
from truck_blowout_sim.physics.layout import (
    ABS,
    ABS_AT,
    AXLE_S,
    DRIVE,
    DRIVE_AT,
    GLOBAL_S,
    INPUT,
    N_INPUTS,
    SLIPS_AT,
    STATE_UNIT_AT,
    TIRE_S,
    TOPOLOGY,
    UNIT,
    UNIT_AT,
    UNIT_S,
    WORLD,
    WORLD_AT,
)
from truck_blowout_sim.physics.places import (
    axle_state,
    circuit_of,
    hub_at_side,
    hub_of,
    hub_state,
    tire_state,
    unit_of,
    unit_params,
    unit_state,
    unit_work,
)
from truck_blowout_sim.physics.probe import add_probe
from truck_blowout_sim.physics.rotation import angle_rates, fill_rotation, to_body, to_map
from truck_blowout_sim.physics.scalar import finite, reached
from truck_blowout_sim.physics.tires.lanes import N_LANES
from truck_blowout_sim.physics.tires.tire import tire_pass

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]


@entry
def step(x: Floats, p: Floats, topo: Integers, inputs: Floats, dt: float, work: Floats) -> None:
    """Advance the state ``x`` of one truck by ``dt`` seconds."""
    n_units = topo[TOPOLOGY.n_units]
    for k in range(N_INPUTS):
        # limits further down would turn a NaN into a command
        x[GLOBAL_S.nonfinite] = where(finite(inputs[k]), x[GLOBAL_S.nonfinite], 1.0)
    g = road.gravity(p, x[GLOBAL_S.time_s])
    for u in range(n_units):
        s, a, w = unit_state(u), unit_params(u), unit_work(u)
        fill_rotation(x, s, work, w)
        start_unit(x, s, p, a, work, w, to_body(work, w, g[0], g[1], g[2]))
        add_air(x, s, p, a, work, w)
        add_probe(x, s, p, a, work, w)
    if n_units == 2:
        add_coupling(x, unit_state(0), unit_state(1), p, unit_params(0), unit_params(1), work,
                     unit_work(0), unit_work(1), dt)
    advance_brakes(x, p, topo, inputs, dt, work)
    speed = x[STATE_UNIT_AT + UNIT_S.u_mps]
    power, drag = driveline.engine(p, x[0], inputs[INPUT.throttle], speed)
    x[GLOBAL_S.drive_force_n] = 0.0
    push = p[DRIVE_AT + DRIVE.push_n]
    if any_of(push != 0.0):
        add_force(work, 0, (push, 0.0, 0.0), (0.0, 0.0, -p[UNIT_AT + UNIT.cg_height_m]))
    kingpin = advance_axles(x, p, topo, work, g, (power, drag, speed), dt)
    for u in range(n_units):
        twist_frame(x, unit_state(u), p, unit_params(u), work, unit_work(u), dt)
        solve_unit(x, unit_state(u), work, unit_work(u))
    if topo[TOPOLOGY.steered_axle] >= 0:
        steering.advance_steering(x, p, inputs[INPUT.steering_wheel_angle_rad], kingpin, dt)
    for u in range(n_units):
        move_unit(x, unit_state(u), work, unit_work(u), dt)
    for i in range(topo[TOPOLOGY.n_axles]):
        s = axle_state(topo, i)
        x[s + AXLE_S.z_m] += dt * x[s + AXLE_S.vz_mps]
        x[s + AXLE_S.roll_rad] += dt * x[s + AXLE_S.roll_rate_radps]
    x[GLOBAL_S.over_m] += where(
        reached(x[GLOBAL_S.time_s], p[WORLD_AT + WORLD.friction_change_time_s]), dt * speed, 0.0)
    x[GLOBAL_S.time_s] += dt


@core
def advance_axles(x: Floats, p: Floats, topo: Integers, work: Floats,
                  gravity: tuple[float, float, float], drive: tuple[float, float, float], dt: float
                  ) -> float:
    """Place all tires, let one pass make their forces, move axles; the kingpin moment [N m]."""
    lanes = stack_floats(x, N_LANES)
    first = 0
    for i in range(topo[TOPOLOGY.n_axles]):
        w = unit_work(unit_of(topo, i))
        first = place_axle(x, p, topo, i, first, work, w, lanes, dt)
    tire_pass(p, topo[TOPOLOGY.tire_at], topo[TOPOLOGY.table_at], lanes, first, dt)
    axis = steering.kingpin_axis(p)
    first, kingpin = 0, 0.0
    for i in range(topo[TOPOLOGY.n_axles]):
        w = unit_work(unit_of(topo, i))
        first, moment = move_axle(x, p, topo, i, first, work, w, gravity, axis, drive, lanes, dt)
        kingpin += moment
    return kingpin


@core
def move_unit(x: Floats, s: int, work: Floats, w: int, dt: float) -> None:
    """Integrate velocity and pose of one unit; flags a non-finite acceleration."""
    p, q, r = x[s + UNIT_S.p_radps], x[s + UNIT_S.q_radps], x[s + UNIT_S.r_radps]
    u, v, v_up = x[s + UNIT_S.u_mps], x[s + UNIT_S.v_mps], x[s + UNIT_S.w_mps]
    ax, ay, az = x[s + UNIT_S.ax_mps2], x[s + UNIT_S.ay_mps2], x[s + UNIT_S.az_mps2]
    sound = finite(ax + ay + az + x[s + UNIT_S.rdot_radps2])
    x[GLOBAL_S.nonfinite] = where(sound, x[GLOBAL_S.nonfinite], 1.0)
    x[s + UNIT_S.u_mps] = u + dt * (ax - q * v_up + r * v)
    x[s + UNIT_S.v_mps] = v + dt * (ay - r * u + p * v_up)
    x[s + UNIT_S.w_mps] = v_up + dt * (az - p * v + q * u)
    x[s + UNIT_S.p_radps] = p + dt * x[s + UNIT_S.pdot_radps2]
    x[s + UNIT_S.q_radps] = q + dt * x[s + UNIT_S.qdot_radps2]
    x[s + UNIT_S.r_radps] = r + dt * x[s + UNIT_S.rdot_radps2]
    m = to_map(work, w, x[s + UNIT_S.u_mps], x[s + UNIT_S.v_mps], x[s + UNIT_S.w_mps])
    x[s + UNIT_S.x_m] += dt * m[0]
    x[s + UNIT_S.y_m] += dt * m[1]
    x[s + UNIT_S.z_m] += dt * m[2]
    yaw_rate, pitch_rate, roll_rate = angle_rates(x, s, work, w)
    x[s + UNIT_S.yaw_rad] += dt * yaw_rate
    x[s + UNIT_S.pitch_rad] += dt * pitch_rate
    x[s + UNIT_S.roll_rad] += dt * roll_rate


@core
def advance_brakes(x: Floats, p: Floats, topo: Integers, inputs: Floats, dt: float,
                   work: Floats) -> None:
    """Delay lines, anti-lock decisions and chamber pressures of all hubs."""
    brakes.write_lines(x, topo, inputs)
    antilock = shared(p[ABS_AT + ABS.mode]) > 0.0
    if antilock:
        fill_slips(x, topo, work)
    for i in range(topo[TOPOLOGY.n_axles]):
        circuit = circuit_of(topo, i)
        control = brakes.delayed_pa(x, p, topo, circuit, dt)
        for k in range(2):
            s = hub_state(topo, hub_at_side(i, k))
            if antilock:
                abs_logic.decide(x, s, p, sensed_slip(p, topo, i, k, circuit, work),
                                 x[STATE_UNIT_AT + UNIT_S.u_mps], dt)
            brakes.advance_chamber(x, s, p, circuit, control, dt)


@core
def fill_slips(x: Floats, topo: Integers, work: Floats) -> None:
    """Brake slip of every hub, behind the units' working memory: that of its first loaded tire.

    Positive where the wheel turns less than the truck rolls, forward or in reverse.
    """
    way = where(x[STATE_UNIT_AT + UNIT_S.u_mps] < 0.0, -1.0, 1.0)
    for h in range(topo[TOPOLOGY.n_hubs]):
        work[SLIPS_AT + h] = 0.0
    for k in range(topo[TOPOLOGY.n_tires] - 1, -1, -1):
        s = tire_state(topo, k)
        slot = SLIPS_AT + hub_of(topo, k)
        work[slot] = where(x[s + TIRE_S.fz_n] > 0.0, -way * x[s + TIRE_S.slip], work[slot])


@core
def sensed_slip(p: Floats, topo: Integers, axle: int, side: int, circuit: int, work: Floats
                ) -> float:
    """Brake slip this hub's controller sees: its own, its side's, or its axle group's worst."""
    if shared(p[ABS_AT + ABS.mode]) == 1.0 or circuit == 0:
        return work[SLIPS_AT + hub_at_side(axle, side)]
    sensed = axle
    for i in range(topo[TOPOLOGY.n_axles]):
        if circuit_of(topo, i) == circuit:
            sensed = i
            if circuit == 1:
                break
    if circuit == 1:
        return work[SLIPS_AT + hub_at_side(sensed, side)]
    return max(work[SLIPS_AT + hub_at_side(sensed, 0)], work[SLIPS_AT + hub_at_side(sensed, 1)])


@core
def advance(x: Floats, p: Floats, topo: Integers, inputs: Floats, dt: float, n_steps: int,
            work: Floats) -> None:
    """``n_steps`` steps with held inputs."""
    for _ in range(n_steps):
        step(x, p, topo, inputs, dt, work)
