"""A `single_track` section written out as a whole vehicle; what else the file says goes over it."""

from __future__ import annotations

from truck_blowout_sim.vehicle.document import Branch, Leaf, merge
from truck_blowout_sim.vehicle.reading import Notes, build
from truck_blowout_sim.vehicle.single_track.axles import put_axles
from truck_blowout_sim.vehicle.single_track.bodies import put_unit
from truck_blowout_sim.vehicle.single_track.controls import put_controls
from truck_blowout_sim.vehicle.single_track.draft import RULE, Draft
from truck_blowout_sim.vehicle.single_track.plan import (
    UnitPlan,
    rear_tire_place,
    towing_plan,
    trailer_plan,
)
from truck_blowout_sim.vehicle.single_track.rules import load_rules
from truck_blowout_sim.vehicle.single_track.schema import SingleTrackSpec
from truck_blowout_sim.vehicle.single_track.tires import put_blowout, put_rims, put_tires

KEY = "single_track"


def filled_in(tree: Branch) -> Branch:
    """The tree of a vehicle file with its single-track section written out.

    Every value that the section does not state is set by a rule of `config/single_track`, with the
    rule's source and spread; keys elsewhere in the file win over it. A file without the section
    comes back as it is.

    Raises:
        InputError: the section cannot be used; one line says what and where.
    """
    section = tree.entries.pop(KEY, None)
    if section is None:
        return tree
    if isinstance(section, Leaf):
        raise section.place.error(f"{section.value!r} is not a section", "keys below it")
    return merge(_whole_vehicle(section), tree)


def _whole_vehicle(section: Branch) -> Branch:
    notes = Notes()
    spec = build(SingleTrackSpec, section, notes, KEY)
    rules = load_rules(spec.kind)
    trailer: UnitPlan | None = None
    if spec.trailer is not None:
        below = section.entries["trailer"]
        assert isinstance(below, Branch)  # `build` has seen to it
        trailer = trailer_plan(spec.trailer, load_rules("trailer"), spec.rear_tire or spec.tire,
                               rear_tire_place(spec, section), below)  # fmt: skip
    towing = towing_plan(spec, rules, trailer, section)
    draft = Draft(section.place, notes)
    draft.put("title", f"single-track {spec.kind}" + (" with semitrailer" if trailer else ""))
    draft.put("road", "level_dry")
    units = (towing,) if trailer is None else (towing, trailer)
    for unit in units:
        put_unit(draft, unit, spec)
        put_axles(draft, unit, total_driven=sum(axle.driven for axle in towing.axles))
        put_tires(draft, unit, spec)
    put_blowout(draft, towing)
    put_rims(draft, units)
    put_controls(draft, spec, units)
    return draft.tree()


__all__ = ["RULE", "filled_in"]
