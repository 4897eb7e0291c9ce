"""A sound tire standing or rolling steadily, in plain numbers: radius, side force, moment.

References: Pacejka, Tire and Vehicle Dynamics; coefficients with their sources in config/tires.
Known limits: set pressure, no camber, no slip along the tire; maps leave the road's friction out.
Validated with: test/vehicle/test_formula.py (the acceptance loads of docs/physics.md).
"""

from __future__ import annotations

from math import atan, cos, sin

from truck_blowout_sim.vehicle.schema.tire import TireSpec


def loaded_radius_m(tire: TireSpec, load_n: float) -> float:
    """Radius of a sound tire under a load, at its set pressure."""
    stiffness = tire.stiffness_npm + tire.stiffness_npmppa * tire.pressure_pa
    return tire.unloaded_radius_m - load_n / stiffness


def inflation(tire: TireSpec) -> float:
    """Set pressure over the pressure the coefficients hold at."""
    return tire.pressure_pa / tire.reference_pressure_pa


def cornering_nprad(tire: TireSpec, load_n: float) -> float:
    """Cornering stiffness: pK1 Fz0 sin(2 atan(Fz / (pK2 Fz0))), both scaled by pressure."""
    q, fz0 = inflation(tire), tire.reference_load_n
    peak = tire.cornering_peak * fz0 * _fades(tire.cornering_floor_1, q)
    at = tire.cornering_load * fz0 * _fades(tire.cornering_floor_2, q)
    return tire.cornering_scale * peak * sin(2.0 * atan(load_n / at))


def lateral_n(tire: TireSpec, slip_rad: float, load_n: float) -> float:
    """Lateral force against a slip angle: D sin(C atan(x - E(x - atan x))), x = K alpha / (C D)."""
    if load_n <= 0.0:
        return 0.0
    d = load_n / tire.reference_load_n - 1.0
    peak = (tire.peak_y - tire.peak_y_load * d) * load_n
    x = cornering_nprad(tire, load_n) * slip_rad / (tire.shape_y * peak)
    return peak * sin(tire.shape_y * atan(x - tire.curvature_y * (x - atan(x))))


def aligning_nm(tire: TireSpec, slip_rad: float, load_n: float) -> float:
    """Aligning moment, positive where it turns the wheel back: pneumatic trail times force."""
    share = load_n / tire.reference_load_n
    if 2.0 * tire.trail_load * share > tire.trail_0 + tire.trail_load:
        share = 0.5 * (tire.trail_0 + tire.trail_load) / tire.trail_load
    trail = tire.unloaded_radius_m * share * (tire.trail_0 - tire.trail_load * (share - 1.0))
    trail *= 1.0 + tire.trail_pressure * (1.0 - inflation(tire))
    bend = cos(tire.trail_shape * atan(tire.trail_stretch * slip_rad)) * cos(slip_rad)
    return trail * bend * lateral_n(tire, slip_rad, load_n)


def _fades(floor: float, q: float) -> float:
    return floor + (1.0 - floor) * q
