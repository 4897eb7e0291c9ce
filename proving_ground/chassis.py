"""What holds and drives the truck: springs, steering linkage, coupling, driveline, air.

References: Rill, Road Vehicle Dynamics (2012), ch. 5; dry friction after Dahl.
Known differences from a real truck: ideal differentials, no axle wind-up, no cab suspension.
"""

from __future__ import annotations

import math

from proving_ground.compiled import compiled
from proving_ground.contact import add_force
from proving_ground.laws import BLOW_OFF, LEAF, SMOOTH
from proving_ground.layout import Commands, State, Truck, Views
from proving_ground.switches import Switches


@compiled
def dahl(force: float, step: float, limit: float, travel: float) -> float:
    """Dry friction after a small travel: tends to +-limit over the length `travel`."""
    if step == 0.0 or limit <= 0.0:
        return force if limit > 0.0 else 0.0
    goal = limit if step > 0.0 else -limit
    return goal + (force - goal) * math.exp(-abs(step) / travel)


@compiled
def springs(v: Views, truck: Truck, state: State, sw: Switches) -> None:
    """Leaf springs in front, air springs on the drive axles, equalized leaves on the trailer."""
    laws = truck.laws
    for axle in range(5):
        heave, roll = truck.heave[axle], truck.roll[axle]
        half = 0.5 * truck.spacing[axle]
        for side in range(2):
            arm = half if side == 0 else -half
            up = v.qpos[heave + 1] + arm * v.qpos[roll + 1]
            rate = v.qvel[heave] + arm * v.qvel[roll]
            force = spring_force(v, truck, sw, axle, up, arm)
            limit = truck.coulomb[axle]
            if laws.friction_law == LEAF:
                limit *= max(force, 0.0) / truck.preload_n[axle]
            force += damper_force(truck, axle, rate)
            step = up - state.leaf_at[axle, side]
            state.leaf_at[axle, side] = up
            if laws.friction_law == SMOOTH:
                state.leaf[axle, side] = limit * math.tanh(
                    rate / laws.friction_speed_mps)
            else:
                state.leaf[axle, side] = dahl(state.leaf[axle, side], step, limit,
                                              laws.friction_travel_m)
            force += state.leaf[axle, side]
            v.qfrc[heave] -= force
            v.qfrc[roll] -= arm * force


@compiled
def damper_force(truck: Truck, axle: int, rate: float) -> float:
    """Damper force of one side, N: stiffer one way, degressive, linear, or with a valve."""
    laws = truck.laws
    side = laws.rebound if rate > 0.0 else laws.bump
    if laws.damper_law == BLOW_OFF:
        over = max(abs(rate) - laws.blow_off_mps, 0.0)
        felt = abs(rate) - (1.0 - laws.blow_off_share) * over
        return side * truck.damper[axle] * math.copysign(felt, rate)
    if laws.damper_exponent == 1.0:
        return side * truck.damper[axle] * rate
    size = 0.1 * (abs(rate) / 0.1 + 1.0e-3) ** (laws.damper_exponent - 1.0) * (rate / 0.1)
    return side * truck.damper[axle] * size


@compiled
def spring_force(v: Views, truck: Truck, sw: Switches, axle: int, up: float,
                 arm: float) -> float:
    """Elastic force of one spring, N, from its compression `up` (m) and bump stops."""
    load, stiffness = truck.preload_n[axle], truck.spring[axle]
    force: float = 0.0
    if axle == 0:
        force = load + stiffness * up * (1.0 + truck.laws.leaf_hardening * up * up)
    elif axle < 3:
        if arm > 0.0:
            load -= sw.leak_n
        length = truck.laws.air_exponent * truck.preload_n[axle] / stiffness
        force = load * (length / (length - min(up, 0.75 * length))) ** truck.laws.air_exponent
    else:
        other = 7 - axle
        partner = v.qpos[truck.heave[other] + 1] + arm * v.qpos[truck.roll[other] + 1]
        mean = 0.5 * (up + partner)
        force = load + stiffness * (mean + truck.laws.unequal * (up - mean))
    stop = abs(up) - 0.075
    if stop > 0.0:
        force += math.copysign(1.5e6 * stop, up)
    return force


@compiled
def road_wheel_wanted(truck: Truck, state: State, sw: Switches, hand: float, dt: float) -> float:
    """Road-wheel angle that the gear asks for, rad: another ratio, and a gear that follows late."""
    wanted = hand / truck.ratio
    wanted *= 1.0 + sw.ratio_error + sw.ratio_bend * (1.0 - math.exp(-(hand / 0.7) ** 2))
    if sw.steer_lag_s <= 0.0:
        return wanted
    if sw.steer_lag_stages == 1:
        state.extra[7] += (1.0 - math.exp(-dt / sw.steer_lag_s)) * (wanted - state.extra[7])
        return state.extra[7]
    share = 1.0 - math.exp(-2.0 * dt / sw.steer_lag_s)
    state.extra[6] += share * (wanted - state.extra[6])
    state.extra[7] += share * (state.extra[6] - state.extra[7])
    return state.extra[7]


