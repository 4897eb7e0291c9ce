"""`truck-blowout import`: a log of any format becomes a bag."""

from __future__ import annotations

from pathlib import Path

import typer

from truck_blowout_sim.cli.conversion import parse_remap, report, warn
from truck_blowout_sim.cli.outputs import FORCE, claim
from truck_blowout_sim.recordings import read_recording, write_recording


def command(
    log: Path = typer.Argument(
        help="CSV, .mat (thesis variables: mph, deg/s, ft, SAE axes), .mcap or rosbag2 folder."
    ),
    output: Path = typer.Option(
        ..., "-o", "--output", help="Bag to write: a folder, or a bare file ending in .mcap."
    ),
    source: str = typer.Option(
        "experiment", help="Which variables of a .mat file: experiment (_e) or hve (_h)."
    ),
    remap: list[str] = typer.Option(
        [],
        "--remap",
        "-m",
        help="Foreign topic of a bag, FROM:=TO, e.g. /ins/odometry:="
        "tractor/odometry. May be repeated.",
    ),
    namespace: str | None = typer.Option(
        None, help="Prefix of the truck's topics in a bag; /truck, or found by itself."
    ),
    force: bool = FORCE,
) -> None:
    """Convert a log (CSV, .mat, .mcap, bag) to a bag: SI units, ISO axes, absolute pressures."""
    claim(output, inputs=[log], force=force)
    recording = read_recording(log, source=source, remap=parse_remap(remap), namespace=namespace)
    warn(recording)
    write_recording(recording, output)
    report(recording, output)
