"""Tires from their size and the axle's cornering stiffness; the law of their blowout.

References: T. B. Rhyne, Tire Science and Technology 33(3), 2005; the formulas of docs/physics.md.
Known limits: the shape of the force curve is that of the shipped truck tire, scaled.
Validated with: test/vehicle/test_single_track.py (the stated cornering stiffness comes back).
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from math import atan, sin

from scipy.constants import g

from truck_blowout_sim.resources import config_file
from truck_blowout_sim.vehicle.document import read_document
from truck_blowout_sim.vehicle.reading import Notes, build
from truck_blowout_sim.vehicle.schema.tire import BlowoutSpec, TireSpec
from truck_blowout_sim.vehicle.single_track.draft import STATED, Draft
from truck_blowout_sim.vehicle.single_track.plan import AxlePlan, UnitPlan
from truck_blowout_sim.vehicle.single_track.schema import SingleTrackSpec
from truck_blowout_sim.vehicle.single_track.tire_size import TireSize, parse_size

BASE_TIRE = "steer_275_80r22_5"
BASE_SIZE = "275/80R22.5"
BASE_BLOWOUT = "continuous"
SCALED = "scaled with the size of the tire: "


def put_tires(draft: Draft, unit: UnitPlan, spec: SingleTrackSpec) -> None:
    """One kind of tire for each axle."""
    base = _base_tire()
    for axle in unit.axles:
        at = f"tires.{axle.name}"
        draft.put(f"{at}.extends", BASE_TIRE)
        draft.put(f"{at}.title", f"{axle.size_text}, from its size and the axle's stiffness")
        draft.rule(f"{at}.pressure_pa", unit.rules, "tire_pressure_pa",
                   stated=spec.tire_pressure_pa,
                   told=draft.notes.spreads.get("single_track.tire_pressure_pa", 0.0))  # fmt: skip
        _put_carcass(draft, at, axle.size, base)
        _put_forces(draft, at, unit, axle)


@cache
def _base_tire() -> TireSpec:
    return build(TireSpec, read_document(config_file("tires", BASE_TIRE), "tires"), Notes())


def _put_carcass(draft: Draft, at: str, size: TireSize, base: TireSpec) -> None:
    reference = parse_size(BASE_SIZE, draft.place)
    pressure = float(draft.entries[f"{at}.pressure_pa"].value)
    draft.put(f"{at}.reference_pressure_pa", pressure, "pressure the stiffness holds at")
    draft.put(f"{at}.unloaded_radius_m", size.radius_m, "size on the sidewall")
    draft.put(f"{at}.stiffness_npm", size.structure_npm, "Rhyne 2005")
    draft.put(f"{at}.stiffness_npmppa", size.stiffness_npmppa, "Rhyne 2005")
    rate = size.structure_npm + size.stiffness_npmppa * pressure
    base_rate = base.stiffness_npm + base.stiffness_npmppa * base.pressure_pa
    draft.put(f"{at}.damping_nspm", base.damping_nspm * rate / base_rate, SCALED + BASE_SIZE)
    draft.put(f"{at}.volume_m3", size.volume_m3, "section geometry, +-10 %",
              spread=0.1 * size.volume_m3)  # fmt: skip
    hole = base.hole_area_m2 * size.volume_m3 / reference.volume_m3
    draft.put(f"{at}.hole_area_m2", hole, SCALED + "empty within the same time")


def _told(draft: Draft, unit: UnitPlan, axle: AxlePlan) -> float:
    """Spread that the file states of an axle's cornering stiffness, as a share of it."""
    if unit.name == "trailer":
        key, alike = "cornering_nprad", len(unit.axles)
    elif axle.steered:
        key, alike = "front_cornering_nprad", 1
    else:
        key, alike = "rear_cornering_nprad", len(unit.axles) - 1
    return draft.spread_of(unit, key) / (axle.cornering_nprad * alike)


def _put_forces(draft: Draft, at: str, unit: UnitPlan, axle: AxlePlan) -> None:
    rules = unit.rules
    load = axle.load_kg * g / axle.tires
    stated = axle.cornering_nprad / axle.tires
    stiffness = stated or rules.spec.cornering_per_load * load
    peak = stiffness / (load * sin(2.0 * atan(1.0 / rules.spec.cornering_load)))
    draft.put(f"{at}.reference_load_n", load, "load at rest")
    draft.rule(f"{at}.cornering_load", rules, "cornering_load")
    if stated:
        draft.put(f"{at}.cornering_peak", peak, STATED, peak * _told(draft, unit, axle))
    else:
        draft.ruled(f"{at}.cornering_peak", peak, rules, "cornering_per_load")
    draft.put(f"{at}.cornering_scale", 1.0, "held by cornering_peak")
    for key in ("peak_y", "peak_x"):
        draft.rule(f"{at}.{key}", rules, "peak_friction")
    draft.rule(f"{at}.slip_stiffness", rules, "slip_stiffness")
    radius, per_radius = axle.size.radius_m, rules.spec.relaxation_per_radius
    draft.ruled(f"{at}.lateral_stiffness_npm", stiffness / (per_radius * radius), rules,
                "relaxation_per_radius")  # fmt: skip
    slip = rules.spec.slip_stiffness * load
    draft.ruled(f"{at}.longitudinal_stiffness_npm", slip / (per_radius * radius), rules,
                "relaxation_per_radius")  # fmt: skip
    draft.rule(f"{at}.trail_0", rules, "trail_per_radius")
    draft.rule(f"{at}.rolling_0", rules, "rolling_resistance")
    draft.put(f"{at}.rolling_spm", 0.0, "contained in rolling_0")


def put_blowout(draft: Draft, towing: UnitPlan) -> None:
    """The shipped law of a blowout, with the numbers on the rim of the front tires."""
    draft.put("blowout.extends", BASE_BLOWOUT)
    _put_rim(draft, "blowout", towing.axles[0])


def put_rims(draft: Draft, units: Sequence[UnitPlan]) -> None:
    """Numbers on the rim of every axle whose tires are of another size than the front ones."""
    front = units[0].axles[0]
    for axle in (axle for unit in units for axle in unit.axles):
        if axle.size != front.size:
            _put_rim(draft, f"tires.{axle.name}.rim", axle)


def _put_rim(draft: Draft, at: str, axle: AxlePlan) -> None:
    """A flat tire of an axle: the shipped law's radii at the same parts of the section height."""
    document = read_document(config_file("blowout", BASE_BLOWOUT), "blowout")
    law = build(BlowoutSpec, document, Notes())
    size, base = axle.size, parse_size(BASE_SIZE, draft.place)
    for key in ("rim_radius_m", "rim_contact_radius_m"):
        share = (getattr(law, key) - 0.5 * base.rim_diameter_m) / base.height_m
        radius = 0.5 * size.rim_diameter_m + share * size.height_m
        draft.put(f"{at}.{key}", radius, SCALED + "the same part of the section height")
    span = law.rim_span_m * size.height_m / base.height_m
    draft.put(f"{at}.rim_span_m", span, SCALED + "with the section height")
    draft.put(f"{at}.flat_radius_m", law.flat_radius_m * size.radius_m / base.radius_m,
              SCALED + "the belt rolls its own length")  # fmt: skip
    load = axle.load_kg / axle.tires * g
    stiffness = law.rim_stiffness_npm * load / _base_tire().reference_load_n
    draft.put(f"{at}.rim_stiffness_npm", stiffness, SCALED + "with the load")
    draft.put(f"{at}.flat_relaxation_m", law.flat_relaxation_m * size.radius_m / base.radius_m,
              SCALED + "with the radius")  # fmt: skip
