"""Reading a vehicle with the tire, blowout and road files it names."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from os import PathLike
from pathlib import Path

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.physics.layout import WorldParams
from truck_blowout_sim.resources import config_file
from truck_blowout_sim.vehicle.checks import check_road, check_vehicle
from truck_blowout_sim.vehicle.document import Branch, Leaf, extended, read_document
from truck_blowout_sim.vehicle.packing.chassis import world_block
from truck_blowout_sim.vehicle.reading import Notes, Section, build, to_number, unknown
from truck_blowout_sim.vehicle.schema.axle import AxleSpec
from truck_blowout_sim.vehicle.schema.road import RoadSpec
from truck_blowout_sim.vehicle.schema.tire import BlowoutSpec, TireSpec
from truck_blowout_sim.vehicle.schema.vehicle import VehicleSpec
from truck_blowout_sim.vehicle.single_track import filled_in
from truck_blowout_sim.vehicle.vehicle import Effect, Vehicle, hubs_of_axle, tires_of_hub


def load_vehicle(name_or_path: str | PathLike[str]) -> Vehicle:
    """Load a vehicle by the name of a shipped file or by path.

    Raises:
        InputError: no such file, or something in it cannot be used; one line says what and where.
    """
    path = config_file("vehicles", name_or_path)
    return vehicle_of(read_document(path, "vehicles"), path)


def vehicle_of(document: Branch, path: Path) -> Vehicle:
    """The vehicle that a document describes; the document stays as it is.

    Args:
        path: the document's file; its stem is the vehicle's name.

    Raises:
        InputError: something in it cannot be used.
    """
    tree = Branch(document.place, dict(document.entries))
    effects_entry = tree.entries.pop("effects", None)
    tree, written_out = _sections_as_names(filled_in(tree))
    notes = Notes()
    spec = build(VehicleSpec, tree, notes)
    tire_files, tire_specs = _tires(spec, tree, notes, written_out)
    vehicle = Vehicle(
        name=path.stem,
        path=path,
        spec=spec,
        tire_specs=tire_specs,
        tire_files=tire_files,
        blowout=_named_file(BlowoutSpec, "blowout", tree, notes, "blowout", written_out),
        road=_road(tree, notes, written_out),
        effects=_effects(effects_entry, notes),
        sources=notes.sources,
        spreads=notes.spreads,
    )
    check_vehicle(vehicle, tree)
    return vehicle


def load_road(name_or_path: str | PathLike[str]) -> RoadSpec:
    """Load a road by the name of a shipped file or by path.

    Raises:
        InputError: no such file, or something in it cannot be used.
    """
    document = read_document(config_file("roads", name_or_path), "roads")
    road = build(RoadSpec, document, Notes())
    check_road(road, document)
    return road


def road_values(road: RoadSpec) -> dict[str, float]:
    """The parameters a road sets, by packed name, for `Packed.with_values`."""
    names = WorldParams._fields
    return {f"world.{k}": v for k, v in zip(names, world_block(road), strict=True)}


def _sections_as_names(tree: Branch) -> tuple[Branch, dict[str, Branch]]:
    """Put a name in place of each tire, blowout or road that is written out in the vehicle file.

    Returns:
        The tree with names only, and the sections by their dotted key.
    """
    written_out: dict[str, Branch] = {}

    def named(entries: Mapping[str, Leaf | Branch], keys: Iterable[str], path: str = ""
              ) -> dict[str, Leaf | Branch]:  # fmt: skip
        changed = dict(entries)
        for key in keys:
            entry = entries.get(key)
            if isinstance(entry, Branch):
                written_out[path + key] = entry
                changed[key] = Leaf(key, "", entry.place)
        return changed

    entries = named(tree.entries, ("blowout", "road"))
    tires = entries.get("tires")
    if isinstance(tires, Branch):
        entries["tires"] = Branch(tires.place, named(tires.entries, tires.entries, "tires."))
    return Branch(tree.place, entries), written_out


def _road(tree: Branch, notes: Notes, written_out: Mapping[str, Branch]) -> RoadSpec:
    entry = tree.entries["road"]
    assert isinstance(entry, Leaf)  # `build` has seen to it
    road = _named_file(RoadSpec, "roads", tree, notes, "road", written_out)
    check_road(road, _document("roads", entry, written_out.get("road")))
    return road


def _named_file(of: type[Section], kind: str, tree: Branch, notes: Notes, key: str,
                written_out: Mapping[str, Branch]) -> Section:  # fmt: skip
    entry = tree.entries[key]
    assert isinstance(entry, Leaf)  # `build` has seen to it
    return build(of, _document(kind, entry, written_out.get(key)), notes, key)


def _document(kind: str, entry: Leaf, section: Branch | None) -> Branch:
    """What a key names: a section of the vehicle file itself, or another file."""
    if section is not None:
        return extended(section, kind)
    return named_document(kind, entry)


def named_document(kind: str, entry: Leaf) -> Branch:
    """The document of another file that a key of a vehicle file names.

    Raises:
        InputError: no such file, or it is no document.
    """
    return read_document(_sibling(kind, entry), kind)


def _sibling(kind: str, entry: Leaf) -> Path:
    """The file a key names: shipped, or a path seen from the naming file or from here."""
    beside = Path(entry.place.file).parent / str(entry.value)
    if beside.is_file():
        return beside
    try:
        return config_file(kind, entry.value)
    except InputError as error:
        raise entry.place.error(error.problem, error.expected) from None


def _tires(spec: VehicleSpec, tree: Branch, notes: Notes, written_out: Mapping[str, Branch]
           ) -> tuple[dict[str, str], dict[str, TireSpec]]:  # fmt: skip
    """The file and the kind of every tire of the vehicle."""
    entries = tree.entries["tires"]
    assert isinstance(entries, Branch)
    known = _tire_places(spec.axles)
    for key, entry in entries.entries.items():
        if key not in known:
            problem = f"{key!r} is no axle, hub or tire of this vehicle"
            raise unknown(entry.place, problem, key, tuple(known))
    kinds: dict[str, TireSpec] = {}
    files: dict[str, str] = {}
    for tire, places in known.items():
        if places[0] != tire:
            continue
        named = next((place for place in places if place in spec.tires), None)
        if named is None:
            raise entries.place.error(f"{tire} has no tire file", f"an entry {places[-1]}")
        files[tire] = spec.tires[named]
        if files[tire] not in kinds:
            leaf = entries.entries[named]
            assert isinstance(leaf, Leaf)
            document = _document("tires", leaf, written_out.get(f"tires.{named}"))
            kinds[files[tire]] = build(TireSpec, document, notes, f"tires.{files[tire]}")
    return files, {tire: kinds[file] for tire, file in files.items()}


def _tire_places(axles: Mapping[str, AxleSpec]) -> dict[str, tuple[str, ...]]:
    """Every name a tire entry may have, with the places to look for it, narrowest first.

    A tire's own name comes with itself in front; hubs and axles do not.
    """
    places: dict[str, tuple[str, ...]] = {}
    for name, axle in axles.items():
        for hub in hubs_of_axle(name):
            for tire in tires_of_hub(hub, axle):
                places[tire] = (tire, hub, name)
            places.setdefault(hub, (name,))
        places.setdefault(name, ("",))
    return places


def _effects(entry: Leaf | Branch | None, notes: Notes) -> dict[str, Effect]:
    if entry is None:
        return {}
    if isinstance(entry, Leaf):
        raise entry.place.error(f"{entry.value!r} is not a section", "packed names with values")
    effects: dict[str, Effect] = {}
    for key, leaf in entry.entries.items():
        if isinstance(leaf, Branch):
            raise leaf.place.error("is a section", "a value")
        value = to_number(leaf.value, leaf.place) * leaf.factor
        effects[key] = Effect(value, leaf.source, leaf.place)
        notes.take(f"effects.{key}", leaf)
    return effects
