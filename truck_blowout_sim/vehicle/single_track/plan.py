"""From what is stated to masses and axles: the arithmetic of a single-track model.

References: moment balance; Izz = index * m a b (dynamic index), Gillespie, chapter 1.
Known limits: one front axle and one group of rear axles; a semitrailer on one group.
Validated with: test/vehicle/test_single_track.py (stated loads, inertia and understeer come back).
"""

from __future__ import annotations

from dataclasses import dataclass

from truck_blowout_sim.vehicle.document import Branch, Place
from truck_blowout_sim.vehicle.single_track.rules import Rules
from truck_blowout_sim.vehicle.single_track.schema import SingleTrackSpec, SingleTrailerSpec
from truck_blowout_sim.vehicle.single_track.tire_size import TireSize, parse_size


@dataclass(frozen=True, kw_only=True)
class AxlePlan:
    """One axle: place behind the unit's origin, load at rest with a trailer, tires."""

    name: str
    circuit: str
    x_m: float
    load_kg: float
    cornering_nprad: float  # 0: by rule
    tires: int
    size: TireSize
    size_text: str
    track_m: float  # 0: by rule
    driven: bool
    steered: bool


@dataclass(frozen=True, kw_only=True)
class UnitPlan:
    """One unit with its axles; 0 stands for "by rule"."""

    name: str
    rules: Rules
    mass_kg: float
    wheelbase_m: float
    cg_x_m: float
    cg_height_m: float
    yaw_inertia_kgm2: float
    track_m: float
    hitch_x_m: float
    hitch_load_kg: float
    carried_height_m: float  # of the trailer's mass above the road; 0 without a trailer
    axles: tuple[AxlePlan, ...]


def cg_height_m(unit: UnitPlan) -> float:
    """Height of the center of gravity, stated or by rule."""
    rules = unit.rules.spec
    return unit.cg_height_m or rules.cg_height_per_track * (unit.track_m or rules.track_m)


def towing_plan(spec: SingleTrackSpec, rules: Rules, trailer: UnitPlan | None, tree: Branch
                ) -> UnitPlan:  # fmt: skip
    """Plan of the unit in front.

    Raises:
        InputError: what is stated does not fit together; at its key.
    """
    cg_x = _center(spec.cg_x_m, spec.wheelbase_m * (1.0 - spec.front_load_kg / spec.mass_kg)
                   if spec.front_load_kg else 0.0, spec.wheelbase_m, tree)  # fmt: skip
    if trailer is not None and not spec.hitch_x_m:
        raise tree.place.error("hitch_x_m is missing", "the fifth wheel behind the front axle")
    pin = trailer.hitch_load_kg if trailer is not None else 0.0
    height = cg_height_m(trailer) if trailer is not None else 0.0
    rear = (spec.mass_kg * cg_x + pin * spec.hitch_x_m) / spec.wheelbase_m
    front = spec.mass_kg + pin - rear
    if front <= 0.0 or rear <= 0.0:
        raise tree.place.error(f"the axles carry {front:.0f} and {rear:.0f} kg at rest",
                               "a center of gravity and a fifth wheel between them")  # fmt: skip
    truck = spec.kind == "truck"
    count = _whole(spec.rear_axles, tree, "rear_axles")
    twins = _tires(spec.rear_tires_per_axle or rules.spec.rear_tires_per_axle, tree,
                   "rear_tires_per_axle")  # fmt: skip
    rear_text = spec.rear_tire or spec.tire
    rear_size = parse_size(rear_text, rear_tire_place(spec, tree))
    axles = [AxlePlan(
        name="steer" if truck else "front", circuit="steer", x_m=0.0, load_kg=front,
        cornering_nprad=spec.front_cornering_nprad, tires=2,
        size=parse_size(spec.tire, _at(tree, "tire")), size_text=spec.tire, track_m=spec.track_m,
        driven=spec.driven != "rear", steered=True)]  # fmt: skip
    spread = spec.rear_axle_spread_m or rules.spec.axle_spread_m
    for k, x in enumerate(_places(spec.wheelbase_m, count, spread)):
        axles.append(AxlePlan(
            name=_name("drive" if truck else "rear", k, count), circuit="drive", x_m=x,
            load_kg=rear / count, cornering_nprad=spec.rear_cornering_nprad / count, tires=twins,
            size=rear_size, size_text=rear_text, track_m=spec.track_m,
            driven=spec.driven != "front", steered=False))  # fmt: skip
    return UnitPlan(
        name="tractor", rules=rules, mass_kg=spec.mass_kg, wheelbase_m=spec.wheelbase_m,
        cg_x_m=cg_x, cg_height_m=spec.cg_height_m, yaw_inertia_kgm2=spec.yaw_inertia_kgm2,
        track_m=spec.track_m, hitch_x_m=spec.hitch_x_m, hitch_load_kg=pin,
        carried_height_m=height, axles=tuple(axles))  # fmt: skip


