"""`truck-blowout import`: a log of any format becomes a bag."""

from __future__ import annotations

from pathlib import Path

import typer

from truck_blowout_sim.cli.conversion import report, warn
from truck_blowout_sim.cli.outputs import FORCE, JSON, claim
from truck_blowout_sim.cli.reading import ALSO, BLOW, MAP, read
from truck_blowout_sim.recordings import write_recording


def command(
    log: Path = typer.Argument(
        help="Any log: bag, .mcap, .db3, .bag, CSV or text of any logger, .vbo, .mat, MDF."
    ),
    output: Path = typer.Option(
        ..., "-o", "--output", help="Bag to write: a folder, or a bare file ending in .mcap."
    ),
    mapping: Path | None = MAP,
    blow: list[str] = BLOW,
    also: list[Path] = ALSO,
    source: str = typer.Option(
        "experiment", help="Of a .mat with the thesis's variables: experiment (_e) or hve (_h)."
    ),
    namespace: str | None = typer.Option(
        None, help="Prefix of the truck's topics in a bag; /truck, or found by itself."
    ),
    force: bool = FORCE,
    as_json: bool = JSON,
) -> None:
    """Convert a log of any logger to a bag: SI units, ISO axes, absolute pressures."""
    given = [log, *also, *([mapping] if mapping else [])]
    claim(output, inputs=given, force=force)
    recording = read(log, mapping=mapping, blow=blow, also=also, source=source,
                     namespace=namespace)  # fmt: skip
    warn(recording)
    write_recording(recording, output)
    report(recording, output, as_json)
