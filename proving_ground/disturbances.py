"""Concealed effects that act from outside the truck or move its load."""

from __future__ import annotations

import math

from proving_ground.compiled import compiled
from proving_ground.contact import add_force
from proving_ground.layout import State, Truck, Views
from proving_ground.switches import Switches


@compiled
def slope(v: Views, sw: Switches, gravity: float, x: float) -> None:
    """Tilt gravity as a grade or bank would, eased in over its length."""
    ease = slope_share(x, sw)
    along, across = sw.grade * ease, sw.bank * ease
    v.gravity[0] = -gravity * math.sin(along)
    v.gravity[1] = -gravity * math.sin(across)
    v.gravity[2] = -gravity * math.cos(along) * math.cos(across)


@compiled
def slope_share(x: float, sw: Switches) -> float:
    """How much of the slope is reached at x: a cosine ramp."""
    s = (x - sw.slope_x_m) / sw.slope_length_m
    if s <= 0.0:
        return 0.0
    return 0.5 * (1.0 - math.cos(math.pi * min(1.0, s)))


@compiled
def gust(v: Views, truck: Truck, state: State, sw: Switches, speed: float) -> None:
    """A 1-cos gust from the right: side force from the air's true angle on the side area."""
    s = (state.time[0] - sw.gust_s) / sw.gust_length_s
    if s <= 0.0 or s >= 1.0:
        return
    if sw.gust_steady:
        wind = sw.gust_mps * min(1.0, s / 0.1, (1.0 - s) / 0.1)
    else:
        wind = sw.gust_mps * 0.5 * (1.0 - math.cos(2.0 * math.pi * s))
    angle = math.atan2(wind, speed)
    area = 9.0 if sw.gust_body == 0 else 22.0
    force = 0.5 * truck.air_density * area * (speed * speed + wind * wind) * 1.1 * math.sin(angle)
    side_force(v, truck.units[2 * sw.gust_body], force, sw.gust_x_m, 1.7)


@compiled
def side_force(v: Views, body: int, force: float, behind: float, height: float) -> None:
    """A force along the body's lateral axis, `behind` its frame origin and at a height, N, m."""
    cx, sx = v.xmat[body, 0], v.xmat[body, 3]
    add_force(v, body, -force * sx, force * cx, 0.0,
              v.xpos[body, 0] - behind * cx, v.xpos[body, 1] - behind * sx, height)


@compiled
def payload(v: Views, truck: Truck, state: State, sw: Switches) -> None:
    """The rear block slides aside: accelerates for 40 % of the time, then brakes to a stop."""
    s = (state.time[0] - sw.shift_s) / sw.shift_length_s
    if sw.shift_m == 0.0 or s <= 0.0:
        return
    place, rate = 1.0, 0.0
    if s < 0.4:
        place, rate = s * s / 0.4, 2.0 * s / 0.4
    elif s < 1.0:
        place, rate = 1.0 - (1.0 - s) ** 2 / 0.6, 2.0 * (1.0 - s) / 0.6
    pull = truck.lashing[0] * place + truck.lashing[1] * rate / sw.shift_length_s
    v.qfrc[truck.payload[1]] += sw.shift_m * pull


@compiled
def unlisted(v: Views, truck: Truck, state: State, sw: Switches, speed: float,
             dt: float) -> None:
    """Effects that no list of names holds."""
    rear = truck.units[3]
    pressure = 0.5 * truck.air_density * speed * speed
    if sw.wake != 0.0:
        state.extra[0] += dt * 2.0 * math.pi * 0.09 * speed / 2.6
        swell = 1.0 + 0.4 * math.sin(0.31 * state.extra[0])
        side_force(v, rear, sw.wake * pressure * 10.0 * swell * math.sin(state.extra[0]),
                   12.0, 1.8)
    if sw.chute_area != 0.0:
        cx, sx = v.xmat[rear, 0], v.xmat[rear, 3]
        force = sw.chute_area * pressure
        add_force(v, rear, -force * cx, -force * sx, 0.0,
                  v.xpos[rear, 0] - 12.5 * cx - sw.chute_y_m * sx,
                  v.xpos[rear, 1] - 12.5 * sx + sw.chute_y_m * cx, 1.0)
    if sw.slosh[0] > 0.0:
        slosh(v, truck, state, sw, dt)
    if sw.flap_hub >= 0:
        flap(v, truck, sw)
    if sw.rut != 0.0:
        rut(v, truck, state, sw)
    if sw.bearing_hub >= 0:
        spin = v.qvel[truck.wheel_dof[sw.bearing_hub]]
        drag = sw.bearing_nm * (1.0 + 0.3 * math.sin(0.9 * state.time[0]))
        v.qfrc[truck.wheel_dof[sw.bearing_hub]] -= drag * math.tanh(spin / 0.5)


@compiled
def slosh(v: Views, truck: Truck, state: State, sw: Switches, dt: float) -> None:
    """A liquid that swings across the trailer; its relative motion pushes the deck, 1.8 m up."""
    rear = truck.units[3]
    mass, natural, damping = sw.slosh[0], sw.slosh[1], sw.slosh[2]
    # Lateral specific force of the trailer, smoothed: the liquid does not feel the deck's shudder.
    state.extra[5] += dt / 0.04 * (v.sensors[30] - state.extra[5])
    drive = state.extra[5]
    y, rate = state.extra[2], state.extra[3]
    accel = -drive - natural * natural * y * (1.0 + 0.5 * y * y) - 2.0 * damping * natural * rate
    state.extra[3] += dt * accel
    state.extra[2] += dt * state.extra[3]
    side_force(v, rear, -mass * accel, 9.0, 1.8)
    v.xfrc[rear, 3] -= mass * 9.81 * y * v.xmat[rear, 0]
    v.xfrc[rear, 4] -= mass * 9.81 * y * v.xmat[rear, 3]


@compiled
def flap(v: Views, truck: Truck, sw: Switches) -> None:
    """A loose tread strikes the road once a turn: a half-sine blow over a sixth of the turn."""
    hub = sw.flap_hub
    turn = (v.qpos[truck.wheel_qpos[hub]] / (2.0 * math.pi)) % 1.0
    if turn < 1.0 / 6.0:
        blow = sw.flap_n * math.sin(6.0 * math.pi * turn)
        wheel = truck.wheel[hub]
        carrier = truck.carrier[hub]
        fx, fy = v.xmat[carrier, 4], -v.xmat[carrier, 1]
        add_force(v, wheel, -0.5 * blow * fx, -0.5 * blow * fy, blow,
                  v.xpos[wheel, 0], v.xpos[wheel, 1], v.xpos[wheel, 2] - 0.1)


@compiled
def rut(v: Views, truck: Truck, state: State, sw: Switches) -> None:
    """Worn wheel tracks guide the tires sideways, in a wave over their lateral place."""
    tire = 0
    for hub in range(10):
        wheel = truck.wheel[hub]
        load = 0.0
        for _ in range(truck.duals[hub // 2]):
            load += state.tire_fz[tire]
            tire += 1
        wave = math.sin(2.0 * math.pi * (v.xpos[wheel, 1] / sw.rut_wave_m))
        add_force(v, wheel, 0.0, -sw.rut * load * wave, 0.0,
                  v.xpos[wheel, 0], v.xpos[wheel, 1], 0.0)
