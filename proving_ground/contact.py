"""Wheels on the road: where each of the 18 tires touches, how hard, and what it does there."""

from __future__ import annotations

import math

from proving_ground.compiled import compiled
from proving_ground.laws import Laws
from proving_ground.layout import ROAD_STEP_M, FloatArray, State, Truck, Views
from proving_ground.switches import Switches
from proving_ground.tire import cornering_slope, relaxation_length, steady_forces

AMBIENT_PA = 101325.0
ROOT_BODY = 1


@compiled
def add_force(v: Views, body: int, fx: float, fy: float, fz: float,
              px: float, py: float, pz: float) -> None:
    """Apply a world force (N) at a world point (m) of a body."""
    rx, ry, rz = px - v.xipos[body, 0], py - v.xipos[body, 1], pz - v.xipos[body, 2]
    v.xfrc[body, 0] += fx
    v.xfrc[body, 1] += fy
    v.xfrc[body, 2] += fz
    v.xfrc[body, 3] += ry * fz - rz * fy
    v.xfrc[body, 4] += rz * fx - rx * fz
    v.xfrc[body, 5] += rx * fy - ry * fx


@compiled
def point_velocity(v: Views, body: int, px: float, py: float,
                   pz: float) -> tuple[float, float, float]:
    """World velocity (m/s) of a world point that moves with a body."""
    wx, wy, wz = v.cvel[body, 0], v.cvel[body, 1], v.cvel[body, 2]
    rx, ry, rz = (px - v.subtree_com[ROOT_BODY, 0], py - v.subtree_com[ROOT_BODY, 1],
                  pz - v.subtree_com[ROOT_BODY, 2])
    return (v.cvel[body, 3] + wy * rz - wz * ry, v.cvel[body, 4] + wz * rx - wx * rz,
            v.cvel[body, 5] + wx * ry - wy * rx)


@compiled
def road_height(road: FloatArray, x: float, left: bool) -> float:
    """Unevenness under a wheel track, m."""
    track = 0 if left else 1
    place = x / ROAD_STEP_M
    i = math.floor(place)
    part = place - i
    n = road.shape[1]
    height: float = road[track, i % n] * (1.0 - part) + road[track, (i + 1) % n] * part
    return height


@compiled
def vertical_force(deflection: float, rate: float, fill: float, radius: float,
                   laws: Laws) -> float:
    """Radial tire force, N: quadratic rubber and air, then rim on folded carcass."""
    if deflection <= 0.0:
        return 0.0
    soft = laws.carcass + (1.0 - laws.carcass) * fill
    force = soft * deflection * (laws.radial + laws.radial_rise * deflection)
    damping = 2500.0
    rim = deflection - (radius - laws.rim_radius_m)
    if rim > 0.0:
        force += laws.rim * rim * rim
        damping += 4.0e5 * min(rim, 0.03)
    return max(0.0, force + damping * rate)


@compiled
def extra_steer(axle: int, v: Views, truck: Truck, sw: Switches) -> float:
    """Uncommanded steer of an axle, rad: misalignment and roll steer with a progressive part.

    Positive roll steer turns a rear axle into the turn and the steer axle toward its low corner.
    """
    roll = -v.qpos[truck.roll[axle] + 1]
    steer = sw.roll_steer[axle]
    angle: float = sw.misalign[axle] + steer * roll * (1.0 + 6.0 * abs(roll))
    return angle


@compiled
def friction_at(x: float, sw: Switches) -> float:
    """Friction relative to the dry road: falls over a length from where the effect begins."""
    s = (x - sw.friction_x_m) / sw.friction_length_m
    if s <= 0.0:
        return 1.0
    return 1.0 - sw.friction_drop * (1.0 - math.exp(-s * s))


@compiled
def all_tires(v: Views, truck: Truck, state: State, sw: Switches, dt: float) -> None:
    """Forces of all tires onto the wheel bodies."""
    tire = 0
    for hub in range(10):
        axle = hub // 2
        for place in range(truck.duals[axle]):
            offset = 0.0
            if truck.duals[axle] == 2:
                side = 1.0 if hub % 2 == 0 else -1.0
                offset = side * truck.dual_half_m * (1.0 if place == 0 else -1.0)
            one_tire(v, truck, state, sw, dt, hub, tire, offset)
            tire += 1


