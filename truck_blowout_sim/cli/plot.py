"""`truck-blowout plot`: figures of any channel of any run, and the thesis's figures by number."""

from __future__ import annotations

import fnmatch
from collections.abc import Sequence
from math import inf
from pathlib import Path
from typing import TYPE_CHECKING

import typer
from rich.progress import BarColumn, TextColumn

from truck_blowout_sim.cli.listing import names_of
from truck_blowout_sim.cli.outputs import FORCE, JSON, check_span, say
from truck_blowout_sim.cli.progress import bar
from truck_blowout_sim.cli.reading import AS_IT_IS, LogOptions, reads_logs, say_notes
from truck_blowout_sim.cli.units import UNITS
from truck_blowout_sim.comparison.units import AXES
from truck_blowout_sim.errors import InputError, nearest, quoted
from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.recordings.claims import claim

if TYPE_CHECKING:
    from truck_blowout_sim.report.style import Picture

SEVERAL = ("--channels", "-c", "--format", "--thesis")
_FORMATS = ("png", "svg", "pdf")
_FIRST = (
    "steering_wheel_angle_rad", "tractor_vx_mps", "tractor_yaw_rate_radps+trailer_yaw_rate_radps",
    "tractor_roll_rad+trailer_roll_rad", "articulation_rad",
)  # fmt: skip


@reads_logs
def command(
    runs: list[str] = typer.Argument(
        None, help="Bags, .mcap, .csv or .mat files, or the name of a shipped recording; overlaid.",
        autocompletion=names_of("recordings"),
    ),
    channels: list[str] = typer.Option(
        [], "--channels", "-c", help="A channel a panel; + joins channels in one panel; * and ?"
        " stand for any letters: 'tire_pressure_steer_*'. --list shows the names."
    ),
    thesis: list[str] = typer.Option(
        [], "--thesis", help="Figures (18) or tables (table8) of the thesis by number, or all."
    ),
    output: Path = typer.Option(Path("plots"), "-o", "--output", help="Folder for the figures."),
    forms: list[str] = typer.Option(["png"], "--format", help="png, svg, pdf; one or several."),
    units: str = UNITS,
    axes: str = typer.Option("iso", help="iso (left and up positive) or sae (right and down)."),
    over: str = typer.Option("time_s", help="Channel on the horizontal axis, such as tractor_x_m."),
    start_s: float | None = typer.Option(None, "--start", help="Start, s on the run's clock."),
    end_s: float | None = typer.Option(None, "--end", help="End, s on the run's clock."),
    dark: bool = typer.Option(False, "--dark", help="Light lines on dark paper."),
    listed: bool = typer.Option(False, "--list", help="List the channels of the runs and end."),
    logs: LogOptions = AS_IT_IS,
    force: bool = FORCE,
    as_json: bool = JSON,
) -> None:
    """Plot any channel of any run or recording, overlaid; or the thesis's figures by number.

    Example: truck-blowout plot out/steer_axle_blowout test_2013_steer_blowout
    -c tractor_yaw_rate_radps steering_wheel_angle_rad --axes sae
    """
    for words, known, option in ((axes, AXES, "--axes"),
                                 *((form, _FORMATS, "--format") for form in forms)):
        if words not in known:
            raise InputError(f"{option} {quoted(words)}", expected=" or ".join(known))
    if thesis:
        from truck_blowout_sim.cli.plot_thesis import plot_thesis

        _say_paths(as_json, plot_thesis(thesis, output, forms, dark, force))
        return
    check_span(start_s, end_s)
    if not runs:
        raise InputError("no run given", expected="a run, or --thesis")
    recordings = logs.read_all(runs)
    say_notes(*recordings)
    if listed:
        _list(recordings, as_json)
        return
    from truck_blowout_sim.report.channel_plots import PlotRequest, channel_plot

    _check_overlap(recordings, start_s, end_s)
    panels = _panels(channels, recordings)
    if over != "time_s":
        _known(over, recordings)
    target = claim(output, force=force, inputs=logs.inputs(*runs),
                   writes=[f"plot.{form}" for form in forms])
    request = PlotRequest(panels, over, units, axes, start_s, end_s)
    picture = channel_plot(recordings, request, "plot")
    _say_paths(as_json, save_pictures([picture], target, forms, dark))


def save_pictures(pictures: Sequence[Picture], folder: Path, forms: Sequence[str], dark: bool
                  ) -> list[Path]:
    """Write each picture in each format.

    Raises:
        StorageError: one cannot be written.
    """
    from truck_blowout_sim.recordings.atomic import replacing

    paths = []
    with bar(TextColumn("drawing"), BarColumn(), TextColumn("{task.description}")) as shown:
        task = shown.add_task("", total=len(pictures))
        for picture in pictures:
            shown.update(task, description=picture.name, advance=1)
            for form in forms:
                path = folder / f"{picture.name}.{form}"
                with replacing(path) as temporary:
                    temporary.write_bytes(picture.saved(form, dark=dark))
                paths.append(path)
    return paths


def _check_overlap(runs: Sequence[Recording], start_s: float | None, end_s: float | None) -> None:
    """Refuse a part of the time in which no run has anything to show."""
    start, end = -inf if start_s is None else start_s, inf if end_s is None else end_s
    if any(run.start_s <= end and run.end_s >= start for run in runs):
        return
    asked = [f"{option} {value:g}" for option, value in (("--start", start_s), ("--end", end_s))
             if value is not None]
    times = ", ".join(f"{run.start_s:g} to {run.end_s:g} s ({run.name})" for run in runs)
    raise InputError(f"{' '.join(asked)}: no run has anything there", expected=f"times in {times}")


def _panels(words: Sequence[str], runs: Sequence[Recording]) -> tuple[tuple[str, ...], ...]:
    """The channels of each panel, patterns resolved."""
    if not words:
        present = {name for run in runs for name in run.channels}
        groups = [tuple(n for n in word.split("+") if n in present) for word in _FIRST]
        return tuple(group for group in groups if group) or ((next(iter(runs[0].channels)),),)
    return tuple(
        tuple(dict.fromkeys(name for part in word.split("+") for name in _resolved(part, runs)))
        for word in words
    )


def _resolved(word: str, runs: Sequence[Recording]) -> list[str]:
    if not set(word) & set("*?["):
        return [_known(word, runs)]
    names = dict.fromkeys(name for run in runs for name in run.channels)
    found = fnmatch.filter(names, word)
    if not found:
        raise InputError(f"--channels {quoted(word)} matches nothing",
                         expected="a pattern of a recorded channel; --list shows them")
    return found


def _known(word: str, runs: Sequence[Recording]) -> str:
    names = dict.fromkeys(name for run in runs for name in run.channels)
    if word not in names:
        problem = f"channel {quoted(word)} is in none of the runs"
        raise InputError(problem, expected=nearest(word, names, "a channel that --list shows"))
    return word


def _list(runs: Sequence[Recording], as_json: bool) -> None:
    names = {run.name: sorted(run.channels) for run in runs}
    say(as_json, {"channels": names},
        (f"{run}: {name}" if len(names) > 1 else name for run in names for name in names[run]))


def _say_paths(as_json: bool, paths: Sequence[Path]) -> None:
    say(as_json, {"figures": [str(path) for path in paths]}, map(str, paths))
