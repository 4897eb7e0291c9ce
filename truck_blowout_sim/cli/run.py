"""`truck-blowout run`: a scenario becomes a bag."""

from __future__ import annotations

import webbrowser
from collections.abc import Iterator, Mapping
from pathlib import Path
from time import perf_counter

import typer
from rich.progress import BarColumn, TextColumn, TimeRemainingColumn

from truck_blowout_sim.cli.listing import list_option, names_of
from truck_blowout_sim.cli.outputs import FORCE, JSON, YES, ask_about, say
from truck_blowout_sim.cli.progress import bar
from truck_blowout_sim.cli.settings import set_values
from truck_blowout_sim.cli.units import UNITS
from truck_blowout_sim.display.scene import beside
from truck_blowout_sim.errors import InputError, quoted
from truck_blowout_sim.recordings import INPUT_NAMES, Recording, write_recording
from truck_blowout_sim.recordings.bag_export import Extra
from truck_blowout_sim.recordings.blowout_words import parse_blowouts
from truck_blowout_sim.recordings.claims import claim
from truck_blowout_sim.simulation.drive import Drive, Ran, execute
from truck_blowout_sim.simulation.drive import names_of as output_names_of
from truck_blowout_sim.simulation.measures import measure
from truck_blowout_sim.simulation.plausible import implausible
from truck_blowout_sim.simulation.run import prepare, recorded
from truck_blowout_sim.simulation.scenario import load_scenario
from truck_blowout_sim.simulation.summary import summarize
from truck_blowout_sim.vehicle import Packed, load_vehicle, pack

_SUFFIX = {"bag": "", "csv": ".csv"}


def command(
    scenario: str = typer.Argument(help="Name of a shipped scenario, or a YAML file.",
                                   autocompletion=names_of("scenarios")),
    output: Path | None = typer.Option(
        None, "-o", "--output", help="Bag to write (a folder); the scenario's name by default."
    ),
    vehicle: str = typer.Option(
        "international_9400i_trailmobile", help="Name of a shipped vehicle, or a YAML file.",
        autocompletion=names_of("vehicles"),
    ),
    values: list[str] = typer.Option(
        [], "--set", help="NAME=VALUE of a parameter, SI or a word, e.g. "
        "hub.trailer_2_left.brake_gain=0.35 or tire.steer_left.model=linear. May be repeated."
    ),
    blow: list[str] = typer.Option(
        [], "--blow", help="TIRE@SECONDS (or a hub, or several joined by +) in place of the "
        "scenario's blowouts; 'none' for none. May be repeated."
    ),
    form: str = typer.Option("bag", "--format", help="bag or csv."),
    step_s: float = typer.Option(0.001, help="Step [s]."),
    rate_hz: float = typer.Option(100.0, help="Rate of the recording [Hz]."),
    units: str = UNITS,
    page: bool = typer.Option(True, help="Write a page with figures beside the output, .html."),
    open_page: bool = typer.Option(False, "--open", help="Open the page in the browser."),
    listed: bool = list_option("scenarios", "vehicles"),
    yes: bool = YES,
    force: bool = FORCE,
    as_json: bool = JSON,
) -> None:
    """Simulate a scenario without ROS, faster than real time; write a bag and a page of figures.

    Example: truck-blowout run steer_axle_blowout -o out/blowout --open
    """
    if form not in _SUFFIX:
        raise InputError(f"--format {quoted(form)}", expected="bag or csv")
    loaded = load_scenario(scenario)
    if blow:
        loaded = loaded.with_blowouts(parse_blowouts([] if blow == ["none"] else blow))
    truck = set_values(pack(load_vehicle(vehicle)), values)
    target = _target(output or Path(loaded.name), form)
    claim(target, force=force, inputs=[loaded.path, truck.vehicle.path], one_file=form == "csv")
    html = page_beside(target)
    page = page or open_page
    if page:
        claim(html, force=force, inputs=[loaded.path, truck.vehicle.path], one_file=True)
    packed, drive, blowouts = prepare(truck, loaded, step_s=step_s, rate_hz=rate_hz)
    ask_about(implausible(packed, drive), yes)
    ran, factor = _run(packed, drive, loaded.name)
    recording = recorded(packed, drive, ran, blowouts, loaded)
    write_recording(recording, target, beside=_shown(recording, packed, drive, ran))
    if page:
        _write_page(recording, packed, html, units)
    measures = measure(packed, drive, ran, loaded.spec.lane_width_m).as_row()
    result = {"output": str(target), "scenario": loaded.name, "vehicle": packed.vehicle.name,
              **_result(recording, units), "page": str(html) if page else None,
              "measures": measures}
    _tell(recording, result, factor, as_json=as_json)
    if open_page:
        webbrowser.open(html.resolve().as_uri())


def _target(output: Path, form: str) -> Path:
    """Where the recording goes; the name of a CSV ends in .csv."""
    if form == "csv" and output.suffix != ".csv":
        return output.with_name(f"{output.name}.csv")
    return output


def _result(recording: Recording, units: str) -> dict[str, object]:
    """What a recording says of its run, as plain data."""
    return {
        "start_s": recording.start_s, "end_s": recording.end_s,
        "summary": summarize(recording, units),
        "blowouts": [{"time_s": b.time_s, "tires": b.tires} for b in recording.blowouts],
    }


def _tell(recording: Recording, result: Mapping[str, object], factor: float, *, as_json: bool
          ) -> None:
    """Notes, the sentence of the result, and where everything is."""
    for note in recording.notes:
        typer.echo(f"note: {note}", err=True)
    target, page = result["output"], result["page"]
    say(as_json, result, [
        str(result["summary"]),
        f"{target}: {len(recording.channels)} channels, {recording.start_s:g} s to "
        f"{recording.end_s:g} s, {factor:.0f} times faster than real time",
        *([f"{page}: figures; `truck-blowout view {target}` shows the truck moving"]
          if page else [])])


def _shown(recording: Recording, packed: Packed, drive: Drive, ran: Ran) -> Iterator[Extra]:
    """Frames and the like, so that the bag alone shows the truck; up to a rollover."""
    n, vehicle = len(recording[INPUT_NAMES[0]]), packed.vehicle
    return beside(vehicle, output_names_of(vehicle), drive.times_s[:n], ran.out[:n],
                  recording.blowouts)


def page_beside(target: Path) -> Path:
    """The page of a run: beside its bag or CSV, of the same name."""
    return target.with_name(f"{target.name.removesuffix('.csv')}.html")


def _write_page(recording: Recording, packed: Packed, html: Path, units: str) -> None:
    from truck_blowout_sim.motion import motion_of
    from truck_blowout_sim.report.run_page import write_run_page

    motion = motion_of(recording, packed.vehicle)
    write_run_page(recording, motion, packed.vehicle, summarize(recording, units), html,
                   units=units)


def _run(packed: Packed, drive: Drive, name: str) -> tuple[Ran, float]:
    """The run, and simulated seconds a wall second; loading of compiled code is not counted."""
    marks: list[tuple[float, float]] = []
    with bar(TextColumn(name), BarColumn(), TimeRemainingColumn()) as shown:
        task = shown.add_task(name, total=1.0)

        def show(share: float) -> None:
            marks.append((perf_counter(), share))
            shown.update(task, completed=share)

        ran = execute(packed, drive, show)
    if len(marks) < 2:
        return ran, 0.0
    (start, done), (end, share) = marks[0], marks[-1]
    seconds = (share - done) * len(drive.inputs) * drive.step_s
    return ran, seconds / max(end - start, 1e-9)
