"""Axles with suspension and brakes, from ride frequency, roll gradient and full braking.

References: Gillespie, Fundamentals of Vehicle Dynamics, chapters 5 (ride) and 6 (roll gradient).
Known limits: the roll gradient is that of the body on its suspension; the tires add to it.
Validated with: test/vehicle/test_single_track.py.
"""

from __future__ import annotations

from math import pi, sqrt

from scipy.constants import g

from truck_blowout_sim.vehicle.single_track.bodies import (
    axle_inertia_kgm2,
    axle_mass_kg,
    masses_of,
    track_m,
)
from truck_blowout_sim.vehicle.single_track.draft import Draft
from truck_blowout_sim.vehicle.single_track.plan import AxlePlan, UnitPlan

WHEEL_GYRATION = 0.75  # of a wheel with its tire over the free radius: mass between rim and tread
WHEEL_SHARE = 0.5  # share of an axle's mass in its wheels: 19 kg m2 a steer wheel of the default


def put_axles(draft: Draft, unit: UnitPlan, *, total_driven: int) -> None:
    """All axles of a unit."""
    roll = _auxiliary_roll(unit)
    for axle in unit.axles:
        _put_axle(draft, unit, axle, total_driven)
        _put_suspension(draft, unit, axle, roll[axle.name])
        _put_brake(draft, unit, axle)


def _put_axle(draft: Draft, unit: UnitPlan, axle: AxlePlan, total_driven: int) -> None:
    at, rules, track = f"axles.{axle.name}", unit.rules, track_m(unit)
    draft.put(f"{at}.unit", unit.name)
    draft.put(f"{at}.circuit", axle.circuit)
    draft.put(f"{at}.x_m", axle.x_m)
    draft.ruled(f"{at}.mass_kg", axle_mass_kg(unit, axle), rules, "axle_mass_share")
    inertia = axle_inertia_kgm2(unit, axle)
    for key in ("ixx_kgm2", "izz_kgm2"):
        draft.ruled(f"{at}.{key}", inertia, rules, "axle_mass_share", "axle_gyration_per_track")
    draft.rule(f"{at}.track_m", rules, "track_m", stated=unit.track_m,
               told=draft.spread_of(unit, "track_m"))  # fmt: skip
    draft.ruled(f"{at}.spring_spacing_m", rules.spec.spring_spacing_share * track, rules,
                "spring_spacing_share")  # fmt: skip
    wheels = 0.5 * WHEEL_SHARE * axle_mass_kg(unit, axle)
    spin = wheels * (WHEEL_GYRATION * axle.size.radius_m) ** 2
    draft.ruled(f"{at}.spin_inertia_kgm2", spin, rules, "axle_mass_share")
    if axle.tires == 4:
        gap = (1.0 + rules.spec.dual_gap_share) * axle.size.width_m
        draft.ruled(f"{at}.dual_spacing_m", gap, rules, "dual_gap_share")
    draft.put(f"{at}.steered", axle.steered)
    draft.put(f"{at}.drive_share", 0.5 / total_driven if axle.driven else 0.0)
    if _pair(unit, axle) and rules.spec.equalizer_m:
        draft.put(f"{at}.equalized_with", _pair(unit, axle))


def _pair(unit: UnitPlan, axle: AxlePlan) -> str:
    """The other axle of a tandem, or nothing."""
    others = [one.name for one in unit.axles if one.circuit == axle.circuit and one is not axle]
    return others[0] if len(others) == 1 else ""


def _spring_npm(unit: UnitPlan, axle: AxlePlan) -> float:
    """Rate of one side: k = (2 pi f)^2 m with half of the sprung mass on the axle."""
    rules = unit.rules.spec
    frequency = rules.front_ride_hz if axle.steered else rules.rear_ride_hz
    return (2.0 * pi * frequency) ** 2 * _side_kg(unit, axle)


def _side_kg(unit: UnitPlan, axle: AxlePlan) -> float:
    return 0.5 * (axle.load_kg - axle_mass_kg(unit, axle))


