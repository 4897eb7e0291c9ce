"""Keys that a study varies: any key of the scenario, vehicle, tire, blowout or road file.

A key is written as in its file, with dots between sections and in any unit the file may have:
`start.speed_mph`, `units.trailer.payload.*.mass_kg`, `tires.steer.pressure_psi`,
`road.friction_scale`. A `*` stands for every name at its place. `scenario.` or `vehicle.` goes
before a key that both have. A packed parameter (`hub.trailer_2_left.brake_gain`) is set last, over
what the files say.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from fnmatch import fnmatchcase
from typing import Any

from truck_blowout_sim.errors import InputError, quoted
from truck_blowout_sim.simulation.scenario_schema import ScenarioSpec
from truck_blowout_sim.simulation.studies.suggesting import suggestion
from truck_blowout_sim.vehicle import Packed
from truck_blowout_sim.vehicle.document import Branch, Leaf, Place
from truck_blowout_sim.vehicle.fields import rules
from truck_blowout_sim.vehicle.loading import named_document
from truck_blowout_sim.vehicle.schema.road import RoadSpec
from truck_blowout_sim.vehicle.schema.tire import BlowoutSpec, TireSpec
from truck_blowout_sim.vehicle.schema.vehicle import VehicleSpec
from truck_blowout_sim.vehicle.units import si_key

SCENARIO, VEHICLE, PARAMETER, FILE = "scenario", "vehicle", "parameter", "file"
FILE_KEY = "vehicle"  # the word that stands for the vehicle file itself
# Keys of a vehicle file that name another file: its kind and its schema.
_NAMED: dict[str, tuple[str, type[Any]]] = {
    "tires": ("tires", TireSpec), "blowout": ("blowout", BlowoutSpec), "road": ("roads", RoadSpec),
}


@dataclass(frozen=True)
class Key:
    """A key that was found.

    Attributes:
        text: as it was written.
        where: `SCENARIO`, `VEHICLE`, `PARAMETER`, or `FILE` for the word ``vehicle`` itself.
        paths: the places it stands for, each a path of SI names.
        factor: from the unit it is written in to SI.
        numeric: whether it takes numbers.
    """

    text: str
    where: str
    paths: tuple[tuple[str, ...], ...]
    factor: float = 1.0
    numeric: bool = True

    def within(self, tree: Branch) -> Key:
        """The same key in another vehicle's file, in which its ``*`` may stand for other names.

        Raises:
            InputError: the ``*`` stands for nothing there.
        """
        if not set(self.text) & set("*?["):
            return self
        match = _match(tree, VehicleSpec, tuple(self.text.removeprefix("vehicle.").split(".")))
        if match is None:
            raise InputError(f"--vary {quoted(self.text)}: this vehicle has no such key",
                             file=tree.place.file, expected="names that all its vehicles have")
        return Key(self.text, self.where, *match)

    def put(self, tree: Branch, value: float | str) -> Branch:
        """A copy of its document with a value in its places; ``"1.5x"`` scales what is there.

        Raises:
            InputError: nothing there to scale.
        """
        for path in self.paths:
            place = Place(f"--vary {self.text}", 0, "")
            kind = _NAMED[path[0]][0] if path[0] in _NAMED else ""
            tree = _put(tree, path, _leaf(value, self.factor, place), self, kind)
        return tree


def find_key(text: str, scenario: Branch, vehicle: Branch, packed: Packed, *,
             suggest: bool = True) -> Key:
    """Find a key in the files of a study.

    Args:
        text: the key as written.
        scenario, vehicle: the files.
        packed: the vehicle, packed.
        suggest: look for the nearest key if there is none.

    Raises:
        InputError: no such key, with the nearest one; or both files have it.
    """
    if text == FILE_KEY:
        return Key(text, FILE, ((),), numeric=False)
    word, _, rest = text.partition(".")
    trees = {SCENARIO: (scenario, ScenarioSpec), VEHICLE: (vehicle, VehicleSpec)}
    wanted = rest if word in trees else text
    found = []
    for where, (tree, schema) in trees.items():
        if word in (where, *(() if word in trees else (word,))):
            match = _match(tree, schema, tuple(wanted.split(".")))
            if match:
                found.append(Key(text, where, *match))
    if len(found) > 1:
        raise InputError(f"--vary {quoted(text)}: scenario and vehicle both have this key",
                         expected=f"scenario.{text} or vehicle.{text}")
    if found:
        return found[0]
    if text in packed.index:
        return Key(text, PARAMETER, ((text,),))
    if not suggest:
        raise InputError(f"no key {quoted(text)}")
    raise _unknown(text, scenario, vehicle, packed)


def _unknown(text: str, scenario: Branch, vehicle: Branch, packed: Packed) -> InputError:
    def is_key(key: str) -> bool:
        try:
            find_key(key, scenario, vehicle, packed, suggest=False)
        except InputError:
            return False
        return True

    trees = {SCENARIO: (scenario, ScenarioSpec), VEHICLE: (vehicle, VehicleSpec)}
    word, _, rest = text.partition(".")
    known = [".".join(path) for where, (tree, schema) in trees.items()
             for path in _leaves(tree, schema) if word not in trees or word == where]
    if word != SCENARIO:
        known += [".".join(path) for path in _leaves_of_named(vehicle)]
    if word in trees:
        near = suggestion(rest, known, lambda key: is_key(f"{word}.{key}"))
        near = f"{word}.{near}" if near else ""
    else:
        near = suggestion(text, [FILE_KEY, *known, *packed.index], is_key)
    hint = f", did you mean {near!r}?" if near else ""
    return InputError(f"--vary {quoted(text)}: no such key{hint}", expected=None if near else
                      "a key of the scenario, vehicle, tire, blowout or road file")


def _match(tree: Branch | Leaf | None, schema: type[Any] | None, words: tuple[str, ...],
           before: tuple[str, ...] = ()) -> tuple[tuple[tuple[str, ...], ...], float, bool] | None:
    """Paths a dotted key stands for, its factor, and whether it takes numbers; None: no such key.

    ``schema`` None: a section of named things, whose names the tree has.
    """
    word, rest = words[0], words[1:]
    if schema is None:
        return None
    if schema is VehicleSpec and word in _NAMED and rest:
        return _match_named(tree, word, rest)
    name, factor = (word, 1.0) if rest else si_key(word)
    rule = rules(schema).get(name)
    if rule is None:
        return None
    if not rest:
        usable = rule.kind not in ("section", "sections", "numbers")
        return (((*before, name),), factor, rule.kind == "number") if usable else None
    below = tree.entries.get(name) if isinstance(tree, Branch) else None
    if rule.kind == "section":
        return _match(below, rule.section, rest, (*before, name))
    if rule.kind != "sections" or not isinstance(below, Branch) or rule.section is None:
        return None
    found = [_match(below.entries[key], rule.section, rest[1:], (*before, name, key))
             for key in below.entries if fnmatchcase(key, rest[0])] if len(rest) > 1 else []
    whole = [one for one in found if one is not None]
    if not whole:
        return None
    return tuple(path for one in whole for path in one[0]), whole[0][1], whole[0][2]


def _match_named(tree: Branch | Leaf | None, word: str, rest: tuple[str, ...]
                 ) -> tuple[tuple[tuple[str, ...], ...], float, bool] | None:
    """As `_match`, in a file that the vehicle file names: a tire, the blowout law, the road."""
    _, schema = _NAMED[word]
    if word != "tires":
        return _match(None, schema, rest, (word,))
    places = tree.entries.get(word) if isinstance(tree, Branch) else None
    if not isinstance(places, Branch):
        return None
    names = [key for key in places.entries if fnmatchcase(key, rest[0])]
    if not names:
        return None
    if len(rest) == 1:  # the tire file itself
        return tuple((word, key) for key in names), 1.0, False
    one = _match(None, schema, rest[1:])
    if one is None:
        return None
    return tuple((word, key, *one[0][0]) for key in names), one[1], one[2]


def _leaves(tree: Branch, schema: type[Any], before: tuple[str, ...] = ()
            ) -> Iterable[tuple[str, ...]]:
    """Paths of every key that a document may have."""
    for name, rule in rules(schema).items():
        below = tree.entries.get(name)
        section = below if isinstance(below, Branch) else Branch(tree.place)
        if rule.kind == "section":
            yield from _leaves(section, rule.section, (*before, name))
        elif rule.kind == "sections" and rule.section is not None:
            for key, entry in section.entries.items():
                if isinstance(entry, Branch):
                    yield from _leaves(entry, rule.section, (*before, name, key))
        else:
            yield (*before, name)


def _leaves_of_named(vehicle: Branch) -> Iterable[tuple[str, ...]]:
    """Paths of every key of the files that a vehicle file names."""
    for word, (_, schema) in _NAMED.items():
        below = vehicle.entries.get(word)
        places: list[tuple[str, ...]] = [(word,)]
        if word == "tires":
            names = below.entries if isinstance(below, Branch) else ()
            places = [(word, name) for name in names]
        yield from ((*place, key) for place in places for key in rules(schema))


def _leaf(value: float | str, factor: float, place: Place) -> Leaf:
    return Leaf(value, "", place, factor=1.0 if isinstance(value, str) else factor)


def _put(tree: Branch, path: tuple[str, ...], leaf: Leaf, key: Key, kind: str) -> Branch:
    """A copy of a document with one leaf put in; a file of ``kind`` named on the way is opened."""
    name, rest = path[0], path[1:]
    here = tree.entries.get(name)
    if not rest:
        return _with(tree, name, _scaled(leaf, here, key))
    if isinstance(here, Leaf):
        here = named_document(kind, here)
    return _with(tree, name, _put(here or Branch(leaf.place), rest, leaf, key, kind))


def _scaled(leaf: Leaf, here: Leaf | Branch | None, key: Key) -> Leaf:
    scale = scale_of(leaf.value)
    if scale is None or not key.numeric:
        return leaf
    if not isinstance(here, Leaf) or not isinstance(here.value, (int, float)):
        raise InputError(f"--vary {quoted(key.text)}: the file has no number to scale",
                         expected="values without x")
    return replace(here, value=here.value * scale)


def scale_of(value: object) -> float | None:
    """1.5 of ``"1.5x"``; None of anything else."""
    if isinstance(value, str) and value.endswith("x"):
        try:
            return float(value[:-1])
        except ValueError:
            return None
    return None


def _with(tree: Branch, name: str, entry: Leaf | Branch) -> Branch:
    entries: Mapping[str, Leaf | Branch] = {**tree.entries, name: entry}
    return Branch(tree.place, dict(entries))
