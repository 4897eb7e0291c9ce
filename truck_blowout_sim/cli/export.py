"""`truck-blowout export`: a bag becomes a CSV (or any other format, by the ending)."""

from __future__ import annotations

from pathlib import Path

import typer

from truck_blowout_sim.cli.conversion import convert, report
from truck_blowout_sim.cli.outputs import FORCE, JSON
from truck_blowout_sim.cli.reading import AS_IT_IS, LogOptions, reads_logs, say_notes
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings.claims import claim
from truck_blowout_sim.recordings.mat_thesis import THESIS_CHANNELS

_FILE_ENDINGS = (".csv", ".mat", ".mcap")


@reads_logs
def command(
    bag: Path = typer.Argument(help="Log or bag of any kind, finished or not."),
    output: Path = typer.Option(
        ..., "-o", "--output", help="File to write: .csv; .mat and .mcap work too."
    ),
    logs: LogOptions = AS_IT_IS,
    thesis_variables: bool = typer.Option(
        False, "--thesis-variables", help="Of a .mat: only the variables of the thesis's script "
        "(time_e, vx_e, …: mph, deg/s, ft, SAE axes), not every channel."
    ),
    plain: bool = typer.Option(
        False, "--plain", help="Of a .csv: without the lines of metadata before the header, for "
        "PlotJuggler and spreadsheets."
    ),
    force: bool = FORCE,
    as_json: bool = JSON,
) -> None:
    """Convert a bag to CSV: one row per instant, gauge pressures, empty where not measured.

    Example: truck-blowout export out/steer_axle_blowout -o blowout.csv
    """
    claim(output, inputs=logs.inputs(bag), force=force,
          one_file=output.suffix.lower() in _FILE_ENDINGS)
    recording = logs.read(bag)
    say_notes(recording)
    if thesis_variables:
        _check_ending(output, ".mat", "--thesis-variables")
        left_out = len(recording.channels) - len(THESIS_CHANNELS & set(recording.channels))
        typer.echo(f"note: {left_out} channels have no variable in the thesis and are left out",
                   err=True)  # fmt: skip
        recording = recording.only_channels(sorted(THESIS_CHANNELS))
    if plain:
        _check_ending(output, ".csv", "--plain")
    shown = convert(recording, output, thesis_variables=thesis_variables, plain=plain)
    report(recording, output, shown, as_json)


def _check_ending(output: Path, ending: str, option: str) -> None:
    if output.suffix.lower() != ending:
        raise InputError(option, file=output, expected=f"an output ending in {ending}")
