"""Air in a tire and its way out through a hole.

References: Andreatta, Bixel, Guenther 2007 (assumptions via thesis L333-L335): one orifice, choked
then subsonic; St Venant-Wantzel flow function.
Known limits: one temperature, polytropic with a fixed exponent; a hole opens at once, or evenly.
Validated with: test/physics/test_gas.py (closed forms: choked isothermal and adiabatic, end of
choking, subsonic isothermal, finite total time, a hole that opens).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics.choose import power_where, where
from truck_blowout_sim.physics.jit import core
from truck_blowout_sim.physics.layout import TIRE, TIRE_S, WORLD, WORLD_AT
from truck_blowout_sim.physics.scalar import reached

Floats = NDArray[np.float64]
GAMMA = 1.4  # ratio of specific heats of air
GAS_CONSTANT_JPKGK = 287.05  # of dry air
CRITICAL_RATIO = (2.0 / (GAMMA + 1.0)) ** (GAMMA / (GAMMA - 1.0))
CHOKED = math.sqrt(GAMMA) * (2.0 / (GAMMA + 1.0)) ** ((GAMMA + 1.0) / (2.0 * (GAMMA - 1.0)))


@core
def flow_function(ratio: float) -> float:
    """Phi of mdot = CdA p / sqrt(R T) Phi, ``ratio`` = ambient / tire pressure, absolute."""
    subsonic = (ratio > CRITICAL_RATIO) & (ratio < 1.0)
    a = power_where(subsonic, ratio, 2.0 / GAMMA)
    b = power_where(subsonic, ratio, (GAMMA - 1.0) / GAMMA)
    flow = math.sqrt(2.0 * GAMMA / (GAMMA - 1.0) * a * abs(1.0 - b))
    return where(ratio <= CRITICAL_RATIO, CHOKED, where(ratio >= 1.0, 0.0, flow))


@core
def pressure_rate_paps(p_abs_pa: float, p0_abs_pa: float, ambient_pa: float, temperature_k: float,
                       volume_m3: float, hole_m2: float, exponent: float) -> float:
    """dp/dt [Pa/s] at constant volume; ``exponent`` 1 isothermal … 1.4 adiabatic."""
    share = p_abs_pa / p0_abs_pa
    t = temperature_k * power_where(share != 1.0, share, (exponent - 1.0) / exponent)
    rt = GAS_CONSTANT_JPKGK * t
    mass_flow = hole_m2 * p_abs_pa / math.sqrt(rt) * flow_function(ambient_pa / p_abs_pa)
    return -exponent * rt / volume_m3 * mass_flow


@core
def leaks(x: Floats, s: int, p: Floats, t: int) -> bool:
    """Whether the tire is losing air now; a failure by itself begins here."""
    at = p[t + TIRE.blow_time_s]
    begins = reached(x[0], at) & (x[s + TIRE_S.blown_time_s] == np.inf)
    # not later than now, to which it may be rounded
    x[s + TIRE_S.blown_time_s] = where(begins, min(at, x[0]), x[s + TIRE_S.blown_time_s])
    return (x[s + TIRE_S.blown_time_s] <= x[0]) & (x[s + TIRE_S.pressure_pa] > 0.0)


@core
def advance_pressure(x: Floats, s: int, p: Floats, t: int, rim: float, dt: float) -> None:
    """Let the tire at state ``s`` and parameters ``t`` lose air for ``dt``; ``rim`` is rho now."""
    gauge = x[s + TIRE_S.pressure_pa]
    ambient = p[WORLD_AT + WORLD.air_pressure_pa]
    loss = p[t + TIRE.flat_volume_fraction]
    volume = p[t + TIRE.volume_m3] * (1.0 - loss * rim)
    hole = p[t + TIRE.hole_area_m2] * p[t + TIRE.hole_scale] * where(
        p[t + TIRE.blow_time_s] != np.inf, p[t + TIRE.blow_hole_scale], 1.0)
    opens_s = p[t + TIRE.hole_opening_s]
    since_s = x[0] + dt - x[s + TIRE_S.blown_time_s]  # where this step ends: it never stays shut
    hole *= where(since_s < opens_s, since_s / max(opens_s, dt), 1.0)
    n = p[t + TIRE.polytropic]
    rate = pressure_rate_paps(gauge + ambient, p[t + TIRE.pressure_pa] + ambient, ambient,
                              p[WORLD_AT + WORLD.air_temperature_k], volume, hole, n)
    squeeze = 1.0 + n * loss * (rim - x[s + TIRE_S.rim]) / (1.0 - loss * rim)
    x[s + TIRE_S.pressure_pa] = max((gauge + ambient) * squeeze - ambient + dt * rate, 0.0)
