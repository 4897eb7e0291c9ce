"""The sprung body of each unit, its frame, hitch and air."""

from __future__ import annotations

from dataclasses import dataclass

from truck_blowout_sim.vehicle.single_track.draft import Draft
from truck_blowout_sim.vehicle.single_track.plan import AxlePlan, UnitPlan, cg_height_m
from truck_blowout_sim.vehicle.single_track.schema import SingleTrackSpec


@dataclass(frozen=True)
class Masses:
    """What is left for the body once the axles are taken off, and where it lies."""

    cg_height_m: float
    yaw_inertia_kgm2: float
    sprung_kg: float
    sprung_x_m: float
    sprung_z_m: float
    sprung_izz_kgm2: float


def track_m(unit: UnitPlan) -> float:
    """Track of a unit, stated or by rule."""
    return unit.track_m or unit.rules.spec.track_m


def axle_mass_kg(unit: UnitPlan, axle: AxlePlan) -> float:
    """Unsprung mass of an axle."""
    return unit.rules.spec.axle_mass_share * axle.load_kg


def axle_inertia_kgm2(unit: UnitPlan, axle: AxlePlan) -> float:
    """Roll and yaw inertia of an axle."""
    return axle_mass_kg(unit, axle) * (unit.rules.spec.axle_gyration_per_track * track_m(unit)) ** 2


def masses_of(unit: UnitPlan) -> Masses:
    """Split a unit into axles and sprung body, so that mass, place and inertia add up as stated."""
    height = cg_height_m(unit)
    izz = unit.yaw_inertia_kgm2 or _usual_izz(unit)
    off = [(axle_mass_kg(unit, axle), axle) for axle in unit.axles]
    sprung = unit.mass_kg - sum(mass for mass, _ in off)
    x = (unit.mass_kg * unit.cg_x_m - sum(mass * axle.x_m for mass, axle in off)) / sprung
    z = (unit.mass_kg * height - sum(mass * axle.size.radius_m for mass, axle in off)) / sprung
    spent = sprung * (x - unit.cg_x_m) ** 2 + sum(
        mass * (axle.x_m - unit.cg_x_m) ** 2 + axle_inertia_kgm2(unit, axle) for mass, axle in off
    )
    return Masses(height, izz, sprung, x, z, izz - spent)


def _usual_izz(unit: UnitPlan) -> float:
    """Yaw inertia by rule: index * m a b."""
    arms = unit.cg_x_m * (unit.wheelbase_m - unit.cg_x_m)
    return unit.rules.spec.yaw_inertia_index * unit.mass_kg * arms


def put_unit(draft: Draft, unit: UnitPlan, spec: SingleTrackSpec) -> None:
    """Body, frame, instruments, hitch and air of one unit.

    Raises:
        InputError: axles alone have more yaw inertia or mass than the whole unit.
    """
    at, rules, masses = f"units.{unit.name}", unit.rules, masses_of(unit)
    if masses.sprung_izz_kgm2 <= 0.0 or masses.sprung_kg <= 0.0:
        raise draft.place.error(
            f"yaw inertia {masses.yaw_inertia_kgm2:g} kg m2 is less than that of the axles alone",
            f"about {_usual_izz(unit):.0f}",
        )
    _put_body(draft, f"{at}.body", unit, masses)
    half = 0.5 * unit.wheelbase_m
    front = -rules.spec.front_overhang_per_wheelbase * unit.wheelbase_m
    rear = max(axle.x_m for axle in unit.axles)
    rear += rules.spec.rear_overhang_per_wheelbase * unit.wheelbase_m
    draft.ruled(f"{at}.frame.front_x_m", front, rules, "front_overhang_per_wheelbase")
    draft.ruled(f"{at}.frame.rear_x_m", rear, rules, "rear_overhang_per_wheelbase")
    draft.rule(f"{at}.frame.torsion_nmprad", rules, "torsion_nmprad")
    draft.rule(f"{at}.frame.torsion_damping_s", rules, "torsion_damping_s")
    draft.put(f"{at}.frame.torsion_height_m", masses.sprung_z_m)
    draft.put(f"{at}.frame.torsion_front_share", 0.5 if unit.name == "tractor" else 0.0)
    trailer = unit.name == "trailer"
    draft.put(f"{at}.base_link.x_m", half if trailer else unit.cg_x_m,
              "midway between kingpin and axles" if trailer else "center of gravity")  # fmt: skip
    draft.put(f"{at}.base_link.z_m", masses.cg_height_m, "height of the center of gravity")
    if unit.hitch_load_kg:
        draft.put(f"{at}.hitch.x_m", unit.hitch_x_m, spread=draft.spread_of(unit, "hitch_x_m"))
        draft.rule(f"{at}.hitch.z_m", rules, "hitch_height_m", stated=spec.hitch_height_m,
                   told=draft.notes.spreads.get("single_track.hitch_height_m", 0.0))  # fmt: skip
    stated = 0.0 if trailer else spec.drag_area_m2
    height = rules.spec.air_height_per_cg_height * masses.cg_height_m
    draft.rule(f"{at}.air.drag_area_m2", rules, "drag_area_m2", stated=stated,
               told=draft.spread_of(unit, "drag_area_m2"))  # fmt: skip
    draft.ruled(f"{at}.air.drag_z_m", height, rules, "air_height_per_cg_height")
    draft.rule(f"{at}.air.side_area_m2", rules, "side_area_per_wheelbase_m", unit.wheelbase_m)
    draft.put(f"{at}.air.side_x_m", half, "middle of the wheelbase")
    draft.ruled(f"{at}.air.side_z_m", height, rules, "air_height_per_cg_height")


def _told_x_m(draft: Draft, unit: UnitPlan, masses: Masses) -> float:
    """Spread of the sprung body's place: of the center of gravity, or of the load in front."""
    load = "kingpin_load_kg" if unit.name == "trailer" else "front_load_kg"
    of_load = unit.wheelbase_m * draft.spread_of(unit, load) / unit.mass_kg
    whole = draft.spread_of(unit, "cg_x_m") or of_load
    return whole * unit.mass_kg / masses.sprung_kg


def _put_body(draft: Draft, at: str, unit: UnitPlan, masses: Masses) -> None:
    rules = unit.rules
    yaw = masses.sprung_izz_kgm2
    roll = masses.sprung_kg * (rules.spec.roll_gyration_per_track * track_m(unit)) ** 2
    draft.put(f"{at}.mass_kg", masses.sprung_kg, spread=draft.spread_of(unit, "mass_kg"))
    draft.put(f"{at}.x_m", masses.sprung_x_m, spread=_told_x_m(draft, unit, masses))
    if unit.cg_height_m:
        draft.put(f"{at}.z_m", masses.sprung_z_m, spread=draft.spread_of(unit, "cg_height_m"))
    else:
        draft.ruled(f"{at}.z_m", masses.sprung_z_m, rules, "cg_height_per_track")
    draft.ruled(f"{at}.ixx_kgm2", roll, rules, "roll_gyration_per_track", "roll_gyration_per_track")
    draft.ruled(f"{at}.iyy_kgm2", yaw, rules, "yaw_inertia_index")
    if unit.yaw_inertia_kgm2:
        draft.put(f"{at}.izz_kgm2", yaw, spread=draft.spread_of(unit, "yaw_inertia_kgm2"))
    else:
        draft.ruled(f"{at}.izz_kgm2", yaw, rules, "yaw_inertia_index")

