"""All rows for both vehicles, and the page they make."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from truck_blowout_sim.recordings import read_recording
from truck_blowout_sim.resources import config_file
from truck_blowout_sim.simulation.run import simulate
from truck_blowout_sim.simulation.validation.published import published_rows
from truck_blowout_sim.simulation.validation.rows import Row
from truck_blowout_sim.simulation.validation.soundness import soundness_rows
from truck_blowout_sim.simulation.validation.turning import turning_rows
from truck_blowout_sim.vehicle import load_vehicle, pack

MODES = {
    "thesis": "international_9400i_trailmobile_thesis",
    "default": "international_9400i_trailmobile",
}
_LOG = "test_2013_steer_blowout.csv"
_SECTIONS = {
    "published": "The test of 2013: published figures",
    "turning": "Blowouts in a step steer: the thesis's words",
    "soundness": "What any sound simulation must give",
}
_MARKS = {True: "yes", False: "**no**", None: "–"}
Sections = Mapping[str, Mapping[str, Sequence[Row]]]


def validate(progress: Callable[[str], None] | None = None) -> Sections:
    """Measure both vehicles: rows by section, then by mode.

    Args:
        progress: told what comes next.
    """
    say = progress or (lambda words: None)
    log = read_recording(config_file("recordings", _LOG))
    table: dict[str, dict[str, Sequence[Row]]] = {key: {} for key in _SECTIONS}
    for mode, name in MODES.items():
        packed = pack(load_vehicle(name))
        say(f"{mode}: published figures")
        run = simulate(packed, "steer_axle_blowout")
        table["published"][mode] = published_rows(packed, run, log)
        say(f"{mode}: blowouts in a turn")
        table["turning"][mode] = turning_rows(packed)
        say(f"{mode}: symmetry, energy, convergence, rest")
        table["soundness"][mode] = soundness_rows(packed, weighed=mode == "default")
    return table


def as_markdown(table: Sections) -> str:
    """The tables as Markdown, one below the other."""
    lines: list[str] = []
    for key, title in _SECTIONS.items():
        lines += [f"## {title}", "", _header(), *_body(table[key]), ""]
    return "\n".join(lines).rstrip() + "\n"


def _header() -> str:
    modes = " | ".join(f"{mode} mode | met" for mode in MODES)
    rule = "|---|---|---|" + "---|---|" * len(MODES) + "---|"
    return f"| | quantity | target | {modes} | note |\n{rule}"


def _body(by_mode: Mapping[str, Sequence[Row]]) -> list[str]:
    columns = [sorted(rows, key=_order) for rows in by_mode.values()]
    return [_line(rows) for rows in zip(*columns, strict=True)]


def _order(row: Row) -> tuple[str, int]:
    head, digits = row.key[:1], row.key[1:]
    return (head, int(digits)) if digits.isdigit() else ("", 0)


def _line(rows: Sequence[Row]) -> str:
    first = rows[0]
    values = " | ".join(f"{row.value} | {_MARKS[row.met]}" for row in rows)
    notes = "; ".join(dict.fromkeys(row.note for row in rows if row.note))
    return f"| {first.key} | {first.quantity} | {first.target} | {values} | {notes} |"
