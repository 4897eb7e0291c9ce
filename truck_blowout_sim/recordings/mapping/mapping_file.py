"""Mapping files read from YAML: every key checked, an unknown one named with the nearest.

Validated with: test/recordings/test_mapping.py (fuzzed by hypothesis).
"""

from __future__ import annotations

import math
import os
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, NoReturn

import yaml

from truck_blowout_sim.errors import InputError, nearest, quoted
from truck_blowout_sim.recordings.bag_metadata import NOT_YAML
from truck_blowout_sim.recordings.channels import UNITS
from truck_blowout_sim.recordings.mapping.rules import Also, Mount, Rules, Source, TimeRule
from truck_blowout_sim.recordings.recording import Blowout
from truck_blowout_sim.recordings.units import find_unit
from truck_blowout_sim.yaml_numbers import LOADER, load_yaml

_KEYS = ("time", "channels", "topics", "shift_s", "also", "blowouts", "exclude", "sensors",
         "metadata")  # fmt: skip
_LONGEST_FILE = 1 << 20


def load_mapping(path: str | os.PathLike[str]) -> Rules:
    """Read a mapping file.

    Raises:
        InputError: file, key, what was found and what was expected, in one line.
    """
    path = Path(path)
    try:
        data = path.read_bytes()
    except OSError as error:
        raise InputError((error.strerror or "cannot be read").lower(), file=path,
                         expected="a mapping file (YAML)") from None  # fmt: skip
    if len(data) > _LONGEST_FILE:
        raise InputError(f"has {len(data)} bytes", file=path, expected="a mapping file (YAML)")
    try:
        text = data.decode("utf-8-sig")
        tree = load_yaml(text)
        doubled = _doubled_key(yaml.compose(text, Loader=LOADER), "", set())
    except NOT_YAML as error:
        mark = getattr(error, "problem_mark", None)
        where = f"line {mark.line + 1}" if mark else ""
        raise InputError("is not YAML", file=path, where=where,
                         expected="a mapping file (YAML)") from None  # fmt: skip
    if doubled:
        raise InputError("stands there twice", file=path, where=f"key {doubled}",
                         expected="each key once")  # fmt: skip
    return replace(rules_from({} if tree is None else tree, path), file=path)


def _doubled_key(node: yaml.Node | None, place: str, seen: set[int]) -> str:
    """The first key that one table of a YAML file holds twice; empty if there is none."""
    if id(node) in seen:
        return ""  # an alias; it may hold itself
    seen.add(id(node))
    parts: list[tuple[str, yaml.Node]] = []
    if isinstance(node, yaml.MappingNode):
        parts = [(f"{place}.{key.value}".lstrip("."), value) for key, value in node.value]
        count = Counter(name for name, _ in parts)
        if twice := next((name for name, times in count.items() if times > 1), ""):
            return twice
    elif isinstance(node, yaml.SequenceNode):
        parts = [(f"{place}.{at}", value) for at, value in enumerate(node.value, 1)]
    found = (_doubled_key(value, name, seen) for name, value in parts)
    return next((name for name in found if name), "")


def rules_from(tree: object, file: Path | None = None) -> Rules:
    """Rules from the tree of a mapping file.

    Raises:
        InputError: a key or value that is not one.
    """
    top = _Node(tree, "", file)
    top.keys(_KEYS)
    return Rules(
        file=file,
        time=_time(top.get("time")),
        channels={name: _source(node) for name, node in top.get("channels").entries()},
        topics=_topics(top.get("topics")),
        shift_s={name: node.number() for name, node in top.get("shift_s").entries()},
        also=tuple(_also(node) for node in top.get("also").items()),
        blowouts=tuple(_blowout(node) for node in top.get("blowouts").items()),
        exclude=tuple(node.text() for node in top.get("exclude").items()),
        sensors={unit: _mount(node) for unit, node in top.get("sensors").entries(UNITS)},
        metadata={name: node.text() for name, node in top.get("metadata").entries()},
    )


