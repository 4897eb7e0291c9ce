"""`truck-blowout compare`: the model's answer to a recording's inputs, beside the recording."""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer
from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn
from rich.table import Table
from rich.text import Text

from truck_blowout_sim.cli.listing import list_option, names_of
from truck_blowout_sim.cli.outputs import FORCE, JSON, YES, ask_about, free_name, say
from truck_blowout_sim.cli.progress import bar
from truck_blowout_sim.cli.reading import AS_IT_IS, LogOptions, reads_logs
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings.claims import claim
from truck_blowout_sim.recordings.shipped import find_recording

if TYPE_CHECKING:
    from truck_blowout_sim.comparison import Comparison
    from truck_blowout_sim.recordings import Recording
    from truck_blowout_sim.vehicle import Vehicle

Tell = Callable[[str, float], None]
VEHICLE: Any = typer.Option(
    "international_9400i_trailmobile", help="Vehicle file, by name or path.",
    autocompletion=names_of("vehicles"),
)
HVE = "hve"  # folder of the second page
_NUMBERS = (
    ("rms error", 11), ("peak error", 11), ("at", 8), ("noise σ", 7), ("lag", 8), ("ISO 18571", 14)
)  # fmt: skip


@reads_logs
def command(
    recordings: list[str] = typer.Argument(
        help="Bags, .mcap, .csv or .mat files, or the name of a shipped one:"
        " test_2013_steer_blowout.",
        autocompletion=names_of("recordings"),
    ),
    vehicle: str = VEHICLE,
    output: Path = typer.Option(
        Path("comparison"),
        "-o",
        "--output",
        help="Folder for report.html, comparison.json and figures/; with several recordings,"
        " one folder each inside it.",
    ),
    step_s: float = typer.Option(
        0.001, min=1e-5, max=0.005, help="Step [s]."
    ),
    impose_speed: bool | None = typer.Option(
        None, "--impose-speed/--no-impose-speed",
        help="Make the model follow the recorded speed. By default only where throttle or a brake"
        " pressure was not recorded.",
    ),
    no_model: bool = typer.Option(
        False, "--no-model", help="Compare two recordings with each other, without a model."
    ),
    hve: bool = typer.Option(
        False, "--hve", help="Of a .mat with the thesis's variables: compare HVE's run (_h) with"
        " the test too; a second page in the folder hve/."
    ),
    listed: bool = list_option("recordings", "vehicles"),
    logs: LogOptions = AS_IT_IS,
    yes: bool = YES,
    force: bool = FORCE,
    as_json: bool = JSON,
) -> None:
    """Drive the model with a recording's inputs and report the differences.

    Example: truck-blowout compare test.csv --vehicle my_truck.yaml -o comparison
    """
    from truck_blowout_sim.comparison import compare, compare_recordings
    from truck_blowout_sim.vehicle import load_vehicle

    console, loaded = _console(), load_vehicle(vehicle)
    inputs = logs.inputs(*recordings)
    folders = _claimed(recordings, output, inputs, no_model=no_model, hve=hve, force=force)
    theirs = {name: _hve_run(name) for name in recordings} if hve else {}
    for name, folder in zip(recordings, folders, strict=False):

        def made(tell: Tell, name: str = name) -> Comparison:
            if no_model:
                first, second = logs.read_all(recordings, loaded)
                return compare_recordings(first, second, vehicle=loaded, progress=tell)
            return compare(_read(name, logs, loaded, len(recordings)), loaded, step_s=step_s,
                           impose_speed=impose_speed, contrasted=True, progress=tell,
                           ask=lambda problems: ask_about(problems, yes))

        compared, page = _drawn(made, folder)
        _tell(console, compared, page, as_json)
        if hve:
            _hold_hve(console, compared, theirs[name], folder / HVE, as_json)


def _claimed(
    recordings: list[str], output: Path, inputs: list[Path], *, no_model: bool, hve: bool,
    force: bool,
) -> list[Path]:  # fmt: skip
    """The folder of each page, checked to be free."""
    from truck_blowout_sim.report.comparison_page import DATA, PAGE

    if no_model and len(recordings) != 2:
        raise InputError(f"--no-model with {len(recordings)} recordings", expected="two of them")
    folders = _folders(recordings[:1] if no_model else recordings, output)
    for folder in folders:
        claim(folder, inputs=inputs, force=force, writes=(PAGE, DATA, *([HVE] if hve else [])))
    return folders


