"""A hub with its tires: loads, slips, forces, spin.

Duals share the hub's spin and position but each carries load by its own radius, so the survivor
takes over from a blown partner that hangs clear.

References: docs/physics.md, "Wheels and contact": loaded radius for shape, rolling for spin.
Known limits: contact straight below the wheel centre; small tilt.
Validated with: test/physics/test_wheel.py (free rolling, dual sharing, sum of loads, on the rim).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics import brakes, road
from truck_blowout_sim.physics.jit import core
from truck_blowout_sim.physics.layout import AXLE_S, HUB, HUB_S, TIRE, TIRE_S
from truck_blowout_sim.physics.scalar import clip
from truck_blowout_sim.physics.tires import blowout, gas
from truck_blowout_sim.physics.tires.tire import tire_forces
from truck_blowout_sim.physics.trig import turned

Floats = NDArray[np.float64]
_STILL_RADPS = 0.5  # rolling resistance fades below this spin


@core
def tire_wrench(x: Floats, s: int, p: Floats, t: int, table_at: int, axle_s: int, arm_m: float,
                place: tuple[float, float, float], velocity: tuple[float, float],
                spin_radps: float, camber_rad: float, axle_peak: float, dt: float
                ) -> tuple[float, float]:
    """Forces of one tire, stored in its state; returns rolling radius [m] and hub torque [N m].

    ``arm_m``: lateral place on the axle; ``place``: map x, y of the contact and time;
    ``velocity``: contact point in wheel axes.
    """
    ground = road.height(p, place[0], place[1])
    above = x[axle_s + AXLE_S.z_m] + arm_m * x[axle_s + AXLE_S.roll_rad] - ground
    sink = -(x[axle_s + AXLE_S.vz_mps] + arm_m * x[axle_s + AXLE_S.roll_rate_radps])
    step = -1
    if p[t + TIRE.law] > 0.0:
        step = blowout.step_row(x, s, p, table_at + int(p[t + TIRE.table]))
    rim = blowout.rim_fraction(p, t, above) if step < 0 else 0.0
    gas.advance_pressure(x, s, p, t, rim, dt)
    x[s + TIRE_S.rim] = rim
    fz, deflection = blowout.vertical_load(x, s, p, t, above, sink, step)
    radius = blowout.rolling_radius_m(p, t, deflection, rim, step)
    mu = road.friction(p, place[2], place[0], place[1])
    fx, fy, mz = tire_forces(x, s, p, t, table_at, fz, rim, step, velocity[0], velocity[1],
                             spin_radps * radius, camber_rad, mu, axle_peak, dt)
    inflation = x[s + TIRE_S.pressure_pa] / p[t + TIRE.reference_pressure_pa]
    f = blowout.rolling_coefficient(p, t, inflation, deflection, rim, abs(velocity[0]), step)
    rolling = f * fz * radius * clip(spin_radps / _STILL_RADPS, -1.0, 1.0)
    x[s + TIRE_S.fx_n], x[s + TIRE_S.fy_n], x[s + TIRE_S.fz_n] = fx, fy, fz
    x[s + TIRE_S.mz_nm], x[s + TIRE_S.rolling_nm] = mz, rolling
    x[s + TIRE_S.loaded_radius_m] = above
    return radius, -fx * radius - rolling


@core
def hub_step(x: Floats, s: int, p: Floats, h: int, tire_s: int, t: int, n_tires: int, n_state: int,
             n_param: int, table_at: int, axle_s: int, steer_rad: float,
             place: tuple[float, float, float, float, float],
             motion: tuple[float, float, float], axle_peak: float, circuit: int, drive_n: float,
             dt: float) -> tuple[float, float, float, float, float, float, float]:
    """All tires of one hub and its spin for one step.

    ``place``: map x, y of the axle's roll centre, cosine and sine of heading, time.
    ``motion``: forward and lateral velocity at the contact line of the axle's middle, yaw rate.
    Returns, in heading axes about the axle's middle at the ground: fx, fy, fz [N], roll moment of
    the vertical forces, pitch couple, yaw moment [N m]; last the loaded radius [m].
    """
    cd, sd = turned(steer_rad)
    camber = p[h + HUB.camber_rad] - x[axle_s + AXLE_S.roll_rad]
    spin = x[s + HUB_S.spin_radps]
    fx_sum, fy_sum, fz_sum, mx, my, mz_sum = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    torque, radius, above = 0.0, 0.0, 0.0
    for k in range(n_tires):
        ts, tp = tire_s + k * n_state, t + k * n_param
        arm = p[h + HUB.y_m] + p[tp + TIRE.y_m]
        vx, vy = motion[0] - motion[2] * arm, motion[1]
        contact = (place[0] - place[3] * arm, place[1] + place[2] * arm, place[4])
        radius, hub_nm = tire_wrench(x, ts, p, tp, table_at, axle_s, arm, contact,
                                     (vx * cd + vy * sd, vy * cd - vx * sd), spin, camber,
                                     axle_peak, dt)
        fx, fy, fz = x[ts + TIRE_S.fx_n], x[ts + TIRE_S.fy_n], x[ts + TIRE_S.fz_n]
        above = x[ts + TIRE_S.loaded_radius_m]
        gx, gy = fx * cd - fy * sd, fx * sd + fy * cd
        fx_sum, fy_sum, fz_sum = fx_sum + gx, fy_sum + gy, fz_sum + fz
        mx += arm * fz
        my += fx * above + hub_nm
        mz_sum += x[ts + TIRE_S.mz_nm] - arm * gx
        torque += hub_nm
    x[s + HUB_S.steer_rad] = steer_rad
    drive_nm = drive_n * p[h + HUB.drive_share] * radius
    inertia = p[h + HUB.spin_inertia_kgm2]
    brake_nm = brakes.torque_nm(x, s, p, h, circuit)
    brakes.advance_spin(x, s, inertia, torque + drive_nm, brake_nm, dt)
    my -= inertia * (x[s + HUB_S.spin_radps] - spin) / dt
    return fx_sum, fy_sum, fz_sum, mx, my, mz_sum, above
