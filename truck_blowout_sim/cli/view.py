"""`truck-blowout view`: the truck moving in three dimensions, as one HTML file or a film."""

from __future__ import annotations

import webbrowser
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer
from rich.progress import BarColumn, TextColumn, TimeRemainingColumn

from truck_blowout_sim.cli.drawn_vehicle import vehicle_of
from truck_blowout_sim.cli.listing import list_option, names_of
from truck_blowout_sim.cli.outputs import FORCE, JSON, check_span, say
from truck_blowout_sim.cli.progress import bar
from truck_blowout_sim.cli.reading import AS_IT_IS, LogOptions, reads_logs, say_notes
from truck_blowout_sim.errors import InputError, quoted
from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.recordings.claims import claim

if TYPE_CHECKING:
    from truck_blowout_sim.report.viewer import RunToShow

VEHICLE: Any = typer.Option(
    None, help="Vehicle file to draw, by name or path; by default the one the run names.",
    autocompletion=names_of("vehicles"),
)
_VIEWS = ("chase", "front left", "front right", "side", "top", "driver")


@reads_logs
def command(
    runs: list[str] = typer.Argument(
        help="Bags, .mcap, .csv or .mat files, or the name of a shipped recording. The first run"
        " is drawn solid, further ones as ghosts or side by side.",
        autocompletion=names_of("recordings"),
    ),
    output: Path | None = typer.Option(
        None, "-o", "--output", help="HTML file to write; the first run's name by default."
    ),
    vehicle: str | None = VEHICLE,
    video: Path | None = typer.Option(
        None, help="Film to write too, .mp4; needs ffmpeg and Chromium or Chrome."
    ),
    camera: str = typer.Option("chase", help=f"Camera of the film: {', '.join(_VIEWS)}.",
                               autocompletion=lambda: list(_VIEWS)),
    start_s: float | None = typer.Option(None, "--start", help="Start of the film, s."),
    end_s: float | None = typer.Option(None, "--end", help="End of the film, s."),
    speed: float = typer.Option(1.0, min=0.01, max=100.0,
                                help="Seconds of the run per second of the film."),
    dark: bool = typer.Option(False, "--dark", help="Film in dark colors."),
    open_page: bool = typer.Option(False, "--open", help="Open the page in the browser."),
    listed: bool = list_option("recordings", "vehicles"),
    logs: LogOptions = AS_IT_IS,
    force: bool = FORCE,
    as_json: bool = JSON,
) -> None:
    """Show the truck moving in 3-D: one HTML file that needs neither server nor network.

    Example: truck-blowout view out/steer_axle_blowout test_2013_steer_blowout -o both.html
    """
    from truck_blowout_sim.report.viewer import write_viewer

    _check_view(camera)
    inputs = logs.inputs(*runs)
    target = claim(_page(output, runs[0]), force=force, inputs=inputs, one_file=True)
    check_span(start_s, end_s)
    if video is not None:
        if video.suffix != ".mp4":
            raise InputError(f"--video {quoted(str(video))}", expected="a name that ends in .mp4")
        claim(video, force=force, inputs=inputs, one_file=True)
    recordings = logs.read_all(runs)
    say_notes(*recordings)
    shown = [_shown(recording, vehicle) for recording in recordings]
    write_viewer(shown, target)
    result = {
        "page": str(target), "bytes": target.stat().st_size, "runs": [r.name for r in recordings],
        "assumptions": {one.recording.name: list(one.motion.assumptions) for one in shown},
        "video": None if video is None else str(video),
    }
    lines = [f"{target}: {', '.join(r.name for r in recordings)}, {target.stat().st_size / 1e6:.1f}"
             " MB, opens from the disk in any browser"]
    lines += [f"{one.recording.name}: {words}"
              for one in shown for words in one.motion.assumptions]
    if video is not None:
        pictures = _film(target, video, camera, start_s, end_s, speed, dark)
        lines.append(f"{video}: {pictures} pictures")
    say(as_json, result, lines)
    if open_page:
        webbrowser.open(target.resolve().as_uri())


def _page(output: Path | None, run: str) -> Path:
    """File to write: as asked, else named after the run."""
    page = output or Path(f"{Path(run.rstrip('/')).stem}.html")
    if page.suffix.lower() not in (".html", ".htm"):
        raise InputError(f"--output {quoted(str(page))}", expected="a name that ends in .html")
    return page


def _check_view(camera: str) -> None:
    if camera not in _VIEWS:
        raise InputError(f"--camera {quoted(camera)}", expected=", ".join(_VIEWS))


def _shown(recording: Recording, wanted: str | None) -> RunToShow:
    from truck_blowout_sim.motion import motion_of
    from truck_blowout_sim.report.viewer import RunToShow

    vehicle, guess = vehicle_of(recording, wanted)
    motion = motion_of(recording, vehicle)
    if guess:
        motion = replace(motion, assumptions=(guess, *motion.assumptions))
    return RunToShow(recording, motion, vehicle)


def _film(page: Path, video: Path, camera: str, start_s: float | None, end_s: float | None,
          speed: float, dark: bool) -> int:
    from truck_blowout_sim.report.viewer.film import Film, write_film

    with bar(TextColumn(f"filming {video.name}"), BarColumn(), TimeRemainingColumn()) as shown:
        task = shown.add_task("", total=1.0)
        film = Film(view=camera, start_s=start_s, end_s=end_s, speed=speed, dark=dark)
        return write_film(page, video, film, lambda share: shown.update(task, completed=share))
