"""Trucks whose form is drawn: other laws, other numbers of them, and a sheet that is partly wrong.

Ranges are those over which good models and measured trucks differ: cornering stiffness and load
exponents after Gillespie, Fundamentals of Vehicle Dynamics (1992), ch. 10, and Fancher et al., A
Factbook of the Mechanical Properties of the Components for Single-Unit and Articulated Heavy Trucks
(UMTRI-86-12, 1986); relaxation 0.3 to 0.8 m after Pacejka (2012), ch. 7; polytropic exponents
between an isothermal (1.0) and an adiabatic gas (1.4); the rest is engineering judgement.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from proving_ground.individual import Individual
from proving_ground.individual import draw as draw_individual
from proving_ground.kept_back import KeptBack
from proving_ground.laws import LENGTH, LOADED, POWER, QUADRATIC, SINE, STRETCH, Laws, usual

Rng = np.random.Generator


def draw(seed: int, wrong: bool = True) -> Individual:
    """A truck of a form of its own; `wrong`: some numbers of its sheet are off by 10 to 30 %."""
    rng = np.random.default_rng([seed, 97])
    truck = draw_individual(seed)
    truck = replace(truck, laws=KeptBack.of(seed).laws(draw_laws(rng)))
    _other_frame(truck.sheet, rng)
    return with_wrong_sheet(truck, rng) if wrong else truck


def draw_laws(rng: Rng) -> Laws:
    """A form: each law and each number drawn on its own."""
    def between(low: float, high: float) -> float:
        return float(rng.uniform(low, high))

    slope_law = int(rng.choice([QUADRATIC, POWER, SINE]))
    drop = between(2.0e-5, 5.0e-5)
    reference = 170.8e3 * between(0.93, 1.07)
    relaxation_law = int(rng.choice([STRETCH, LENGTH, LOADED]))
    rebound = between(0.5, 0.95)
    return usual()._replace(
        family=int(rng.integers(3)), reference_n=between(22.0e3, 32.0e3), slope_law=slope_law,
        slope=reference / 26.5e3 + drop * 26.5e3, slope_drop=drop, slope_reference=reference,
        slope_shape=between(0.75, 1.0) if slope_law == POWER else between(45.0e3, 90.0e3),
        soft_gain=between(0.2, 0.8), soft_loss=between(0.0, 0.5), slope_x=between(9.0, 20.0),
        slope_x_drop=between(0.0, 4.0), peak_x=between(0.68, 0.92), peak_x_drop=between(0.03, 0.15),
        peak_y=between(0.66, 0.90), peak_y_drop=between(0.02, 0.14), slide_x=between(0.65, 0.9),
        slide_y=between(0.65, 0.95), slip_x=between(0.08, 0.18), slip_y=between(0.18, 0.36),
        shape=between(1.2, 1.7), curvature=between(-1.2, 0.5), trail=between(0.07, 0.13),
        trail_drop=between(0.0, 0.04), trail_zero=between(0.14, 0.26), camber=between(0.05, 0.2),
        relaxation_law=relaxation_law,
        relaxation=between(250.0e3, 550.0e3) if relaxation_law == STRETCH else between(0.3, 0.8),
        relaxation_exponent=between(0.3, 1.0), relaxation_shrinks=float(rng.choice([0.0, 0.5])),
        radial=between(780.0e3, 1.05e6), radial_rise=between(0.0, 2.5e6),
        carcass=between(0.05, 0.15), rim_radius_m=between(0.36, 0.385), rim=between(0.7e7, 2.5e7),
        rolling=between(0.0042, 0.0056), rolling_rise=between(1.0e-6, 4.0e-6),
        rolling_soft=between(0.5, 2.5), flat_drag=between(0.08, 0.25),
        flat_drag_exponent=between(-0.2, 0.5), flat_keeps=between(0.05, 0.40),
        flat_grip_lost=between(0.2, 0.5), polytropic=between(1.0, 1.4),
        hole_m2=0.0026 * float(np.exp(rng.uniform(np.log(0.6), np.log(1.7)))),
        hole_growth_s=between(0.0, 0.25), leaf_hardening=between(0.0, 25.0),
        air_exponent=between(1.05, 1.4), rebound=rebound, bump=2.0 - rebound,
        damper_exponent=between(0.75, 1.0), friction_law=int(rng.integers(2)),
        friction_travel_m=between(0.0015, 0.006), friction_speed_mps=between(0.01, 0.05),
        unequal=between(0.03, 0.25), linkage_hardening=between(0.0, 12.0),
        brake_linear=158.0 * between(0.96, 1.06), brake_drop=between(0.0, 0.4),
        drag_exponent=between(1.85, 2.1))


def _other_frame(sheet: dict[str, Any], rng: Rng) -> None:
    """Parts that no sheet states: frame, tie rod, kingpins' friction, lashing."""
    for unit in ("tractor", "trailer"):
        sheet[unit]["torsion_nm_per_rad"] *= float(rng.uniform(0.6, 1.7))
        sheet[unit]["torsion_x_m"] *= float(rng.uniform(0.9, 1.1))
    steering = sheet["steering"]
    steering["tie_rod_nm_per_rad"] *= float(rng.uniform(0.6, 1.6))
    steering["ackermann_per_rad"] *= float(rng.uniform(0.5, 1.6))
    steering["friction_nm"] *= float(rng.uniform(0.6, 1.6))
    sheet["payload_lashing"]["stiffness_n_per_m"] *= float(rng.uniform(0.6, 1.5))


