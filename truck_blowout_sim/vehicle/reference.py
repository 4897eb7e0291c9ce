"""The reference of all keys, as Markdown, from the schema itself.

`python -m truck_blowout_sim.vehicle.reference docs/vehicle_files.md` brings that page up to date;
without a file it prints. A test holds the page against the schema.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
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

FILES = {
    "Vehicle (`config/vehicles`)": VehicleSpec,
    "Single track (section `single_track` of a vehicle)": SingleTrackSpec,
    "Rules of thumb (`config/single_track`)": RulesSpec,
    "Tire (`config/tires`)": TireSpec,
    "Blowout (`config/blowout`)": BlowoutSpec,
    "Road (`config/roads`)": RoadSpec,
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


COMMENT_COLUMN = 34  # where comments begin, if the key is shorter


def reference_markdown() -> str:
    """Every key of every file as commented YAML, then every parameter only `effects:` reaches."""
    lines: list[str] = []
    for title, section in FILES.items():
        lines += [f"### {title}", "", *key_block(section), ""]
    lines += ["### Parameters that only `effects:` sets", "", "With their neutral values:", "",
              "```yaml"]
    lines += [
        f"{BLOCKS[block.__name__]}.{name}: {'never' if isinf(value) else f'{value:g}'}"
        for block, values in NEUTRAL.items()
        for name, value in values.items()
    ]
    return "\n".join([*lines, "```"]) + "\n"


def key_block(section: type[Any], more: Sequence[str] = ()) -> list[str]:
    """A fenced block of YAML with every key of a section, and further lines."""
    return ["```yaml", *key_lines(section, "", "", {}), *more, "```"]


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


def write_into(page: Path) -> None:
    """Replace the reference at the end of a page by the present one."""
    words, _, _ = page.read_text(encoding="utf-8").partition(f"### {next(iter(FILES))}")
    page.write_text(words + reference_markdown(), encoding="utf-8")


if __name__ == "__main__":
    for name in sys.argv[1:]:
        write_into(Path(name))
    if not sys.argv[1:]:
        sys.stdout.write(reference_markdown())