def rear_tire_place(spec: SingleTrackSpec, tree: Branch) -> Place:
    """Where the size of the rear tires stands in the section."""
    return _at(tree, "rear_tire" if spec.rear_tire else "tire")


def trailer_plan(spec: SingleTrailerSpec, rules: Rules, tire: str, tire_place: Place, tree: Branch
                 ) -> UnitPlan:  # fmt: skip
    """Plan of a semitrailer; its origin is the kingpin.

    Args:
        spec: what the trailer's section says.
        rules: of a trailer.
        tire: size of the tires in front of it, which it has where it states none.
        tire_place: where that size stands.
        tree: the trailer's section.

    Raises:
        InputError: what is stated does not fit together; at its key.
    """
    base = spec.wheelbase_m
    cg_x = _center(spec.cg_x_m, base * (1.0 - spec.kingpin_load_kg / spec.mass_kg)
                   if spec.kingpin_load_kg else 0.0, base, tree)  # fmt: skip
    count = _whole(spec.axles, tree, "axles")
    rear = spec.mass_kg * cg_x / base
    text = spec.tire or tire
    size = parse_size(text, _at(tree, "tire") if spec.tire else tire_place)
    tires = _tires(spec.tires_per_axle, tree, "tires_per_axle")
    axles = tuple(
        AxlePlan(name=f"trailer_{k + 1}", circuit="trailer", x_m=x, load_kg=rear / count,
                 cornering_nprad=spec.cornering_nprad / count, tires=tires, size=size,
                 size_text=text, track_m=spec.track_m, driven=False, steered=False)
        for k, x in enumerate(_places(base, count, spec.axle_spread_m or rules.spec.axle_spread_m))
    )  # fmt: skip
    return UnitPlan(
        name="trailer", rules=rules, mass_kg=spec.mass_kg, wheelbase_m=base, cg_x_m=cg_x,
        cg_height_m=spec.cg_height_m, yaw_inertia_kgm2=spec.yaw_inertia_kgm2,
        track_m=spec.track_m, hitch_x_m=0.0, hitch_load_kg=spec.mass_kg - rear,
        carried_height_m=0.0, axles=axles)  # fmt: skip


def _center(stated: float, from_load: float, base: float, tree: Branch) -> float:
    """Center of gravity behind the origin, from one of the two ways to state it."""
    if bool(stated) == bool(from_load):
        words = "both are given" if stated else "neither is given"
        raise tree.place.error(f"center of gravity and axle load: {words}",
                               "one of them: cg_x_m, or the load in front")  # fmt: skip
    x = stated or from_load
    if not 0.0 < x < base:
        raise tree.place.error(f"the center of gravity lies {x:.2f} m behind the front",
                               f"between 0 and the wheelbase of {base:g} m")  # fmt: skip
    return x


def _places(middle_m: float, count: int, spread_m: float) -> tuple[float, ...]:
    return tuple(middle_m + spread_m * (k - 0.5 * (count - 1)) for k in range(count))


def _name(group: str, k: int, count: int) -> str:
    return group if count == 1 else f"{group}_{k + 1}"


def _at(tree: Branch, key: str) -> Place:
    return tree.entries[key].place if key in tree.entries else tree.place


def _whole(number: float, tree: Branch, key: str) -> int:
    if number != int(number):
        raise _at(tree, key).error(f"{number:g} axles", "a whole number")
    return int(number)


def _tires(number: float, tree: Branch, key: str) -> int:
    if number not in (2.0, 4.0):
        raise _at(tree, key).error(f"{number:g} tires on an axle", "2 or 4")
    return int(number)