Change = Callable[[Individual, float], Individual]


def _sheet_number(*path: str | int) -> Change:
    """A number of the sheet times a factor."""
    def change(truck: Individual, factor: float) -> Individual:
        node: Any = truck.sheet
        for key in path[:-1]:
            node = node[key]
        node[path[-1]] = node[path[-1]] * factor
        return truck

    return change


def _axles(key: str, first: int, last: int) -> Change:
    """A number of some axles times a factor."""
    def change(truck: Individual, factor: float) -> Individual:
        for axle in truck.sheet["axles"][first:last]:
            axle[key] *= factor
        return truck

    return change


def _cornering(first: int, last: int) -> Change:
    def change(truck: Individual, factor: float) -> Individual:
        scale = truck.cornering_scale.copy()
        scale[first:last] *= factor
        return replace(truck, cornering_scale=scale)

    return change


def _brakes(first: int, last: int) -> Change:
    def change(truck: Individual, factor: float) -> Individual:
        scale = truck.brake_scale.copy()
        scale[first:last] *= factor
        return replace(truck, brake_scale=scale)

    return change


# What a sheet gets wrong: name, change, largest error (less where 30 % would turn a truck over).
SHEET_ERRORS: dict[str, tuple[Change, float]] = {
    "tractor yaw inertia": (_sheet_number("tractor", "inertia_kgm2", 2), 0.15),
    "trailer yaw inertia": (_sheet_number("trailer", "inertia_kgm2", 2), 0.3),
    "height of the load": (_sheet_number("payload", 1, "z_m"), 0.12),
    "drag area": (_sheet_number("aero", "drag_area_m2"), 0.3),
    "drag of the engine": (_sheet_number("driveline", "drag_n"), 0.3),
    "steering linkage": (_sheet_number("steering", "linkage_nm_per_rad"), 0.3),
    "play of the linkage": (_sheet_number("steering", "lash_handwheel_deg"), 0.3),
    "kingpin offset": (_sheet_number("steering", "kingpin_offset_m"), 0.2),
    "friction of the fifth wheel": (_sheet_number("fifth_wheel", "yaw_friction_nm"), 0.3),
    "steer springs": (_axles("spring_n_per_m", 0, 1), 0.3),
    "drive springs": (_axles("spring_n_per_m", 1, 3), 0.3),
    "drive roll bars": (_axles("roll_nm_per_rad", 1, 3), 0.3),
    "dampers": (_axles("damper_ns_per_m", 0, 3), 0.3),
    "friction of springs": (_axles("coulomb_n", 0, 5), 0.3),
    "roll steer of the drive axles": (_axles("roll_steer", 1, 3), 0.3),
    "roll centers of the trailer": (_axles("roll_centre_m", 3, 5), 0.12),
    "cornering of the steer tires": (_cornering(0, 1), 0.2),
    "cornering of the drive tires": (_cornering(1, 3), 0.2),
    "cornering of the trailer tires": (_cornering(3, 5), 0.2),
    "brakes of the steer axle": (_brakes(0, 2), 0.2),
    "brakes of the drive axles": (_brakes(2, 6), 0.2),
    "brakes of the trailer": (_brakes(6, 10), 0.2),
    "lag of the brakes": (_sheet_number("brake", "lag_s"), 0.25),
}


def with_wrong_sheet(truck: Individual, rng: Rng) -> Individual:
    """One to four numbers off by 10 % to their largest error."""
    for name in rng.choice(sorted(SHEET_ERRORS), int(rng.integers(1, 5)), replace=False):
        change, most = SHEET_ERRORS[str(name)]
        truck = change(truck, float(1.0 + rng.choice([-1.0, 1.0]) * rng.uniform(0.1, most)))
    return truck
