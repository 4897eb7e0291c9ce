"""`truck-blowout calibrate`: fit the sheet's numbers to ordinary driving."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import typer
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

from truck_blowout_sim.cli.listing import list_option, names_of
from truck_blowout_sim.cli.outputs import FORCE, JSON, YES, ask_about, say
from truck_blowout_sim.cli.progress import bar
from truck_blowout_sim.cli.reading import (
    AS_IT_IS,
    LogOptions,
    apart_over_roles,
    check_brakes,
    reads_logs,
    say_notes,
)
from truck_blowout_sim.recordings.claims import claim

if TYPE_CHECKING:
    from truck_blowout_sim.diagnosis.calibrate import Calibration
    from truck_blowout_sim.recordings import Recording

SEVERAL = ("--holdout",)
_MOST_CHANNELS = 12


@reads_logs
def command(
    recordings: list[Path] = typer.Argument(
        help="Runs in which nothing is missing: bags, any log with a mapping, or the name of a"
        " shipped recording.", autocompletion=names_of("recordings"),
    ),
    holdout: list[Path] = typer.Option(
        [], "--holdout", help="Runs that are predicted only, never fitted."
    ),
    vehicle: str = typer.Option(
        "international_9400i_trailmobile", help="Vehicle file to start from, by name or path.",
        autocompletion=names_of("vehicles"),
    ),
    output: Path = typer.Option(..., "-o", "--output", help="Vehicle file to write, .yaml."),
    settings: str = typer.Option(
        "default", help="File in config/diagnosis: spread of each number between trucks.",
        autocompletion=names_of("settings"),
    ),
    impose_speed: bool | None = typer.Option(
        None, "--impose-speed/--no-impose-speed",
        help="Follow the recorded speed. By default only where throttle or brakes are missing."
    ),
    listed: bool = list_option("recordings", "vehicles", "settings"),
    logs: LogOptions = AS_IT_IS,
    force: bool = FORCE,
    yes: bool = YES,
    as_json: bool = JSON,
) -> None:
    """Fit the sheet's numbers to ordinary driving and write the vehicle.

    Example: truck-blowout calibrate drive_1.csv drive_2.csv --holdout drive_3.csv -o my_truck.yaml
    """
    from truck_blowout_sim.diagnosis.calibrate import calibrate, write_calibrated_vehicle
    from truck_blowout_sim.errors import InputError
    from truck_blowout_sim.simulation.replay import implausible_inputs
    from truck_blowout_sim.vehicle import load_vehicle

    claim(output, inputs=[*logs.inputs(*recordings, *holdout), vehicle], force=force, one_file=True)
    if output.suffix not in (".yaml", ".yml"):
        raise InputError("is no name of a vehicle file", file=output, expected="a name in .yaml")
    loaded = load_vehicle(vehicle)
    among = len(recordings) + len(holdout)
    roles = (recordings, holdout)
    runs, unseen = apart_over_roles([logs.read_all(n, loaded, among) for n in roles], roles)
    logs.require_fit([*runs, *unseen])
    say_notes(*runs, *unseen)
    check_brakes(loaded, *runs, *unseen)
    ask_about(implausible_inputs([*runs, *unseen], loaded, impose_speed=impose_speed), yes)
    if not as_json:
        say_roles({"fits": runs, "only predicts": unseen})
    with _progress() as bar:
        task = bar.add_task("", total=1.0)
        found = calibrate(
            runs, holdout=unseen, vehicle=loaded, settings=settings, impose_speed=impose_speed,
            progress=lambda stage, share: bar.update(task, description=stage, completed=share))
    output.parent.mkdir(parents=True, exist_ok=True)
    write_calibrated_vehicle(output, vehicle if vehicle == loaded.name else loaded, found)
    say(as_json, as_plain(found, output), lines(found, output))


def say_roles(roles: dict[str, Sequence[Recording]]) -> None:
    """Which runs are used for what, before anything is computed."""
    for role, runs in roles.items():
        if runs:
            typer.echo(f"{role}: {', '.join(run.name for run in runs)}")


def _progress() -> Progress:
    columns = (TextColumn("{task.description:<24.24}"), BarColumn(), TimeElapsedColumn())
    return bar(*columns)


def lines(found: Calibration, output: Path) -> Iterator[str]:
    """The calibration for a person."""
    from truck_blowout_sim.diagnosis.calibrate import describe

    for finding in found.instruments:
        yield f"instrument, taken out: {finding.sentence}"
    if not found.share:
        yield from (*found.notes, str(output))
        return
    yield f"{len(found.told)} numbers are told by these runs:"
    yield from (f"  {describe(n)}" for n in found.told)
    road = [n for n in found.numbers if n.of_the_place and n.told]
    if road:
        yield "of the road of these runs, not written into the vehicle:"
        yield from (f"  {describe(n)}" for n in road)
    stay = ", ".join(n.name.replace("_", " ") for n in found.untold)
    if stay:
        yield f"these runs cannot tell, left at the sheet: {stay}"
    for unseen, words in ((False, "fitted runs"), (True, "unseen runs")):
        yield from _errors(found, unseen, words)
    yield from found.notes
    yield str(output)


def _errors(found: Calibration, unseen: bool, words: str) -> Iterator[str]:
    """Before and after, run by run and channel by channel, what got worse first."""
    ratio = found.error_ratio(unseen=unseen)
    if ratio is None:
        why = ("no channel of these runs could be compared" if found.holdout
               else "none given (--holdout)")
        if unseen:
            yield f"{words}: {why}, so nothing is proven on new driving"
        return
    shown = sorted((c for c in found.changes if c.unseen == unseen and c.before > 0.0),
                   key=lambda c: -c.after / c.before)
    worse = [c for c in shown if c.after > c.before]
    change = f"{abs(1.0 - ratio):.0%}"
    size = "as large" if change == "0%" else f"{change} {'smaller' if ratio < 1.0 else 'larger'}"
    got = f"{len(worse)} of {len(shown)} channels" if worse else "no channel"
    yield f"{words}: errors are {size} on average; {got} got worse"
    listed = shown if len(shown) <= _MOST_CHANNELS else [*shown[:6], *shown[-6:]]
    yield from (f"  {c.recording} {c.channel}: rms {c.before:.3g} -> {c.after:.3g}"
                for c in listed)


def as_plain(found: Calibration, output: Path) -> dict[str, object]:
    """The calibration as plain data."""
    return {
        "vehicle": str(output), "base": found.vehicle, "share": found.share,
        "runs": list(found.runs),
        "holdout": list(found.holdout),
        "numbers": [{
            "name": n.name, "kind": n.kind, "change": n.change, "ci90": list(n.ci90),
            "prior_sigma": n.prior_sigma, "source": n.source, "told": n.told,
            "of_the_place": n.of_the_place, "at_prior_end": n.at_prior_end,
            "values": dict(n.values)} for n in found.numbers],
        "errors": [{"recording": c.recording, "channel": c.channel, "unseen": c.unseen,
                    "rms_before": c.before, "rms_after": c.after} for c in found.changes],
        "error_ratio": {"fitted": found.error_ratio(unseen=False),
                        "unseen": found.error_ratio(unseen=True)},
        "instruments": [finding.sentence for finding in found.instruments],
        "notes": list(found.notes),
    }
