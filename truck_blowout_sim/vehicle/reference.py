"""The reference of all keys, as Markdown, from the schema itself.

`python -m truck_blowout_sim.vehicle.reference docs/vehicle_files.md` brings that page up to date;
without a file it prints. A test holds the page against the schema.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
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


def reference_markdown() -> str:
    """Every key of every file, then every parameter only `effects:` reaches."""
    lines: list[str] = []
    for title, section in FILES.items():
        lines += [f"### {title}", "", "| key | accepts | meaning |", "|---|---|---|"]
        lines += list(key_rows(section, "", {}))
        lines.append("")
    lines += ["### Parameters that only `effects:` sets", "", "| name | neutral |", "|---|---|"]
    lines += [
        f"| `{BLOCKS[block.__name__]}.{name}` | {'never' if isinf(value) else f'{value:g}'} |"
        for block, values in NEUTRAL.items()
        for name, value in values.items()
    ]
    return "\n".join(lines) + "\n"


def key_rows(section: type[Any], prefix: str, shown: dict[type[Any], str]) -> Iterator[str]:
    """A row of a Markdown table for every key of a section and of the sections below it.

    Args:
        prefix: of the keys; ``shown``: sections that have their rows already, filled on the way.
    """
    needed = required(section)
    for key, rule in rules(section).items():
        name = f"{prefix}{key}"
        again = shown.setdefault(rule.section, name) if rule.section else name
        doc = rule.doc if again == name else f"{rule.doc}; keys as in `{again}`"
        yield f"| `{name}` | {_accepts(rule, needed=key in needed)} | {doc} |"
        if rule.section is not None and again == name:
            below = f"{name}.<name>." if rule.kind == "sections" else f"{name}."
            yield from key_rows(rule.section, below, shown)


def _accepts(rule: Rule, *, needed: bool) -> str:
    words = {
        "number": _bounds(rule),
        "numbers": "list",
        "switch": "true, false",
        "choice": ", ".join(f"`{option}`" for option in rule.options),
        "text": "text",
        "section": "section",
        "sections": "named sections" if rule.section else "named texts",
    }[rule.kind]
    return words if needed else f"{words}; optional"


def _bounds(rule: Rule) -> str:
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