class _Node:
    """A value of the tree, and the key under which it stands."""

    def __init__(self, value: object, key: str, file: Path | None) -> None:
        self.value, self.key, self.file = value, key, file

    def fail(self, expected: str, problem: str = "") -> NoReturn:
        raise InputError(
            problem or f"is {quoted(self.value)}", file=self.file or "mapping",
            where=f"key {self.key}" if self.key else "", expected=expected,
        )  # fmt: skip

    def inside(self, name: object, value: object) -> _Node:
        return _Node(value, f"{self.key}.{name}" if self.key else str(name), self.file)

    def keys(self, known: Sequence[str]) -> Mapping[str, Any]:
        if not isinstance(self.value, dict):
            self.fail(f"keys and values: {', '.join(known)}")
        for name in self.value:
            if name not in known:
                self.inside(name, None).fail(
                    nearest(str(name), known, ", ".join(known)), "unknown key")  # fmt: skip
        return self.value

    def get(self, name: str) -> _Node:
        held = self.value.get(name) if isinstance(self.value, dict) else None
        return self.inside(name, held)

    def entries(self, known: Sequence[str] = ()) -> list[tuple[str, _Node]]:
        if self.value is None:
            return []
        if not isinstance(self.value, dict):
            self.fail("names, each with a value")
        if known:
            self.keys(known)
        return [(str(name), self.inside(name, value)) for name, value in self.value.items()]

    def items(self) -> list[_Node]:
        if self.value is None:
            return []
        if not isinstance(self.value, list):
            self.fail("a list: [a, b]")
        return [self.inside(i + 1, value) for i, value in enumerate(self.value)]

    def text(self) -> str:
        if isinstance(self.value, (dict, list)) or self.value is None:
            self.fail("a text")
        return str(self.value)

    def number(
        self, check: Callable[[float], bool] = math.isfinite, expected: str = "a finite number"
    ) -> float:
        value = self.value
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            self.fail("a number")
        if abs(value) > 1e300 or not check(float(value)):
            self.fail(expected)
        return float(value)


def _time(node: _Node) -> TimeRule:
    if node.value is None:
        return TimeRule()
    if isinstance(node.value, str):
        return TimeRule(node.value)
    node.keys(("from", "unit"))
    unit = _optional_text(node.get("unit"))
    if unit:
        found = find_unit(unit)
        if found is None or found.quantity != "time":
            node.get("unit").fail("s, ms, us, ns, min, h, day or hhmmss")
    return TimeRule(_optional_text(node.get("from")), unit)


def _source(node: _Node) -> Source:
    if isinstance(node.value, str):
        return Source(node.value, key=node.key)
    node.keys(("from", "unit", "sign", "offset", "file", "radius_m"))
    sign, offset, radius = (node.get(key) for key in ("sign", "offset", "radius_m"))
    return Source(
        column=node.get("from").text(),
        unit=_optional_text(node.get("unit")),
        sign=1.0 if sign.value is None else sign.number(lambda v: abs(v) == 1.0, "1 or -1"),
        offset=0.0 if offset.value is None else offset.number(),
        file=_optional_text(node.get("file")),
        key=node.key,
        radius_m=0.0 if radius.value is None else radius.number(_wheel, "metres, 0.1 to 2"),
    )


def _topics(node: _Node) -> dict[str, str]:
    found: dict[str, str] = {}
    for theirs, one in node.entries():
        ours = one.text()
        if ours in found:
            one.fail("each topic of the table once")
        found[ours] = theirs
    return found


def _also(node: _Node) -> Also:
    if isinstance(node.value, str):
        return Also(node.value)
    node.keys(("file", "time", "shift_s"))
    shift = node.get("shift_s")
    return Also(node.get("file").text(), _time(node.get("time")),
                0.0 if shift.value is None else shift.number())  # fmt: skip


def _blowout(node: _Node) -> Blowout:
    node.keys(("tire", "at_s"))
    tires = tuple(part.strip() for part in node.get("tire").text().split("+"))
    return Blowout(node.get("at_s").number(), tires)


def _mount(node: _Node) -> Mount:
    node.keys(("x_m", "y_m", "z_m"))
    lengths = (node.get(axis) for axis in ("x_m", "y_m", "z_m"))
    return Mount(*(0.0 if length.value is None else length.number(_near, "metres, less than 50")
                   for length in lengths))  # fmt: skip


def _optional_text(node: _Node) -> str:
    return "" if node.value is None else node.text()


def _wheel(radius_m: float) -> bool:
    return 0.1 <= radius_m <= 2.0


def _near(length_m: float) -> bool:
    return abs(length_m) < 50.0
