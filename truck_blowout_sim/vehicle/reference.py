"""The reference of all keys, as commented YAML files, from the schema itself.

`python -m truck_blowout_sim.vehicle.reference docs/reference/keys` brings the files up to date. A
test holds them against the schema.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping, Sequence
from math import isfinite, isinf
from pathlib import Path
from typing import Any

from truck_blowout_sim.vehicle.fields import Rule, required, rules
from truck_blowout_sim.vehicle.packing.blocks import NEUTRAL
from truck_blowout_sim.vehicle.schema.road import RoadSpec
from truck_blowout_sim.vehicle.schema.tire import BlowoutSpec, TireSpec
from truck_blowout_sim.vehicle.schema.vehicle import VehicleSpec
from truck_blowout_sim.vehicle.single_track.rules import RulesSpec
from truck_blowout_sim.vehicle.single_track.schema import SingleTrackSpec

FILES: dict[str, tuple[str, type[Any]]] = {
    "vehicle": ("a vehicle file (config/vehicles)", VehicleSpec),
    "single_track": ("the section single_track of a vehicle file", SingleTrackSpec),
    "rules_of_thumb": ("a file of config/single_track", RulesSpec),
    "tire": ("a tire file (config/tires)", TireSpec),
    "blowout": ("a blowout file (config/blowout)", BlowoutSpec),
    "road": ("a road file (config/roads)", RoadSpec),
}
BLOCKS = {
    "WorldParams": "world",
    "SteeringParams": "steering",
    "CouplingParams": "fifth_wheel",
    "DrivelineParams": "driveline",
    "AbsParams": "abs",
    "CircuitParams": "circuit.<circuit>",
    "UnitParams": "unit.<unit>",
    "AxleParams": "axle.<axle>",
    "HubParams": "hub.<hub>",
    "TireParams": "tire.<tire>",
}


COMMENT_COLUMN = 30  # where comments begin, if the key is shorter


def key_files() -> dict[str, str]:
    """Text of a YAML file by its name: every key of every file, and what only `effects:` sets."""
    files = {name: key_file(about, section) for name, (about, section) in FILES.items()}
    effects = [
        f"{BLOCKS[block.__name__]}.{name}: {'never' if isinf(value) else f'{value:g}'}"
        for block, values in NEUTRAL.items()
        for name, value in values.items()
    ]
    head = "# Parameters that only the section effects sets, with their neutral values."
    return files | {"effects": "\n".join([head, *effects]) + "\n"}


def key_file(about: str, section: type[Any], more: Sequence[str] = ()) -> str:
    """Every key of a section as commented YAML, and further lines."""
    head = f"# Every key of {about}: what it accepts and what it means."
    return "\n".join([head, *key_lines(section, "", "", {}), *more]) + "\n"


def key_lines(section: type[Any], prefix: str, indent: str,
              shown: dict[type[Any], str]) -> Iterator[str]:
    """A line of YAML for every key of a section and of the sections below it.

    Args:
        prefix: of the keys; ``shown``: sections that have their lines already, filled on the way.
    """
    needed = required(section)
    for key, rule in rules(section).items():
        name = f"{prefix}{key}"
        again = shown.setdefault(rule.section, name) if rule.section else name
        doc = rule.doc if again == name else f"{rule.doc}; keys as in {again}"
        accepts = _accepts(rule, needed=key in needed)
        yield key_line(f"{indent}{key}", f"{accepts}: {doc}" if accepts else doc)
        if rule.section is not None and again == name:
            named = rule.kind == "sections"
            if named:
                yield f"{indent}  <name>:"
            yield from key_lines(rule.section, f"{name}.<name>." if named else f"{name}.",
                                 indent + ("    " if named else "  "), shown)


def key_line(key: str, comment: str) -> str:
    """A key without a value, and a comment on it."""
    return f"{key + ':':{COMMENT_COLUMN}}  # {comment}"


def _accepts(rule: Rule, *, needed: bool) -> str:
    words = {
        "number": _bounds(rule),
        "numbers": "list",
        "switch": "true, false",
        "choice": " | ".join(rule.options),
        "text": "text",
        "section": "",
        "sections": "" if rule.section else "names",
    }[rule.kind]
    return words if needed else ", ".join(filter(None, (words, "optional")))


def _bounds(rule: Rule) -> str:
    if isfinite(rule.low) and isfinite(rule.high) and not rule.open_low:
        return f"{rule.low:g} to {rule.high:g}"
    parts = []
    if isfinite(rule.low):
        parts.append(f"{'>' if rule.open_low else '>='} {rule.low:g}")
    if isfinite(rule.high):
        parts.append(f"<= {rule.high:g}")
    return ", ".join(parts) or "number"


def write_files(folder: Path, files: Mapping[str, str]) -> None:
    """Write every text as a YAML file of its name into a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in files.items():
        (folder / f"{name}.yaml").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    write_files(Path(sys.argv[1]), key_files())
