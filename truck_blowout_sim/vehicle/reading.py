"""From the tree of a file to typed sections: every key known, every value inside its bounds."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TypeVar

from truck_blowout_sim.errors import InputError, closest
from truck_blowout_sim.vehicle.document import Branch, Leaf, Place
from truck_blowout_sim.vehicle.fields import Rule, required, rules
from truck_blowout_sim.vehicle.units import in_unit_of, spellings

Section = TypeVar("Section")


@dataclass(frozen=True)
class Notes:
    """What a file says beside its values, by dotted SI key.

    Attributes:
        sources: where a value comes from.
        spreads: how far the truth may lie from it, one standard deviation in SI.
    """

    sources: dict[str, str] = field(default_factory=dict)
    spreads: dict[str, float] = field(default_factory=dict)

    def take(self, path: str, leaf: Leaf) -> None:
        """Keep what is said beside one value."""
        if leaf.source:
            self.sources[path] = leaf.source
        if leaf.spread is not None:
            self.spreads[path] = leaf.spread * leaf.factor


LARGEST = 1e15  # nothing on a road is larger, in SI; squares stay finite


_OF_ANY_FILE = ("extends",)


def build(of: type[Section], tree: Branch, notes: Notes, path: str = "") -> Section:
    """Make the section `of` from a branch.

    Args:
        of: a dataclass made with `vehicle.fields`.
        tree: the branch.
        notes: filled with what stands beside the values.
        path: dotted key of the section.

    Raises:
        InputError: unknown key, missing key, missing unit, wrong type, or out of bounds.
    """
    known = rules(of)
    for key, entry in tree.entries.items():
        if key not in known:
            raise _unknown_key(key, entry, tuple(known))
    for key in required(of):
        if key not in tree.entries:
            raise tree.place.error(f"{key} is missing", " or ".join(spellings(key)))
    values = {
        key: _value(known[key], entry, notes, f"{path}.{key}" if path else key)
        for key, entry in tree.entries.items()
    }
    return of(**values)


def _unknown_key(key: str, entry: Leaf | Branch, known: tuple[str, ...]) -> InputError:
    written = entry.place.key.rpartition(".")[2]
    bare = [name for name in known if name.rpartition("_")[0] == written]
    if bare:
        problem = f"{_shown(entry)} has no unit"
        return entry.place.error(problem, " or ".join(spellings(bare[0])))
    stem, _, suffix = key.rpartition("_")
    same = [name for name in known if stem and name.rpartition("_")[0] == stem]
    if same:
        return entry.place.error(
            f"{_shown(entry)} in {suffix!r}: not a unit of this quantity",
            " or ".join(spellings(same[0])),
        )
    near = closest(key, (*known, *_OF_ANY_FILE), 0.6)
    if near:  # in the unit that was written, where the quantity may have it
        near = in_unit_of(written, near)
        return entry.place.error(f"unknown key {written!r}, did you mean {near!r}?")
    return entry.place.error(f"unknown key {written!r}", f"one of: {', '.join(known)}")


def unknown(place: Place, problem: str, word: str, known: tuple[str, ...]) -> InputError:
    """An error about a name, with the nearest of the known names or all of them."""
    if near := closest(word, known, 0.6):
        return place.error(f"{problem}, did you mean {near!r}?")
    return place.error(problem, f"one of: {', '.join(known)}")


def _shown(entry: Leaf | Branch) -> str:
    return repr(entry.value) if isinstance(entry, Leaf) else "a section"


def _value(rule: Rule, entry: Leaf | Branch, notes: Notes, path: str) -> object:
    if rule.kind == "section":
        return build(rule.section, _branch(entry), notes, path)
    if rule.kind == "sections":
        return _named(rule, _branch(entry), notes, path)
    if isinstance(entry, Branch):
        raise entry.place.error("is a section", _expected(rule))
    notes.take(path, entry)
    return leaf_value(rule, entry)


def _branch(entry: Leaf | Branch) -> Branch:
    if isinstance(entry, Leaf):
        raise entry.place.error(f"{entry.value!r} is not a section", "keys below it")
    return entry


def _named(rule: Rule, tree: Branch, notes: Notes, path: str) -> dict[str, object]:
    if rule.section is None:
        word = Rule("text", rule.doc)
        return {k: _value(word, e, notes, f"{path}.{k}") for k, e in tree.entries.items()}
    return {
        name: build(rule.section, _branch(entry), notes, f"{path}.{name}")
        for name, entry in tree.entries.items()
    }


def leaf_value(rule: Rule, leaf: Leaf) -> object:
    """The checked value of a leaf, in SI.

    Raises:
        InputError: wrong type or out of bounds.
    """
    if rule.kind == "number":
        return _number(rule, leaf.value, leaf)
    if rule.kind == "numbers":
        if not isinstance(leaf.value, list):
            raise leaf.place.error(f"{leaf.value!r} is not a list", _expected(rule))
        return tuple(_number(rule, item, leaf) for item in leaf.value)
    if rule.kind == "switch":
        fits = isinstance(leaf.value, bool)
    else:
        fits = isinstance(leaf.value, str) and leaf.value in (rule.options or (leaf.value,))
    if not fits:
        raise leaf.place.error(f"{leaf.value!r} is not accepted", _expected(rule))
    return leaf.value


def _number(rule: Rule, value: object, leaf: Leaf) -> float:
    number = to_number(value, leaf.place, _expected(rule)) * leaf.factor
    too_low = number <= rule.low if rule.open_low else number < rule.low
    unbounded = abs(number) > LARGEST and not (rule.infinite and math.isinf(number))
    if too_low or number > rule.high or unbounded:
        raise leaf.place.error(f"{value!r} is out of bounds", _expected(rule))
    return number


def to_number(value: object, place: Place, expected: str = "a number") -> float:
    """A YAML scalar as a float, also one in quotes.

    Raises:
        InputError: not a number, or NaN.
    """
    try:
        if isinstance(value, bool) or not isinstance(value, (int, float, str)):
            raise ValueError(value)
        number = float(value)
    except (ValueError, OverflowError):
        raise place.error(f"{value!r} is not a number", expected) from None
    if math.isnan(number):
        raise place.error("is not a number (NaN)", expected)
    return number


def _expected(rule: Rule) -> str:
    if rule.kind == "switch":
        return f"true or false: {rule.doc}"
    if rule.options:
        return f"one of: {', '.join(rule.options)}"
    if rule.kind == "text":
        return f"a text: {rule.doc}"
    words = "a list of numbers" if rule.kind == "numbers" else "a number"
    if math.isfinite(rule.low):
        words += f" greater than {rule.low:g}" if rule.open_low else f" of at least {rule.low:g}"
    if math.isfinite(rule.high):
        words += f" and at most {rule.high:g}"
    return f"{words}: {rule.doc}"