def _auxiliary_roll(unit: UnitPlan) -> dict[str, float]:
    """Roll stiffness that each axle needs beside its springs, for the roll gradient of the rule.

    phi / ay = m h / (K - m g h), h from roll axis to mass. Of a semitrailer, its own axles hold up
    the part of the mass that they carry; the rest stands on the tractor's rear axles.
    """
    rules = unit.rules.spec
    own, carried = _roll_moments(unit)
    front = rules.front_roll_share * own if unit.axles[0].steered else 0.0
    rear = [axle for axle in unit.axles if not axle.steered]
    found = {}
    for axle in unit.axles:
        moment = front if axle.steered else (own - front + carried) / len(rear)
        needed = moment / rules.roll_gradient_rad + moment
        spacing = rules.spring_spacing_share * track_m(unit)
        found[axle.name] = max(needed - 0.5 * _spring_npm(unit, axle) * spacing**2, 0.0)
    return found


def _roll_moments(unit: UnitPlan) -> tuple[float, float]:
    """Products m g h: of what the unit's axles carry of itself, and of what lies on its hitch."""
    rules, masses = unit.rules.spec, masses_of(unit)
    place = min(max(masses.sprung_x_m / unit.wheelbase_m, 0.0), 1.0)
    front = rules.front_roll_centre_m if unit.axles[0].steered else rules.rear_roll_centre_m
    axis = front + place * (rules.rear_roll_centre_m - front)
    on_axles = masses.sprung_kg - (unit.hitch_load_kg if unit.name == "trailer" else 0.0)
    own = on_axles * g * max(masses.sprung_z_m - axis, 0.0)
    above = max(unit.carried_height_m - rules.rear_roll_centre_m, 0.0)
    return own, unit.hitch_load_kg * g * above if unit.name == "tractor" else 0.0


def _put_suspension(draft: Draft, unit: UnitPlan, axle: AxlePlan, auxiliary: float) -> None:
    at, rules = f"axles.{axle.name}.suspension", unit.rules
    ride = "front_ride_hz" if axle.steered else "rear_ride_hz"
    spring = _spring_npm(unit, axle)
    side = _side_kg(unit, axle)
    draft.ruled(f"{at}.spring_npm", spring, rules, ride, ride)
    damping = 2.0 * rules.spec.damping_ratio * sqrt(spring * side)
    draft.ruled(f"{at}.damping_nspm", damping, rules, "damping_ratio", ride)
    draft.rule(f"{at}.friction_n", rules, "friction_share", side * g)
    draft.rule(f"{at}.friction_transition_m", rules, "friction_transition_m")
    draft.ruled(f"{at}.aux_roll_nmprad", auxiliary, rules, "roll_gradient_rad")
    draft.rule(f"{at}.jounce_m", rules, "travel_m")
    draft.rule(f"{at}.rebound_m", rules, "travel_m")
    draft.ruled(f"{at}.stop_npm", rules.spec.stop_per_spring * spring, rules, "stop_per_spring")
    draft.rule(f"{at}.equalizer_m", rules, "equalizer_m", float(bool(_pair(unit, axle))))
    draft.put(f"{at}.roll_steer", 0.0, "contained in the effective cornering stiffness")
    center = "front_roll_centre_m" if axle.steered else "rear_roll_centre_m"
    draft.rule(f"{at}.roll_centre_height_m", rules, center)


def _put_brake(draft: Draft, unit: UnitPlan, axle: AxlePlan) -> None:
    """Full pressure gives the deceleration of the rule, each axle by its load."""
    at, rules = f"axles.{axle.name}.brake", unit.rules
    force = 0.5 * axle.load_kg * rules.spec.brake_full_mps2
    pressure = rules.spec.brake_full_pa - rules.spec.brake_pushout_pa
    draft.ruled(f"{at}.linear_nmppa", force * axle.size.radius_m / pressure, rules,
                "brake_full_mps2", "brake_full_pa")  # fmt: skip
    draft.put(f"{at}.quadratic_nmppa2", 0.0, "none: torque grows evenly with pressure")
    draft.rule(f"{at}.pushout_pa", rules, "brake_pushout_pa")
