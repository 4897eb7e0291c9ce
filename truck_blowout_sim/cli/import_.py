"""`truck-blowout import`: a log of any format becomes a bag."""

from __future__ import annotations

from pathlib import Path

import typer

from truck_blowout_sim.cli.conversion import SHOW, VEHICLE, convert, report
from truck_blowout_sim.cli.outputs import FORCE, JSON
from truck_blowout_sim.cli.reading import AS_IT_IS, LogOptions, reads_logs, say_notes
from truck_blowout_sim.recordings.claims import claim


@reads_logs
def command(
    log: Path = typer.Argument(
        help="Any log: bag, .mcap, .db3, .bag, CSV or text of any logger, .vbo, .mat, MDF."
    ),
    output: Path = typer.Option(
        ..., "-o", "--output", help="Bag to write: a folder, or a bare file ending in .mcap."
    ),
    logs: LogOptions = AS_IT_IS,
    source: str = typer.Option(
        "experiment", help="Of a .mat with the thesis's variables: experiment (_e) or hve (_h)."
    ),
    vehicle: str | None = VEHICLE,
    show: bool = SHOW,
    force: bool = FORCE,
    as_json: bool = JSON,
) -> None:
    """Convert a log of any logger to a bag: SI units, ISO axes, absolute pressures.

    Example: truck-blowout import my_log.csv --map my_map.yaml -o my_bag
    """
    claim(output, inputs=logs.inputs(log), force=force)
    recording = logs.read(log, source=source)
    say_notes(recording)
    shown = convert(recording, output, vehicle=vehicle, show=show)
    report(recording, output, shown, as_json)