def _drawn(made: Callable[[Tell], Comparison], folder: Path) -> tuple[Comparison, Path]:
    """A comparison and its page, with progress on stderr."""
    from truck_blowout_sim.report.comparison_page import write_comparison_report

    with _progress() as progress:
        task = progress.add_task("", total=1.0)

        def tell(stage: str, share: float) -> None:
            progress.update(task, description=stage, completed=0.8 * share)

        compared = made(tell)
        progress.update(task, description="drawing", completed=0.8)
        return compared, write_comparison_report(compared, folder)


def _hve_run(name: str) -> Recording:
    """HVE's run in a file, read before anything is written."""
    path = find_recording(name)
    if path.suffix.lower() != ".mat":
        raise InputError("--hve", file=path, expected="a .mat with the thesis's variables (vx_h …)")
    theirs = AS_IT_IS.read(path, source="hve")
    return replace(theirs, name=f"{theirs.name} (HVE)")


def _hold_hve(console: Console, compared: Comparison, theirs: Recording, folder: Path,
              as_json: bool) -> None:
    """HVE's run against the test's, with the same figures as the model's."""
    from truck_blowout_sim.comparison import compare_recordings
    from truck_blowout_sim.report.comparison_page import write_comparison_report

    held = compare_recordings(compared.recording, theirs, vehicle=compared.vehicle)
    page = write_comparison_report(held, folder)
    if not as_json:
        _print(console, held, page)


def _tell(console: Console, compared: Comparison, page: Path, as_json: bool) -> None:
    from truck_blowout_sim.comparison import encode_comparison

    say(as_json, encode_comparison(compared), ())
    if not as_json:
        _print(console, compared, page)


def _read(name: str, logs: LogOptions, vehicle: Vehicle, among: int) -> str | Recording:
    """What to compare with: the name as it is, or the recording where options change it."""
    return logs.read_all([name], vehicle, among)[0] if logs.given else name


def _folders(recordings: list[str], output: Path) -> list[Path]:
    """One folder a recording, named after it; two of one name are told apart by a number."""
    if len(recordings) == 1:
        return [output]
    names: list[str] = []
    for recording in recordings:
        stem = Path(recording).name.split(".")[0] or "recording"
        names.append(free_name(stem, names))
    return [output / name for name in names]


def _console() -> Console:
    """As wide as the terminal; wide enough for every column where the output is a file."""
    return Console() if sys.stdout.isatty() else Console(width=160)


def _progress() -> Progress:
    columns = (TextColumn("{task.description:<45.45}"), BarColumn(), TimeElapsedColumn())
    return bar(*columns)


def _print(console: Console, compared: Comparison, page: Path) -> None:
    """The verdict, the chief channels, and where the rest is."""
    from truck_blowout_sim.comparison import verdict

    # names and notes hold what users wrote: brackets in them are no styles
    console.print(Text.assemble((compared.recording.name, "bold"), f": {verdict(compared)}"),
                  soft_wrap=True)
    table = Table(box=None, pad_edge=False, header_style="dim")
    table.add_column("channel")
    for title, width in _NUMBERS:
        table.add_column(title, justify="right", no_wrap=True, min_width=width)
    for channel in compared.channels:
        sigma = "" if channel.rms_sigma is None else f"{channel.rms_sigma:.1f}"
        rating = channel.rating
        score = f"{rating.overall:.2f} {rating.grade}" if rating and not channel.imposed else ""
        table.add_row(
            Text(channel.label + (" (imposed)" if channel.imposed else "")),
            channel.shown(channel.rms), channel.shown(channel.peak),
            f"{channel.peak_time_s:.2f} s", sigma, _lag(channel.lag_s), score,
        )  # fmt: skip
    console.print(table)
    for note in compared.notes:
        console.print(f"note: {note}", style="dim", markup=False, highlight=False, soft_wrap=True)
    console.print(f"{page} ({len(compared.channels)} channels)", markup=False, highlight=False,
                  soft_wrap=True)


def _lag(lag_s: float | None) -> str:
    """How late the record is, where a shift makes both alike."""
    return "" if lag_s is None else f"{lag_s:+.2f} s"
