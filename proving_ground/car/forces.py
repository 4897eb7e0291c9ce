"""What acts on the car beyond the foreign model: brakes, driveline, air, slopes, the steering gear.

`now` holds time, throttle, steering rate, grade, bank and drag area; `own` two steering filters,
the pressures of both brake lines, the heat of both axles, the phase of the wake.
"""

from __future__ import annotations

import math

from proving_ground.car.acts import Acts
from proving_ground.car.foreign import Numbers, njit
from proving_ground.car.individual import POWER_W, RATIO
from proving_ground.layout import FloatArray

STEP_S = 1.0e-3
AIR_DENSITY, SIDE_AREA_M2 = 1.18, 3.9
PA_PER_MPS2 = 2.0e5                # brake pressure of a deceleration: 2 bar a m/s2
LINE_LAG_S = 0.02
GOVERNOR = 0.05                    # of top speed: from there on the engine cuts out
GRAVITY_MPS2 = 9.81


@njit
def engine(x: FloatArray, p: Numbers, throttle: float) -> float:
    """Acceleration that the engine gives, m/s2; no more where it turns as fast as at top speed."""
    top = p.longitudinal.v_max
    tread = 0.5 * (x[25] + x[26]) * p.R_w
    left = min(1.0, max(0.0, (1.0 + GOVERNOR - tread / top) / GOVERNOR))
    return left * throttle * POWER_W / max(x[3], 3.0) / p.m


@njit
def slope(x: FloatArray, p: Numbers, acts: Acts, now: FloatArray) -> None:
    """Grade and bank where the front axle is: a cosine ramp."""
    s = (x[0] + p.a - acts.slope_x_m) / acts.slope_length_m
    ease = 0.0 if s <= 0.0 else 0.5 * (1.0 - math.cos(math.pi * min(1.0, s)))
    now[3], now[4] = acts.grade * ease, acts.bank * ease


@njit
def road_wheel(own: FloatArray, acts: Acts, hand: float) -> float:
    """Road-wheel angle, positive left, that the gear gives for a hand-wheel angle, rad."""
    bend = acts.ratio_bend * (1.0 - math.exp(-(hand / 0.7) ** 2))
    wanted = hand / RATIO * (1.0 + acts.ratio_error + bend)
    if acts.steer_lag_s <= 0.0:
        return wanted
    share = 1.0 - math.exp(-acts.steer_lag_stages * STEP_S / acts.steer_lag_s)
    own[0] += share * (wanted - own[0])
    own[1] += share * ((own[0] if acts.steer_lag_stages == 2 else wanted) - own[1])
    reached: float = own[1]
    return reached


@njit
def lines(x: FloatArray, own: FloatArray, p: Numbers, acts: Acts, command: FloatArray) -> None:
    """Pressure at the wheels behind the command, heat of the brakes, phase of the wake."""
    for end in range(2):
        lag = LINE_LAG_S + acts.brake_lag_s[end]
        own[2 + end] += STEP_S / lag * (command[2 + end] - own[2 + end])
        power = own[2 + end] / PA_PER_MPS2 * p.m * x[3] * 0.5
        own[4 + end] += STEP_S * (power - own[4 + end] / 40.0)
    own[6] += STEP_S * 2.0 * math.pi * 0.12 * x[3] / 1.4


@njit
def wheels(f: FloatArray, x: FloatArray, own: FloatArray, p: Numbers, acts: Acts,
           now: FloatArray, scale: FloatArray) -> None:
    """Torques on the wheels: brakes, a bearing that seizes, a retarder, a swinging engine."""
    for k in range(4):
        end = k // 2
        share = p.T_sb if end == 0 else 1.0 - p.T_sb
        fade = 1.0 - acts.fade[end] * (1.0 - math.exp(-own[4 + end] / 2.0e5))
        torque = 0.5 * share * p.m * p.R_w * own[2 + end] / PA_PER_MPS2 * scale[k]
        torque *= acts.brake_gain[k] * fade
        if k == acts.drag_wheel:
            torque += acts.drag_nm
        f[23 + k] -= torque * math.tanh(x[23 + k] / 0.5) / p.I_y_w
    force = 0.0
    if now[1] < 0.05:
        force = acts.retarder_n * (1.0 - now[1] / 0.05)
        if acts.retarder_at_mps > 0.0:
            force *= math.tanh((x[3] / acts.retarder_at_mps) ** 2)
    force -= acts.shuffle_n * math.sin(2.0 * math.pi * acts.shuffle_hz * now[0])
    for k in (25, 26):
        f[k] -= 0.5 * force * p.R_w / p.I_y_w


@njit
def outside(f: FloatArray, x: FloatArray, own: FloatArray, p: Numbers, acts: Acts,
            now: FloatArray) -> None:
    """Air and slopes. The foreign frame has y to the right and yaw to the right.

    A slope is a plane of the map, as the angles of `channels.py` have it: what rises along the
    course before a turn rises across it after.
    """
    speed = max(x[3], 0.5)
    extra = acts.drag_area * (speed / 25.0) ** (acts.drag_exponent - 2.0)
    corner = acts.corner_n * (speed / 25.0) ** 2
    drag = 0.5 * AIR_DENSITY * speed * speed * (now[5] + extra) + corner
    cos_yaw, sin_yaw = math.cos(x[4]), -math.sin(x[4])
    along = now[3] * cos_yaw + now[4] * sin_yaw
    across = now[4] * cos_yaw - now[3] * sin_yaw
    f[3] -= drag / p.m + GRAVITY_MPS2 * math.sin(along)
    f[5] -= 0.7 * corner / p.I_z
    for k in (10, 15, 20):
        f[k] += GRAVITY_MPS2 * math.sin(across)
    push = 0.0
    s = (now[0] - acts.gust_s) / acts.gust_length_s
    if 0.0 < s < 1.0:
        share = 0.5 * (1.0 - math.cos(2.0 * math.pi * s))
        if acts.gust_steady:
            share = min(1.0, s / 0.1, (1.0 - s) / 0.1)
        wind = acts.gust_mps * share
        air = 0.5 * AIR_DENSITY * SIDE_AREA_M2 * (speed * speed + wind * wind)
        push = air * math.sin(math.atan2(wind, speed))
        f[5] -= 0.25 * push / p.I_z
    swing = acts.wake_n * (speed / 25.0) ** 2 * math.sin(own[6])
    f[5] += 1.6 * swing / p.I_z
    f[10] -= (push + swing) / p.m_s
