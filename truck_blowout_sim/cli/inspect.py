"""`truck-blowout inspect`: what is in a log, and what of it becomes which channel."""

from __future__ import annotations

import dataclasses
import math
import sys
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING

import typer
from rich.console import Console
from rich.table import Table

from truck_blowout_sim.cli.outputs import FORCE, JSON, say
from truck_blowout_sim.cli.reading import AS_IT_IS, LogOptions, reads_logs
from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.recordings.claims import claim
from truck_blowout_sim.recordings.shipped import find_recording

_EPOCH_S = 1e8  # times since 1970 are above
_MOST_UNUSED = 40  # numbers of a topic without a channel that are listed

if TYPE_CHECKING:
    from truck_blowout_sim.recordings.mapping.inventory import Inventory, Line
    from truck_blowout_sim.recordings.mapping.proposing import Wheels
    from truck_blowout_sim.vehicle import Vehicle


@reads_logs
def command(
    log: Path = typer.Argument(
        help="Any log: bag, .mcap, .db3, .bag, CSV or text of any logger, .vbo, .mat, MDF."
    ),
    logs: LogOptions = AS_IT_IS,
    write_map: Path | None = typer.Option(
        None, "--write-map", metavar="FILE", help="Write a first mapping file; every guess in "
        "it is marked."
    ),
    vehicle: str | None = typer.Option(
        None, "--vehicle", help="Vehicle file, by name or path, whose hubs a guess names. "
        "Default: the truck that ships with the package."
    ),
    force: bool = FORCE,
    as_json: bool = JSON,
) -> None:
    """Show what a log holds: columns, units, rates, clocks, gaps, and the channels they become.

    Example: truck-blowout inspect my_log.csv --write-map my_map.yaml
    """
    from truck_blowout_sim.recordings.mapping.inventory import inspect_log
    from truck_blowout_sim.recordings.mapping.writing import mapping_text
    from truck_blowout_sim.vehicle import load_vehicle

    its = load_vehicle(vehicle) if vehicle else None
    if write_map is not None:
        claim(write_map, force=force, inputs=logs.inputs(log), one_file=True)
    found = inspect_log(find_recording(log), mapping=logs.mapping, namespace=logs.namespace,
                        also=logs.also, wheels=_wheels(its) if its else None)  # fmt: skip
    if logs.mapping is not None or logs.blow:
        found = _checked(found, logs.read(log, its))
    if write_map is not None:
        _write(write_map, mapping_text(found))
    if as_json:
        say(True, _plain(found), [])
        return
    _print(found)
    if write_map is not None:
        guesses = len(found.proposals)
        typer.echo(f"{write_map}: {guesses} channels guessed; read and correct them, then: "
                   f"truck-blowout compare {log} --map {write_map}"
                   + (f" --vehicle {vehicle}" if vehicle else ""))  # fmt: skip


def _wheels(vehicle: Vehicle) -> Wheels:
    """Hubs of a vehicle, and the radii of their tires."""
    from truck_blowout_sim.recordings.mapping.proposing import Wheels

    radii = [vehicle.tire_specs[vehicle.tires_of_hub(hub)[0]].unloaded_radius_m
             for hub in vehicle.hubs]  # fmt: skip
    return Wheels(vehicle.hubs, tuple(radii), "this vehicle's unloaded tire",
                  vehicle.tires)  # fmt: skip


def _checked(found: Inventory, read: Recording) -> Inventory:
    """With what the mapping and `--blow` made of the log; what is wrong in them was said."""
    blowouts = tuple((b.time_s, "+".join(b.tires)) for b in read.blowouts)
    return dataclasses.replace(found, blowouts=blowouts,
                               notes=tuple(dict.fromkeys((*found.notes, *read.notes))))  # fmt: skip


def _write(path: Path, text: str) -> None:
    from truck_blowout_sim.recordings.atomic import replacing

    with replacing(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


def _plain(found: Inventory) -> dict[str, object]:
    tree = dataclasses.asdict(found)
    for line in tree["lines"]:
        for key in ("low", "high"):
            line[key] = line[key] if math.isfinite(line[key]) else None
    return {**tree, "unused": list(found.unused)}


def _print(found: Inventory) -> None:
    console = Console() if sys.stdout.isatty() else Console(width=140)
    digits = "6g" if abs(found.start_s or 0.0) < _EPOCH_S else "3f"
    span = ("" if found.start_s is None
            else f", {found.start_s:.{digits}} s to {found.end_s:.{digits}} s")  # fmt: skip
    clock = f", time: {found.time_column} [{found.time_unit}]" if found.time_column else ""
    console.print(f"{found.file}: {found.kind}{span}{clock}", markup=False, highlight=False,
                  soft_wrap=True)  # fmt: skip
    for at_s, tires in found.blowouts:
        console.print(f"blowout of {tires} at {at_s:g} s", markup=False, highlight=False)
    lines, hidden = _of_interest(found.lines)
    console.print(_table(lines))
    for topic, count in hidden.items():
        console.print(f"{topic}: {count} numbers, none of them a channel; --json lists them",
                      markup=False, highlight=False)  # fmt: skip
    for note in found.notes:
        console.print(f"note: {note}", style="dim", markup=False, highlight=False, soft_wrap=True)
    if found.unused:
        console.print(f"{len(found.unused)} of {len(found.lines)} columns become nothing",
                      highlight=False)  # fmt: skip


def _of_interest(lines: tuple[Line, ...]) -> tuple[tuple[Line, ...], dict[str, int]]:
    """Lines to print, and topics of many numbers of which none is a channel, as /tf."""
    count, used = Counter(map(_topic, lines)), {_topic(line) for line in lines if line.channel}
    hidden = {topic: n for topic, n in count.items()
              if topic and n > _MOST_UNUSED and topic not in used}  # fmt: skip
    return tuple(line for line in lines if _topic(line) not in hidden), hidden


def _topic(line: Line) -> str:
    return line.name.partition(":")[0] if line.name.startswith("/") else ""


def _table(lines: tuple[Line, ...]) -> Table:
    table = Table(box=None, pad_edge=False, header_style="dim")
    late = any(line.received_late_s is not None for line in lines)
    titles = ("column", "unit", "Hz", "samples", "from", "to", "gaps", *(["late"] * late),
              "becomes")  # fmt: skip
    for title in titles:
        right = title in ("Hz", "samples", "from", "to", "gaps", "late")
        table.add_column(title, justify="right" if right else "left", no_wrap=not right)
    for line in lines:
        becomes = line.channel + {"guess": " (guess)", "name": ""}.get(line.by, "")
        lateness = "" if line.received_late_s is None else f"{1e3 * line.received_late_s:.1f} ms"
        cells = (
            line.name, line.unit or "?", "" if line.rate_hz is None else f"{line.rate_hz:.4g}",
            str(line.samples), f"{line.low:.4g}", f"{line.high:.4g}",
            str(line.gaps or ""), *([lateness] * late), becomes,
        )  # fmt: skip
        table.add_row(*(cell.replace("[", "\\[") for cell in cells))
    return table
