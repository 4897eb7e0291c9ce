"""What no single value shows: sections that must fit each other.

Every check yields nothing or raises an `InputError` at the place in the file that a person would
change. `tree` is the file with everything it extends, so a place may lie in an extended file.
"""

from __future__ import annotations

import re

from truck_blowout_sim.vehicle.check_effects import check_effects
from truck_blowout_sim.vehicle.check_tires import check_blowout, check_tire
from truck_blowout_sim.vehicle.document import Branch, Leaf, Place
from truck_blowout_sim.vehicle.masses import unit_mass
from truck_blowout_sim.vehicle.reading import unknown
from truck_blowout_sim.vehicle.schema.road import RoadSpec
from truck_blowout_sim.vehicle.statics import axle_groups, static_loads
from truck_blowout_sim.vehicle.vehicle import Vehicle

SHORTEST_BASE_M = 0.1
NAME = re.compile(r"[a-z][a-z0-9_]*")


def check_vehicle(vehicle: Vehicle, tree: Branch) -> None:
    """Check a vehicle as a whole.

    Raises:
        InputError: the first thing that does not fit, at its place in the file.
    """
    _check_units(vehicle, tree)
    _check_inertias(vehicle, tree)
    for name in vehicle.axles:
        _check_axle(vehicle, tree, name)
        _check_tandem(vehicle, tree, name)
    _check_steering(vehicle, tree)
    _check_drive(vehicle, tree)
    _check_loads(vehicle, tree)
    check_blowout(vehicle, place_of(tree, "blowout"))
    for tire in vehicle.tires:
        check_tire(vehicle, tire, place_of(tree, "tires"))
    if vehicle.spec.abs.slip_on > vehicle.spec.abs.slip_off:
        place = place_of(tree, "abs", "slip_on")
        raise place.error("is above slip_off", f"at most {vehicle.spec.abs.slip_off:g}")
    check_effects(vehicle)


def check_road(road: RoadSpec, tree: Branch) -> None:
    """Check a road as a whole.

    Raises:
        InputError: a patch that covers nothing, at its place in the file.
    """
    if road.patch is None:
        return
    for first, last in (("x0_m", "x1_m"), ("y0_m", "y1_m")):
        start, end = getattr(road.patch, first), getattr(road.patch, last)
        if start >= end:
            raise place_of(tree, "patch", first).error(
                f"{start:g} m is not before {last}, {end:g} m", f"less than {last}")


def place_of(tree: Branch, *keys: str) -> Place:
    """Where a person would look for a key in the file they loaded.

    A key that an extended file gives is placed at the deepest section above it in the loaded one:
    what does not fit is more likely wrong there than in the file that was fine before.
    """
    here: Branch | Leaf = tree
    line = tree.place.line
    for key in keys:
        if isinstance(here, Leaf) or key not in here.entries:
            break
        here = here.entries[key]
        if here.place.file == tree.place.file:
            line = here.place.line
    return Place(tree.place.file, line, ".".join(keys))


def _check_units(vehicle: Vehicle, tree: Branch) -> None:
    coupled = "trailer" in vehicle.units
    if coupled != (vehicle.spec.fifth_wheel is not None):
        words = "a fifth_wheel section for the trailer" if coupled else "none without a trailer"
        raise tree.place.error("fifth_wheel and trailer do not go together", words)
    for name, unit in vehicle.unit_specs.items():
        place = place_of(tree, "units", name)
        if coupled and unit.hitch is None:
            raise place.error("hitch is missing", "x_m and z_m of fifth wheel or kingpin")
        low, high = unit.frame.front_x_m, unit.frame.rear_x_m
        if low >= high:
            raise place_of(tree, "units", name, "frame").error(
                f"front_x_m {low:g} is not ahead of rear_x_m {high:g}", "x growing rearward"
            )
        points = {"body": unit.body.x_m, "base_link": unit.base_link.x_m}
        if unit.hitch is not None:
            points["hitch"] = unit.hitch.x_m
        for key, x in points.items():
            _check_inside(place_of(tree, "units", name, key, "x_m"), x, low, high, "the frame")
        for key, box in unit.payload.items():
            where = place_of(tree, "units", name, "payload", key, "x_m")
            _check_inside(where, box.x_m, low, high, "the frame")


def _check_inside(place: Place, x: float, low: float, high: float, what: str) -> None:
    if not low <= x <= high:
        raise place.error(f"{x:g} m lies outside {what}", f"from {low:g} to {high:g} m")


