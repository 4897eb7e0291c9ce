"""A vehicle file in the making: values with sources and spreads under dotted keys."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from truck_blowout_sim.vehicle.document import Branch, Leaf, Place
from truck_blowout_sim.vehicle.reading import Notes
from truck_blowout_sim.vehicle.single_track.plan import UnitPlan
from truck_blowout_sim.vehicle.single_track.rules import Rules

RULE = "rule of thumb: "
SECTION = {"tractor": "single_track", "trailer": "single_track.trailer"}
STATED = "computed from what the single-track section states"


class Draft:
    """Collects the values of a vehicle, all of them placed at the section they come from.

    Attributes:
        place: the single-track section.
        entries: values by dotted SI key.
        notes: sources and spreads that stand beside what is stated.
    """

    def __init__(self, place: Place, notes: Notes) -> None:
        self.place = place
        self.entries: dict[str, Leaf] = {}
        self.notes = notes

    def spread_of(self, unit: UnitPlan, key: str) -> float:
        """Spread that the file states beside a value of a unit; 0 where it states none."""
        return self.notes.spreads.get(f"{SECTION[unit.name]}.{key}", 0.0)

    def put(self, key: str, value: Any, source: str = STATED, spread: float = 0.0) -> None:  # noqa: ANN401
        """Set a value; a spread of 0 says nothing about how well it is known."""
        self.entries[key] = Leaf(value, source, self.place, spread=spread or None)

    def rule(self, key: str, rules: Rules, name: str, factor: float = 1.0, *,
             stated: float = 0.0, told: float = 0.0) -> float:  # fmt: skip
        """Set a value by rule, or the stated one, with its spread, if there is one (not 0)."""
        if stated:
            self.put(key, stated, spread=told)
            return stated
        value = factor * float(getattr(rules.spec, name))
        spread = abs(factor) * rules.notes.spreads[name]
        self.put(key, value, f"{RULE}{rules.source(name)}", spread)
        return value

    def ruled(self, key: str, value: float, rules: Rules, *names: str) -> None:
        """Set a value computed with rules; their relative spreads add up as squares."""
        spread = sum(rules.relative_spread(name) ** 2 for name in names) ** 0.5 * abs(value)
        self.put(key, value, RULE + "; ".join(dict.fromkeys(map(rules.source, names))), spread)

    def tree(self) -> Branch:
        """The draft as the tree of a file."""
        nested: dict[str, Any] = {}
        for key, leaf in self.entries.items():
            here = nested
            *above, last = key.split(".")
            for name in above:
                here = here.setdefault(name, {})
            here[last] = leaf
        return self._branch(nested)

    def _branch(self, nested: Mapping[str, Any]) -> Branch:
        return Branch(self.place, {
            key: entry if isinstance(entry, Leaf) else self._branch(entry)
            for key, entry in nested.items()
        })  # fmt: skip
