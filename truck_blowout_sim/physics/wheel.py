"""A hub with its tires: where they stand and how they move, what they make, how the hub spins.

Duals share the hub's spin and position but each carries load by its own radius, so the survivor
takes over from a blown partner that hangs clear. Between `place_tires` and `collect_tires` the pass
of `tires.tire` runs over all tires of the truck.

References: docs/physics.md, "Wheels and contact": loaded radius for shape, rolling for spin.
Known limits: contact straight below the wheel centre; small tilt; the damper of a tire knows the
rate of its wheel, not that of the unevenness that it rolls over.
Validated with: test/physics/test_wheel.py (free rolling, dual sharing, sum of loads, on the rim).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics import brakes, driveline, road
from truck_blowout_sim.physics.choose import any_of, pick, shared, trucks_in, where
from truck_blowout_sim.physics.jit import core
from truck_blowout_sim.physics.layout import (
    AXLE,
    AXLE_S,
    GLOBAL_S,
    HUB,
    HUB_S,
    STEP_COLUMNS,
    TIRE,
    TIRE_S,
    TOPOLOGY,
)
from truck_blowout_sim.physics.places import tire_params, tire_state
from truck_blowout_sim.physics.tires import blowout, gas
from truck_blowout_sim.physics.tires.lanes import LANE, lane_offset
from truck_blowout_sim.physics.tires.tire import STANDSTILL_MPS, standstill_damping_spm
from truck_blowout_sim.physics.trig import turned

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
_STIFFNESS, _CORNERING, _ALIGNING, _ROLLING, _ROLLING_SPM = (
    STEP_COLUMNS.index(name) for name in ("stiffness_npm", "cornering_scale", "aligning_scale",
                                          "rolling_0", "rolling_spm"))
_RADIUS = STEP_COLUMNS.index("radius_m")


@core
def place_tires(x: Floats, s: int, p: Floats, h: int, a: int, axle_s: int, topo: Integers,
                first: int, count: int, steer_rad: float,
                place: tuple[float, float, float, float],
                motion: tuple[float, float, float], lanes: Floats, dt: float) -> None:
    """Fill the lanes of a hub's tires and let their air go.

    ``place``: map x, y of the axle's roll centre, cosine and sine of heading. ``motion``: forward
    and lateral velocity at the contact line of the axle's middle, yaw rate.
    """
    cd, sd = turned(steer_rad)
    sin_camber = turned(p[h + HUB.camber_rad] - x[axle_s + AXLE_S.roll_rad])[1]
    x[s + HUB_S.steer_rad] = steer_rad
    for k in range(first, first + count):
        ts = tire_state(topo, k)
        t, w = tire_params(topo, k), lane_offset(k)
        arm = p[h + HUB.y_m] + p[t + TIRE.y_m]
        vx, vy = motion[0] - motion[2] * arm, motion[1]
        at_x, at_y = place[0] - place[3] * arm, place[1] + place[2] * arm
        lanes[w + LANE.vx_mps] = vx * cd + vy * sd
        lanes[w + LANE.vy_mps] = vy * cd - vx * sd
        lanes[w + LANE.spin_radps] = x[s + HUB_S.spin_radps]
        above = x[axle_s + AXLE_S.z_m] + arm * x[axle_s + AXLE_S.roll_rad] - road.height(
            p, at_x, at_y)
        lanes[w + LANE.above_m] = above
        lanes[w + LANE.sink_mps] = -(x[axle_s + AXLE_S.vz_mps]
                                     + arm * x[axle_s + AXLE_S.roll_rate_radps])
        lanes[w + LANE.sin_camber] = sin_camber
        lanes[w + LANE.friction] = road.friction(
            p, x[GLOBAL_S.time_s], x[GLOBAL_S.over_m] - p[a + AXLE.behind_m], at_x, at_y)
        lanes[w + LANE.axle_peak] = p[a + AXLE.peak_scale]
        lanes[w + LANE.arm_m] = arm
        lanes[w + LANE.cos_steer], lanes[w + LANE.sin_steer] = cd, sd
        lanes[w + LANE.slip] = x[ts + TIRE_S.slip]
        lanes[w + LANE.slip_tan] = x[ts + TIRE_S.slip_tan]
        lanes[w + LANE.damping_spm] = 0.0
        if any_of(abs(lanes[w + LANE.vx_mps]) < STANDSTILL_MPS):
            lanes[w + LANE.damping_spm] = standstill_damping_spm(
                p, t, lanes[w + LANE.vx_mps], x[ts + TIRE_S.fz_n],
                p[h + HUB.spin_inertia_kgm2] / count, dt)
        inflate(x, ts, p, t, topo[TOPOLOGY.table_at], above, lanes, w, dt)


@core
def inflate(x: Floats, s: int, p: Floats, t: int, table_at: int, above_m: float, lanes: Floats,
            w: int, dt: float) -> None:
    """Air and law of one tire: what the pass over all tires cannot do without branches."""
    stepped = shared(p[t + TIRE.law]) > 0.0
    lanes[w + LANE.stepped] = where(stepped, 1.0, 0.0)
    if stepped:
        row = blowout.step_row(x, s, p, table_at + int(shared(p[t + TIRE.table])))
        lanes[w + LANE.row_radius_m] = pick(p, row + _RADIUS)
        stiffness = pick(p, row + _STIFFNESS)
        lanes[w + LANE.row_free_m] = blowout.free_radius_m(p, t, lanes[w + LANE.row_radius_m],
                                                           stiffness)
        lanes[w + LANE.row_stiffness_npm] = stiffness
        lanes[w + LANE.row_cornering] = pick(p, row + _CORNERING)
        lanes[w + LANE.row_aligning] = pick(p, row + _ALIGNING)
        speed = abs(lanes[w + LANE.vx_mps])
        lanes[w + LANE.row_rolling] = pick(p, row + _ROLLING) + pick(p, row + _ROLLING_SPM) * speed
    elif trucks_in(lanes) == 1:
        # nothing branches there: denormal numbers would make arithmetic take three times as long
        lanes[w + LANE.row_radius_m], lanes[w + LANE.row_free_m] = 0.0, 0.0
        lanes[w + LANE.row_stiffness_npm] = 1.0
        lanes[w + LANE.row_cornering], lanes[w + LANE.row_aligning] = 1.0, 1.0
        lanes[w + LANE.row_rolling] = 0.0
    leaking, gauge = gas.leaks(x, s, p, t), x[s + TIRE_S.pressure_pa]
    if any_of(leaking):
        rim = where(stepped, 0.0, blowout.rim_fraction(p, t, above_m))
        gas.advance_pressure(x, s, p, t, rim, dt)
        x[s + TIRE_S.pressure_pa] = where(leaking, x[s + TIRE_S.pressure_pa], gauge)
    lanes[w + LANE.pressure_pa] = x[s + TIRE_S.pressure_pa]
    lanes[w + LANE.softness] = blowout.softness(p, t, x[s + TIRE_S.pressure_pa])


@core
def collect_tires(x: Floats, s: int, p: Floats, h: int, topo: Integers, first: int, count: int,
                  circuit: int, drive: tuple[float, float, float], lanes: Floats, dt: float
                  ) -> tuple[float, float, float, float, float, float, float]:
    """Keep what a hub's tires made, and advance its spin.

    Returns, in heading axes about the axle's middle at the ground: fx, fy, fz [N], roll moment of
    the vertical forces, pitch couple, yaw moment [N m]; last the loaded radius [m].
    """
    spin = x[s + HUB_S.spin_radps]
    fx_sum, fy_sum, fz_sum, mx, my, mz_sum = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    torque, radius, above = 0.0, 0.0, 0.0
    for k in range(first, first + count):
        ts, w = tire_state(topo, k), lane_offset(k)
        fx, fy, fz = lanes[w + LANE.fx_n], lanes[w + LANE.fy_n], lanes[w + LANE.fz_n]
        mz, rolling = lanes[w + LANE.mz_nm], lanes[w + LANE.rolling_nm]
        arm, above = lanes[w + LANE.arm_m], lanes[w + LANE.above_m]
        radius = lanes[w + LANE.radius_m]
        cd, sd = lanes[w + LANE.cos_steer], lanes[w + LANE.sin_steer]
        hub_nm = -fx * radius - rolling
        gx, gy = fx * cd - fy * sd, fx * sd + fy * cd
        fx_sum, fy_sum, fz_sum = fx_sum + gx, fy_sum + gy, fz_sum + fz
        mx += arm * fz
        my += fx * above + hub_nm
        mz_sum += mz - arm * gx
        torque += hub_nm
        x[ts + TIRE_S.slip] = lanes[w + LANE.slip]
        x[ts + TIRE_S.slip_tan] = lanes[w + LANE.slip_tan]
        x[ts + TIRE_S.rim] = lanes[w + LANE.rim]
        x[ts + TIRE_S.fx_n], x[ts + TIRE_S.fy_n], x[ts + TIRE_S.fz_n] = fx, fy, fz
        x[ts + TIRE_S.mz_nm], x[ts + TIRE_S.rolling_nm] = mz, rolling
        x[ts + TIRE_S.loaded_radius_m] = above
    inertia = p[h + HUB.spin_inertia_kgm2]
    brake_nm = brakes.torque_nm(x, s, p, h, circuit)
    share, drive_nm = p[h + HUB.drive_share], 0.0
    if any_of(share != 0.0):
        force = driveline.hub_force_n(p, share, drive, spin, radius, inertia, dt)
        x[GLOBAL_S.drive_force_n] += force
        drive_nm = force * radius
        x[s + HUB_S.drive_nm] = drive_nm
    brakes.advance_spin(x, s, inertia, torque + drive_nm, brake_nm, dt)
    my -= inertia * (x[s + HUB_S.spin_radps] - spin) / dt
    return fx_sum, fy_sum, fz_sum, mx, my, mz_sum, above