@compiled
def steering(v: Views, truck: Truck, state: State, sw: Switches, commands: Commands,
             dt: float) -> None:
    """Hand wheel through play and linkage to the left wheel, tie rod to the right one."""
    left = v.qpos[truck.kingpin_qpos[0]] + truck.toe_rad
    right = v.qpos[truck.kingpin_qpos[1]] - truck.toe_rad
    column = road_wheel_wanted(truck, state, sw, commands.steering, dt) + truck.zero_rad
    wind = column - left
    play = truck.lash_half_rad + sw.lash_half_rad
    torque = state.dry[2]
    if abs(wind) > play:
        wound = wind - math.copysign(play, wind)
        soft = 1.0 - sw.linkage_soft * math.exp(-abs(wound) * sw.linkage_harden)
        soft *= 1.0 + truck.laws.linkage_hardening * abs(wound)
        torque += truck.linkage * soft * wound
    step = wind - state.dry_at[2]
    state.dry_at[2] = wind
    state.dry[2] = dahl(state.dry[2], step, sw.lash_friction, 0.4 * play)
    tie = truck.tie_rod * (left - truck.ackermann * left * left - right)
    v.qfrc[truck.kingpin[0]] += torque - tie
    v.qfrc[truck.kingpin[1]] += tie
    for side in range(2):
        angle = v.qpos[truck.kingpin_qpos[side]]
        step = angle - state.dry_at[side]
        state.dry_at[side] = angle
        state.dry[side] = dahl(state.dry[side], step, 0.5 * truck.kingpin_friction, 0.0006)
        v.qfrc[truck.kingpin[side]] -= state.dry[side]


@compiled
def coupling(v: Views, truck: Truck, state: State, sw: Switches) -> None:
    """Yaw friction of the fifth wheel; a dry plate sticks harder than it slides."""
    angle, rate = v.qpos[truck.hitch_qpos], v.qvel[truck.hitch]
    step = angle - state.dry_at[3]
    state.dry_at[3] = angle
    sticking = 1.0 + sw.hitch_sticking * math.exp(-abs(rate) / 0.01)
    limit = truck.hitch_friction + sw.hitch_friction * sticking
    state.dry[3] = dahl(state.dry[3], step, limit, 0.003)
    v.qfrc[truck.hitch] -= state.dry[3]


@compiled
def driveline(v: Views, truck: Truck, state: State, sw: Switches, commands: Commands, speed: float,
              dt: float) -> None:
    """Net drive force shared by the four drive hubs; a retarder builds up off throttle."""
    force = commands.throttle * truck.power_w / max(speed, 3.0)
    force -= truck.engine_drag_n * (1.0 - commands.throttle)
    goal = sw.retarder_n * max(0.0, 1.0 - commands.throttle / 0.05)
    if sw.retarder_at_mps > 0.0:
        goal *= math.tanh((speed / sw.retarder_at_mps) ** 2)
    state.extra[4] += dt / 0.35 * (goal - state.extra[4])
    force -= state.extra[4]
    if sw.shuffle_n != 0.0:
        now = state.time[0]
        wave = math.sin(2.0 * math.pi * sw.shuffle_hz * now)
        force += sw.shuffle_n * wave * (1.0 + 0.5 * math.sin(2.0 * math.pi * 0.13 * now))
    for hub in range(2, 6):
        v.qfrc[truck.wheel_dof[hub]] += 0.25 * force * 0.5


@compiled
def air(v: Views, truck: Truck, sw: Switches, speed: float) -> None:
    """Aerodynamic drag of both units along their own axes."""
    for unit in range(2):
        body = truck.units[2 * unit]
        area = truck.drag_area[unit]
        if truck.laws.drag_exponent != 2.0:
            area *= (max(speed, 1.0) / 25.0) ** (truck.laws.drag_exponent - 2.0)
        area += sw.drag_area[unit] * (0.85 + 0.15 * (speed / 22.0))
        force = 0.5 * truck.air_density * area * speed * speed
        cx, sx = v.xmat[body, 0], v.xmat[body, 3]
        add_force(v, body, -force * cx, -force * sx, 0.0,
                  v.xpos[body, 0] - 2.0 * cx, v.xpos[body, 1] - 2.0 * sx, truck.air_height)
