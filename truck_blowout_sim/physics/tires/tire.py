"""One tire: slip lag, force, moment, at whatever state of inflation.

References: Pacejka, Tire and Vehicle Dynamics, chapter 5; `string`, `blowout`.
Known limits: camber thrust without lag, none on map tires; a standing tire has no trail.
Validated with: test/physics/test_tire.py (steady state, relaxation length, standing spring, flat,
trail in reverse).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics.jit import core
from truck_blowout_sim.physics.layout import TIRE, TIRE_S
from truck_blowout_sim.physics.scalar import clip
from truck_blowout_sim.physics.tires import blowout, linear, lookup_map, magic_formula
from truck_blowout_sim.physics.tires.string import kept_share, lag
from truck_blowout_sim.physics.trig import turned

Floats = NDArray[np.float64]
_STANDSTILL_MPS = 0.5  # below it the string gets a damper, so that a standing truck does not ring


@core
def tire_forces(x: Floats, s: int, p: Floats, t: int, table_at: int, fz_n: float, rim: float,
                step: int, vx_mps: float, vy_mps: float, roll_mps: float, camber_rad: float,
                friction: float, axle_peak: float, dt: float) -> tuple[float, float, float]:
    """Advance the slip lag by ``dt`` and return fx, fy [N] and mz [N m] in wheel axes.

    ``vx_mps, vy_mps``: contact point in wheel axes; ``roll_mps``: spin times rolling radius.
    """
    inflation = x[s + TIRE_S.pressure_pa] / p[t + TIRE.reference_pressure_pa]
    model = int(p[t + TIRE.model])
    if model == 2:
        cornering = p[t + TIRE.linear_cornering_nprad] * p[t + TIRE.cornering_scale]
        peak_x = linear.limit_n(p, t, fz_n, friction, axle_peak)
        peak_y, slope_x = peak_x, p[t + TIRE.linear_slip_n]
    else:
        cornering = magic_formula.cornering_stiffness_nprad(p, t, fz_n, inflation)
        peak_x, peak_y, slope_x = magic_formula.limits(p, t, fz_n, friction, axle_peak)
    soft = max(rim, blowout.collapse(p, t, inflation))
    flat = 1.0 - soft * (1.0 - p[t + TIRE.flat_cornering] * p[t + TIRE.flat_cornering_scale])
    length_y = cornering / p[t + TIRE.lateral_stiffness_npm]
    length_y = max(length_y + rim * (p[t + TIRE.flat_relaxation_m] - length_y), 0.02)
    length_y *= p[t + TIRE.relaxation_scale]
    stiffness_x = fz_n * p[t + TIRE.slip_stiffness]
    length_x = max(stiffness_x / p[t + TIRE.longitudinal_stiffness_npm], 0.05)
    slip = clip(lag(x[s + TIRE_S.slip], vx_mps, roll_mps - vx_mps, length_x, dt), -1.0, 1.0)
    tan = clip(lag(x[s + TIRE_S.slip_tan], vx_mps, -vy_mps, length_y, dt), -3.0, 3.0)
    if peak_x > 0.0:
        kept = kept_share(slip, tan, slope_x / peak_x, cornering / peak_y, roll_mps - vx_mps,
                          -vy_mps, vx_mps)
        slip, tan = kept * slip, kept * tan
    x[s + TIRE_S.slip] = slip
    x[s + TIRE_S.slip_tan] = tan
    if fz_n <= 0.0:
        return 0.0, 0.0, 0.0
    if abs(vx_mps) < _STANDSTILL_MPS:
        rest = 1.0 - abs(vx_mps) / _STANDSTILL_MPS
        slip = clip(slip + 0.2 * rest * (roll_mps - vx_mps), -1.0, 1.0)
        tan = clip(tan - 0.2 * rest * vy_mps, -3.0, 3.0)
    # the contact trails behind the wheel: on the other side of it in reverse
    ahead = clip(vx_mps / _STANDSTILL_MPS, -1.0, 1.0)
    if model == 1:
        scale_y = p[step + 3] if step >= 0 else flat
        scale_m = p[step + 4] if step >= 0 else 1.0 - rim * (1.0 - p[t + TIRE.flat_trail])
        scale_m *= ahead
        return lookup_map.forces(p, t, table_at + int(p[t + TIRE.map_table]), fz_n, slip, tan,
                                 friction, axle_peak, scale_y, scale_m)
    if model == 2:
        fx, fy, mz = linear.forces(p, t, fz_n, slip, tan, friction, axle_peak, cornering)
    else:
        fx, fy, mz = magic_formula.forces(p, t, fz_n, inflation, slip, tan, friction, axle_peak,
                                          cornering)
    mz *= ahead
    if step >= 0:
        flat = p[step + 3]
        mz *= p[step + 4]
    else:
        mz *= 1.0 - soft * (1.0 - p[t + TIRE.flat_trail])
    camber = p[t + TIRE.camber_gain] * (1.0 - soft * (1.0 - p[t + TIRE.flat_camber]))
    limit = p[t + TIRE.peak_y] * fz_n * friction * p[t + TIRE.friction_scale]
    return fx, clip(fy * flat + camber * fz_n * turned(camber_rad)[1], -limit, limit), mz
