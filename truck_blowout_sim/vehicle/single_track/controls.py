"""Steering, fifth wheel, driveline and brake control of a single-track vehicle."""

from __future__ import annotations

from collections.abc import Sequence

from scipy.constants import g

from truck_blowout_sim.resources import config_file
from truck_blowout_sim.vehicle.document import Branch, Leaf, read_document
from truck_blowout_sim.vehicle.schema.controls import DrivelineSpec
from truck_blowout_sim.vehicle.single_track.draft import Draft
from truck_blowout_sim.vehicle.single_track.plan import UnitPlan
from truck_blowout_sim.vehicle.single_track.schema import SingleTrackSpec

SHIPPED = "international_9400i_trailmobile"
TAKEN = "as the shipped tractor: "
STIFF = "contained in the effective cornering stiffness of the front axle"
TRACTION = 0.5  # share of the driven axles' load that the lowest gear can put on the road


def put_controls(draft: Draft, spec: SingleTrackSpec, units: Sequence[UnitPlan]) -> None:
    """Everything that is not a body, an axle or a tire."""
    shipped = read_document(config_file("vehicles", SHIPPED), "vehicles")
    _take(draft, "steering", shipped)
    draft.put("steering.ratio", spec.steering_ratio,
              spread=draft.spread_of(units[0], "steering_ratio"))  # fmt: skip
    draft.put("steering.compliant", False, STIFF)
    draft.put("steering.lash_rad", 0.0, STIFF)
    if len(units) == 2:
        _take(draft, "fifth_wheel", shipped)
    _put_driveline(draft, spec, units)
    _take(draft, "abs", shipped)
    draft.put("abs.mode", "slip_threshold" if spec.kind == "truck" else "off", "not stated")
    draft.put("brakes", "air" if spec.kind == "truck" else "hydraulic")
    circuits = {"steer": units[0].rules, "drive": units[0].rules, "trailer": units[-1].rules}
    for circuit, rules in circuits.items():
        draft.rule(f"circuits.{circuit}.delay_s", rules, "brake_delay_s")
        draft.rule(f"circuits.{circuit}.lag_s", rules, "brake_lag_s")


def _take(draft: Draft, section: str, shipped: Branch) -> None:
    """The values of a section of the shipped vehicle, with their sources."""
    entries = shipped.entries[section]
    assert isinstance(entries, Branch)
    for key, leaf in entries.entries.items():
        assert isinstance(leaf, Leaf)
        value = leaf.value if leaf.factor == 1.0 else float(leaf.value) * leaf.factor
        draft.put(f"{section}.{key}", value, TAKEN + leaf.source)


def _put_driveline(draft: Draft, spec: SingleTrackSpec, units: Sequence[UnitPlan]) -> None:
    rules = units[0].rules
    mass = sum(unit.mass_kg for unit in units)
    driven = sum(axle.load_kg for axle in units[0].axles if axle.driven)
    draft.rule("driveline.power_w", rules, "power_wpkg", mass, stated=spec.power_w,
               told=draft.notes.spreads.get("single_track.power_w", 0.0))  # fmt: skip
    draft.put("driveline.max_force_n", TRACTION * driven * g, "half of the driven axles' load")
    draft.rule("driveline.drag_n", rules, "engine_drag_mps2", mass)
    draft.put("driveline.creep_speed_mps", 0.5, "numerical: lets the vehicle stand")
    draft.put("driveline.rolling_slip", DrivelineSpec.rolling_slip,
              "half of the slip at which traction peaks")  # fmt: skip
