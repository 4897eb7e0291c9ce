"""A YAML file as a tree that remembers lines and sources.

A value is written either plainly (`mass_kg: 5694`) or with where it comes from and how far the
truth may lie from it, one standard deviation (`mass_kg: {value: 5694, spread: 50, source:
"weighed"}`). Keys come out in SI (`mass_lb` as `mass_kg`), so that a file that extends another may
use its own units.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import lru_cache
from pathlib import Path
from typing import Any, NamedTuple

import yaml

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.resources import config_file
from truck_blowout_sim.vehicle.units import si_key
from truck_blowout_sim.yaml_numbers import FAST_LOADER

MOST_NODES = 100_000
MERGE_TAG = "tag:yaml.org,2002:merge"
_KEPT_DOCUMENTS = 64
_LEAF_KEYS = frozenset({"value", "source", "spread"})


class Place(NamedTuple):
    """Where something stands: file, line from 1 or 0 for none, dotted key as written."""

    file: str
    line: int
    key: str

    def error(self, problem: str, expected: str | None = None) -> InputError:
        """An `InputError` that points here."""
        line = f"line {self.line}" if self.line > 0 else ""
        where = ": ".join(filter(None, (line, self.key)))
        return InputError(problem, file=self.file, where=where, expected=expected)

    def below(self, key: str, line: int) -> Place:
        """The place of a key inside this one."""
        return Place(self.file, line, f"{self.key}.{key}" if self.key else key)


@dataclass(frozen=True)
class Leaf:
    """One value with its source; `factor` takes it, and its spread, to the unit of the SI key."""

    value: Any
    source: str
    place: Place
    factor: float = 1.0
    spread: float | None = None


@dataclass(frozen=True)
class Branch:
    """A mapping; keys are SI."""

    place: Place
    entries: dict[str, Leaf | Branch] = field(default_factory=dict)


def read_document(path: Path, kind: str) -> Branch:
    """Read a file together with everything it extends.

    Args:
        path: the file.
        kind: folder of the shipped files an `extends` may name: "vehicles", "tires", ...

    Raises:
        InputError: unreadable, not YAML, not a mapping, or extending itself.
    """
    return _read(path, kind, ())


def extended(tree: Branch, kind: str) -> Branch:
    """A section written inside another file, together with the file of `kind` that it extends.

    Raises:
        InputError: see `read_document`.
    """
    return _extended(tree, Path(tree.place.file), kind, ())


def _read(path: Path, kind: str, children: tuple[Path, ...]) -> Branch:
    return _extended(parse(path), path, kind, children)


def _extended(tree: Branch, path: Path, kind: str, children: tuple[Path, ...]) -> Branch:
    base = tree.entries.get("extends")
    if base is None:
        return tree
    own = Branch(tree.place, {k: v for k, v in tree.entries.items() if k != "extends"})
    if not isinstance(base, Leaf) or not isinstance(base.value, str):
        raise base.place.error("extends is not a name", "the name of a file, or a path")
    base_path = _find(base, path, kind)
    if base_path.resolve() in {child.resolve() for child in (*children, path)}:
        raise base.place.error(f"{base.value!r} extends itself", "another file")
    return merge(_read(base_path, kind, (*children, path)), own)


def _find(base: Leaf, path: Path, kind: str) -> Path:
    beside = path.parent / str(base.value)
    for candidate in (beside, beside.with_name(f"{beside.name}.yaml")):
        if candidate.is_file() and candidate.resolve() != path.resolve():
            return candidate
    try:
        return config_file(kind, base.value)
    except InputError as error:
        raise base.place.error(error.problem, error.expected) from None


def merge(base: Branch, child: Branch) -> Branch:
    """`base` with the values of `child` put over it, key by key; an empty value removes a key."""
    entries = dict(base.entries)
    for key, entry in child.entries.items():
        below = entries.get(key)
        if isinstance(entry, Leaf) and entry.value is None:
            if below is None:
                raise entry.place.error("is empty", "a value, or a key of the extended file")
            del entries[key]
        elif isinstance(entry, Branch) and isinstance(below, Branch):
            entries[key] = merge(below, entry)
        else:
            entries[key] = entry
    return Branch(child.place, entries)


def parse(path: Path) -> Branch:
    """Read one file, without what it extends. A file that has not changed is parsed once.

    Raises:
        InputError: unreadable, not UTF-8, not YAML, keys given twice, or not a mapping.
    """
    try:
        state = path.stat()
    except OSError:
        return _parse(path)  # says what is wrong
    whole = _parsed(path, state.st_mtime_ns, state.st_size)
    # readers take keys out of the top of a document; below it nothing is ever changed
    return Branch(whole.place, dict(whole.entries))


@lru_cache(maxsize=_KEPT_DOCUMENTS)
def _parsed(path: Path, changed_ns: int, size: int) -> Branch:
    return _parse(path)


def _parse(path: Path) -> Branch:
    start = Place(str(path), 1, "")
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(
            f"cannot be read: {error}", file=path, expected="a YAML file in UTF-8"
        ) from error
    try:
        loader = FAST_LOADER(text)
        try:
            return _Reader(loader).document(start)
        finally:
            loader.dispose()
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        line = mark.line + 1 if mark else 1
        problem = getattr(error, "problem", None) or str(error)
        raise Place(str(path), line, "").error(f"is not YAML: {problem}") from error
    except (ValueError, RecursionError) as error:
        raise start.error(f"is not YAML: {error}") from error


class _Reader:
    """Walks the nodes of one document; anchors make them a graph, so it keeps count."""

    def __init__(self, loader: yaml.SafeLoader) -> None:
        self._loader = loader
        self._flat: set[int] = set()
        self._visited = 0

    def document(self, start: Place) -> Branch:
        node = self._loader.get_single_node()
        if not isinstance(node, yaml.MappingNode):
            raise start.error("holds no keys", "a YAML mapping")
        return self._branch(node, start)

    def _branch(self, node: yaml.MappingNode, place: Place) -> Branch:
        self._flatten(node, place)
        entries: dict[str, Leaf | Branch] = {}
        for key_node, value_node in node.value:
            key = str(key_node.value)
            here = place.below(key, key_node.start_mark.line + 1)
            entry = self._entry(value_node, here)
            name = key
            if isinstance(entry, Leaf):
                name, factor = si_key(key)
                entry = replace(entry, factor=factor)
            entries[name] = entry
        return Branch(place, entries)

    def _flatten(self, node: yaml.MappingNode, place: Place) -> None:
        """Refuse keys given twice, also in two units; then take in what `<<` names, once."""
        if id(node) in self._flat:
            return
        self._flat.add(id(node))
        seen: dict[str, int] = {}
        for key_node, _ in node.value:
            if key_node.tag == MERGE_TAG:
                continue
            line = key_node.start_mark.line + 1
            if not isinstance(key_node, yaml.ScalarNode):
                raise place.below("?", line).error("a key is not a word", "a name")
            name, _ = si_key(key_node.value)
            if name in seen:
                here = place.below(key_node.value, line)
                raise here.error(f"is given twice, first in line {seen[name]}", "one value")
            seen[name] = line
        self._loader.flatten_mapping(node)

    def _entry(self, node: yaml.Node, place: Place) -> Leaf | Branch:
        self._count(place)
        if not isinstance(node, yaml.MappingNode):
            return Leaf(self._plain(node, place), "", place)
        keys = {key.value for key, _ in node.value if isinstance(key, yaml.ScalarNode)}
        if "value" not in keys:
            return self._branch(node, place)
        if extra := sorted(keys - _LEAF_KEYS):
            raise place.error(f"unknown key {extra[0]!r} beside a value", "value, source, spread")
        self._flatten(node, place)
        parts = {key.value: self._plain(value, place) for key, value in node.value}
        source = parts.get("source", "")
        if not isinstance(source, str):
            raise place.error(f"source {source!r} is not a text", "words in quotes")
        return Leaf(parts["value"], source, place, spread=_spread(parts.get("spread"), place))

    def _plain(self, node: yaml.Node, place: Place) -> object:
        self._count(place)
        if isinstance(node, yaml.MappingNode):
            raise place.error("is a mapping", "a value")
        if isinstance(node, yaml.SequenceNode):
            return [self._plain(item, place) for item in node.value]
        value: object = self._loader.construct_object(node)
        return value

    def _count(self, place: Place) -> None:
        self._visited += 1
        if self._visited > MOST_NODES:
            raise place.error("is too large, or contains itself", f"at most {MOST_NODES} values")


def _spread(value: object, place: Place) -> float | None:
    """A standard deviation beside a value; None where none is given."""
    if value is None:
        return None
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not value > 0.0:
        raise place.error(f"spread {value!r} is no standard deviation", "a number above 0")
    return float(value)