@compiled
def one_tire(v: Views, truck: Truck, state: State, sw: Switches, dt: float, hub: int, tire: int,
             offset: float) -> None:
    """Normal, tangential force, rolling resistance and aligning moment of one tire."""
    axle, carrier, wheel = hub // 2, truck.carrier[hub], truck.wheel[hub]
    ax, ay, az = v.xmat[carrier, 1], v.xmat[carrier, 4], v.xmat[carrier, 7]
    turn = extra_steer(axle, v, truck, sw)
    lx, ly = ax - turn * ay, ay + turn * ax
    norm = math.sqrt(lx * lx + ly * ly)
    lx, ly = lx / norm, ly / norm
    px = v.xpos[wheel, 0] + offset * ax
    py = v.xpos[wheel, 1] + offset * ay
    pz = v.xpos[wheel, 2] + offset * az
    ground = road_height(truck.road, px, hub % 2 == 0)
    deflection = truck.radius_m - (pz - ground)
    east, north, up = point_velocity(v, carrier, px, py, ground)
    vx, vy = east * ly - north * lx, east * lx + north * ly
    fill = max(0.0, (state.pressure[tire] - AMBIENT_PA) / truck.pressure_pa)
    load = vertical_force(deflection, -up, fill, truck.radius_m, truck.laws)
    state.tire_fz[tire] = load
    if load <= 1.0:
        state.tire_fx[tire] = 0.0
        state.tire_fy[tire] = 0.0
        return
    trail = tangential(v, truck, state, sw, dt, hub, tire, load, deflection, fill, vx, vy, az, px)
    fx, fy = state.tire_fx[tire], state.tire_fy[tire]
    add_force(v, wheel, fx * ly + fy * lx, -fx * lx + fy * ly, load, px, py, ground)
    v.xfrc[wheel, 5] -= trail * fy


@compiled
def tangential(v: Views, truck: Truck, state: State, sw: Switches, dt: float, hub: int, tire: int,
               load: float, deflection: float, fill: float, vx: float, vy: float, tilt: float,
               x: float) -> float:
    """Advance the tangential forces of a tire, brake its wheel by rolling loss; the trail, m."""
    spin, laws = v.qvel[truck.wheel_dof[hub]], truck.laws
    soft = max(0.0, 1.0 - fill)
    rolling = truck.radius_m - deflection * (0.333 - 0.17 * min(1.0, soft))
    rim = min(1.0, max(0.0, (deflection - (truck.radius_m - laws.rim_radius_m)) / 0.028))
    flat = min(1.0, laws.flat_keeps + sw.flat_cornering)
    kept = 1.0 - rim * rim * (3.0 - 2.0 * rim) * (1.0 - flat)
    slope = cornering_slope(load, fill, laws) * truck.cornering[hub // 2] * kept
    roll_speed = abs(spin) * rolling + 0.3
    sx, sy = (rolling * spin - vx) / roll_speed, -vy / roll_speed
    grip = friction_at(x, sw) * (1.0 - laws.flat_grip_lost * rim)
    peak = (1.0 - sw.saturation[hub // 2] * (0.6 + 0.4 * load / 27.0e3)) * (0.4 + 0.6 * kept)
    fx, fy, trail = steady_forces(load, sx, sy, slope, grip, peak, laws)
    fy += laws.camber * load * (truck.camber_rad[hub] - tilt) * (1.0 - 0.7 * rim)
    travel = roll_speed * dt
    stretch = relaxation_length(load, slope, sy, laws)
    if sw.relaxation_even:
        stretch *= 1.0 + sw.relaxation
    else:
        stretch *= 1.0 + sw.relaxation * (0.5 + 0.5 * load / 18.0e3)
    length_x = load * 14.0 / 900.0e3
    state.tire_fx[tire] += (1.0 - math.exp(-travel / max(length_x, 0.05))) * (
        fx - state.tire_fx[tire])
    state.tire_fy[tire] += (1.0 - math.exp(-travel / max(stretch, 0.10))) * (
        fy - state.tire_fy[tire])
    loss = rolling_loss(vx, soft, rim, laws)
    if state.time[0] >= state.blown_at[tire]:
        state.flat_distance[tire] += abs(vx) * dt
        rub = 1.0 - math.exp(-state.flat_distance[tire] / 4.0)
        if sw.flat_drag_even:
            loss += sw.flat_drag * rim
        else:
            loss += sw.flat_drag * rim * rub * (0.75 + 0.25 * math.tanh(vx / 12.0)) * (
                load / 25.0e3) ** 0.2
    v.qfrc[truck.wheel_dof[hub]] -= loss * load * rolling * math.tanh(spin / 0.5)
    # A belt passes on power without loss: its lever is the rolling radius, not the hub's height.
    twist = state.tire_fx[tire] * (rolling - (truck.radius_m - deflection))
    for i in range(3):
        v.xfrc[truck.wheel[hub], 3 + i] -= twist * v.xmat[truck.carrier[hub], 3 * i + 1]
    swell = 1.0 + 0.55 * soft * (1.0 - rim) - 0.5 * rim
    share = load / 27.0e3
    full = truck.radius_m * load / 27.0e3 * (laws.trail - laws.trail_drop * share)
    return full * swell * trail


@compiled
def rolling_loss(speed: float, soft: float, rim: float, laws: Laws) -> float:
    """Rolling resistance over load: grows with speed squared and lost air; its own on the rim."""
    good = laws.rolling + laws.rolling_rise * speed * speed
    flat = laws.flat_drag
    if laws.flat_drag_exponent != 0.0:
        flat *= (max(abs(speed), 1.0) / 20.0) ** laws.flat_drag_exponent
    return good * (1.0 + laws.rolling_soft * soft) * (1.0 - rim) + flat * rim