def _check_inertias(vehicle: Vehicle, tree: Branch) -> None:
    for name, unit in vehicle.unit_specs.items():
        body = unit.body
        moments = {"ixx_kgm2": body.ixx_kgm2, "iyy_kgm2": body.iyy_kgm2, "izz_kgm2": body.izz_kgm2}
        for key, moment in moments.items():
            rest = sum(moments.values()) - moment
            if moment > rest:
                raise place_of(tree, "units", name, "body", key).error(
                    f"{moment:g} is more than the other two together", f"at most {rest:g}"
                )
        if body.ixz_kgm2**2 >= body.ixx_kgm2 * body.izz_kgm2:
            raise place_of(tree, "units", name, "body", "ixz_kgm2").error(
                f"{body.ixz_kgm2:g} belongs to no body", "less than sqrt(Ixx Izz)"
            )


def _check_axle(vehicle: Vehicle, tree: Branch, name: str) -> None:
    axle, place = vehicle.spec.axles[name], place_of(tree, "axles", name)
    if not NAME.fullmatch(name):
        raise place.error(f"{name!r} is no name for an axle", "small letters, digits, underscores")
    if axle.unit not in vehicle.units:
        raise place_of(tree, "axles", name, "unit").error(
            f"this vehicle has no {axle.unit}", f"one of: {', '.join(vehicle.units)}"
        )
    frame = vehicle.unit_specs[axle.unit].frame
    where = place_of(tree, "axles", name, "x_m")
    _check_inside(where, axle.x_m, frame.front_x_m, frame.rear_x_m, f"the {axle.unit}'s frame")
    if axle.dual_spacing_m >= axle.track_m:
        raise place_of(tree, "axles", name, "dual_spacing_m").error(
            f"{axle.dual_spacing_m:g} m does not fit the track", f"less than {axle.track_m:g} m"
        )


def _check_tandem(vehicle: Vehicle, tree: Branch, name: str) -> None:
    axles, partner = vehicle.spec.axles, vehicle.spec.axles[name].equalized_with
    if not partner:
        return
    place = place_of(tree, "axles", name, "equalized_with")
    if partner not in axles or partner == name:
        others = tuple(other for other in axles if other != name)
        raise unknown(place, f"no other axle {partner!r}", partner, others)
    if axles[partner].equalized_with != name:
        raise place.error(f"{partner} is not equalized with {name}", "both to name each other")
    if (axles[partner].unit, axles[partner].circuit) != (axles[name].unit, axles[name].circuit):
        raise place.error(f"{partner} is of another group", "axles of one unit and circuit")


def _check_steering(vehicle: Vehicle, tree: Branch) -> None:
    steered = [name for name, axle in vehicle.spec.axles.items() if axle.steered]
    for name in steered:
        place = place_of(tree, "axles", name, "steered")
        if name != steered[0] or vehicle.spec.axles[name].unit != "tractor":
            raise place.error(f"{name} cannot be steered", "one steered axle, on the tractor")
        if vehicle.spec.axles[name].dual_spacing_m:
            # the moment about a kingpin is that of one tire
            raise place_of(tree, "axles", name, "dual_spacing_m").error(
                f"{name} has twin tires and is steered", "single tires on the steered axle")
        if vehicle.spec.steering is None:
            raise tree.place.error(f"{name} is steered by nothing", "a steering section")


def _check_drive(vehicle: Vehicle, tree: Branch) -> None:
    whole = 2.0 * sum(axle.drive_share for axle in vehicle.spec.axles.values())
    if whole and abs(whole - 1.0) > 1e-6:
        raise place_of(tree, "axles").error(
            f"drive_share of all hubs adds up to {whole:g}", "1 over both hubs of all axles, or 0"
        )


def _check_loads(vehicle: Vehicle, tree: Branch) -> None:
    axles = vehicle.spec.axles
    for unit, expected in zip(vehicle.units, (2, 1), strict=False):
        groups = axle_groups(axles, unit)
        if len(groups) != expected:
            raise place_of(tree, "axles").error(
                f"the {unit} stands on {len(groups)} groups of axles",
                f"axles of {expected} different circuits",
            )
        ahead = groups[0].x_m if len(groups) == 2 else 0.0
        if groups[-1].x_m - ahead < SHORTEST_BASE_M:
            raise place_of(tree, "axles").error(
                f"the {unit}'s axles are {groups[-1].x_m - ahead:g} m apart or from the kingpin",
                f"at least {SHORTEST_BASE_M:g} m",
            )
    loads = static_loads(vehicle, vehicle.road.gravity_mps2)
    if loads.hitch_n < 0.0:
        raise place_of(tree, "units", "trailer").error(
            f"the kingpin carries {loads.hitch_n:.0f} N at rest",
            "a center of gravity before the axles",
        )
    for name, load in loads.spring_n.items():
        if load <= 0.0:
            mass = unit_mass(vehicle.unit_specs[axles[name].unit])
            raise place_of(tree, "axles").error(
                f"{name} carries {load:.0f} N at rest",
                f"axles on both sides of the center of gravity, {mass.x_m:.2f} m behind the origin",
            )
