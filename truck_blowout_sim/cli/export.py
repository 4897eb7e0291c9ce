"""`truck-blowout export`: a bag becomes a CSV (or any other format, by the ending)."""

from __future__ import annotations

from pathlib import Path

import typer

from truck_blowout_sim.cli.conversion import parse_remap, report, warn
from truck_blowout_sim.recordings import read_recording, write_recording


def command(
    bag: Path = typer.Argument(help="rosbag2 folder or .mcap file, finished or not."),
    output: Path = typer.Option(
        ..., "-o", "--output", help="File to write: .csv; .mat and .mcap work too."
    ),
    remap: list[str] = typer.Option(
        [], "--remap", "-m", help="Foreign topic, FROM:=TO. May be repeated."
    ),
    namespace: str | None = typer.Option(
        None, help="Prefix of the truck's topics; /truck, or found by itself."
    ),
) -> None:
    """Convert a bag to CSV: one row an instant, gauge pressures, empty where not measured."""
    recording = read_recording(bag, remap=parse_remap(remap), namespace=namespace)
    warn(recording)
    write_recording(recording, output)
    report(recording, output)
