"""`truck-blowout diagnose`: locate the mismatch, name what is missing, show the fit improve."""

from __future__ import annotations

import gc
import re
import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer
from rich.console import Console
from rich.progress import BarColumn, Progress, TaskID, TextColumn, TimeElapsedColumn

from truck_blowout_sim.cli.failures import interruptible
from truck_blowout_sim.cli.listing import list_option, names_of
from truck_blowout_sim.cli.outputs import FORCE, JSON, YES, ask_about, free_name, say
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
    from truck_blowout_sim.diagnosis import Diagnosis
    from truck_blowout_sim.recordings import Recording
    from truck_blowout_sim.vehicle import Vehicle

SEVERAL = ("--baseline", "--holdout")
_FILES = ("diagnosis.json", "vehicle.yaml", "report.html")
_KEPT = ".resume"  # in the output folder, until the answer is written
_CONTINUES = "the same command continues from here"
_OF_SENSITIVITIES = 25.0  # as many times as long take four effects
SETTINGS: Any = typer.Option(
    "default", help="File in config/diagnosis: what is assumed of vehicles and instruments.",
    autocompletion=names_of("settings"),
)
IMPOSE_SPEED: Any = typer.Option(
    None, "--impose-speed/--no-impose-speed",
    help="Follow the recorded speed. By default only where throttle or brakes are missing."
)
WITHOUT: Any = typer.Option(
    [], "--without", metavar="NAME", help="Effect that is not the cause, such as "
    "crosswind on a calm day; repeat for more."
)
CORRECTED: Any = typer.Option(
    None, "--write-corrected", metavar="DIR",
    help="Folder for the recordings, corrected for the instrument faults found, as CSV."
)
QUICK: Any = typer.Option(
    False, "--quick", help="One effect at most, fewer candidates fitted, coarser step."
)
THOROUGH: Any = typer.Option(
    False, "--thorough", help="1 ms step, up to four effects, intervals by profile likelihood."
)


@reads_logs
def command(
    recordings: list[Path] = typer.Argument(
        help="Training recordings: bags, any log with a mapping, or the name of a shipped one.",
        autocompletion=names_of("recordings"),
    ),
    baseline: list[Path] = typer.Option(
        [], "--baseline", help="Runs of the same vehicle without the effect."
    ),
    holdout: list[Path] = typer.Option(
        [], "--holdout", help="Runs that are predicted only, never fitted."
    ),
    vehicle: str = typer.Option(
        "international_9400i_trailmobile", help="Vehicle file of the model, by name or path.",
        autocompletion=names_of("vehicles"),
    ),
    output: Path = typer.Option(
        ..., "-o", "--output", help="Folder for diagnosis.json, report.html and vehicle.yaml."
    ),
    settings: str = SETTINGS,
    impose_speed: bool | None = IMPOSE_SPEED,
    without: list[str] = WITHOUT,
    quick: bool = QUICK,
    thorough: bool = THOROUGH,
    corrected: Path | None = CORRECTED,
    listed: bool = list_option("recordings", "vehicles", "settings"),
    logs: LogOptions = AS_IT_IS,
    force: bool = FORCE,
    yes: bool = YES,
    as_json: bool = JSON,
) -> None:
    """Locate, name and fit what the model lacks to explain recordings.

    Example: truck-blowout diagnose stop.csv --baseline calm.csv --holdout burst.csv -o diagnosis
    """
    from truck_blowout_sim.diagnosis import diagnose, effort, keeping

    inputs = [*logs.inputs(*recordings, *baseline, *holdout), Path(vehicle)]
    _claim(output, corrected, inputs, force)
    loaded = _vehicle(vehicle, settings, without)
    train, base, hold = _read(logs, loaded, recordings, baseline, holdout)
    _check(loaded, [*train, *base, *hold], impose_speed, yes)
    if not as_json:
        _say_roles(train, base, hold)
    level = effort.QUICK if quick else effort.THOROUGH if thorough else effort.USUAL
    with (_progress() as progress, keeping(output / _KEPT, _teller(progress)) as kept,
          interruptible(lambda: _CONTINUES if kept.begun else "")):
        task = progress.add_task("sensor gate", total=1.0)
        answer, values = diagnose(
            train, baseline=base, holdout=hold, vehicle=loaded, settings=settings,
            impose_speed=impose_speed, effort=level, without=without, kept=kept,
            progress=_reporter(progress, task, thorough))
        progress.update(task, description="drawing", completed=1.0)
        _write(answer, loaded, vehicle, values, output, brief=quick)
    if corrected is not None:
        _write_corrected(answer, {"train": train, "baseline": base, "holdout": hold}, corrected)
    if as_json:
        say(True, dict(answer.as_json()), ())
    else:
        _print(Console(), answer, output)


def _vehicle(name: str, settings: str, without: Sequence[str]) -> Vehicle:
    """The vehicle; a typo in any name is told before anything else is said."""
    from truck_blowout_sim.diagnosis.name.candidates import known_names
    from truck_blowout_sim.diagnosis.settings import load_settings
    from truck_blowout_sim.vehicle import load_vehicle, pack

    loaded = load_vehicle(name)
    load_settings(pack(loaded), settings)
    known_names(without)
    return loaded


def _read(logs: LogOptions, vehicle: Vehicle, recordings: Sequence[Path], *others: Sequence[Path]
          ) -> list[list[Recording]]:  # fmt: skip
    """The runs of each group; ``--blow`` and ``--also`` speak of the first one."""
    among = len(recordings) + sum(map(len, others))
    rest = logs.without_blowouts()
    groups = [logs.read_all(recordings, vehicle, among),
              *(rest.read_all(group, vehicle, among) for group in others)]  # fmt: skip
    logs.require_fit([run for group in groups for run in group])
    return apart_over_roles(groups, (recordings, *others))


def _claim(output: Path, corrected: Path | None, inputs: Sequence[Path], force: bool) -> None:
    """Check that the outputs are free, before anything is computed."""
    claim(output, inputs=inputs, force=force, writes=_FILES)
    if corrected is not None:
        claim(corrected, inputs=inputs, force=force)


def _check(vehicle: Vehicle, runs: Sequence[Recording], impose_speed: bool | None, yes: bool
           ) -> None:
    """Say what is known of the logs, and ask about inputs that no truck has."""
    from truck_blowout_sim.simulation.replay import implausible_inputs

    say_notes(*runs)
    check_brakes(vehicle, *runs)
    ask_about(implausible_inputs(runs, vehicle, impose_speed=impose_speed), yes)


def _write_corrected(answer: Diagnosis, runs: Mapping[str, Sequence[Recording]], folder: Path
                     ) -> None:
    """Every recording without the faults of its instruments, under its own name."""
    from truck_blowout_sim.diagnosis.sensors import correct
    from truck_blowout_sim.recordings import write_recording

    folder.mkdir(parents=True, exist_ok=True)
    taken: set[str] = set()
    for role, group in runs.items():
        faults = [f for f in answer.evidence.findings if f.in_baseline or role != "baseline"]
        for run in group:
            # two folders may hold a `drive.csv` each
            name = free_name(re.sub(r"\W+", "_", run.name).strip("_") or role, taken)
            write_recording(correct(run, faults), folder / f"{name}.csv")
            taken.add(name)


def _write(answer: Diagnosis, vehicle: Vehicle, base: str, values: Mapping[str, float],
           folder: Path, brief: bool) -> None:
    """The three files of an answer."""
    from truck_blowout_sim.diagnosis import write_diagnosed_vehicle, write_diagnosis
    from truck_blowout_sim.report.diagnosis_page import write_diagnosis_report

    folder.mkdir(parents=True, exist_ok=True)
    write_diagnosis(answer, folder / "diagnosis.json")
    write_diagnosed_vehicle(folder / "vehicle.yaml", base, values, answer)
    # thousands of small parts of figures make the collector search all that was loaded before
    gc.disable()
    try:
        write_diagnosis_report(answer, vehicle, folder / "report.html", brief)
    finally:
        gc.enable()


def _say_roles(train: Sequence[Recording], base: Sequence[Recording], hold: Sequence[Recording]
               ) -> None:
    """Which runs are fitted, which calibrate, which are only predicted."""
    roles = (("fits", train), ("calibrates on", base), ("only predicts", hold))
    said = (f"{words} {', '.join(run.name for run in runs)}" for words, runs in roles if runs)
    typer.echo("; ".join(said))


def _progress() -> Progress:
    columns = (TextColumn("{task.description:<20.20}"), BarColumn(), TimeElapsedColumn())
    return bar(*columns)


def _reporter(progress: Progress, task: TaskID, foretell: bool) -> Callable[[str, float], None]:
    """Shows stage and share; ``foretell``: says once how long the whole may take."""
    begun: list[float] = []

    def report(stage: str, share: float) -> None:
        progress.update(task, description=stage, completed=share)
        if foretell and stage == "sensitivities":
            begun.append(time.monotonic())
            if share >= 1.0 and len(begun) > 1:
                most_s = _OF_SENSITIVITIES * (begun[-1] - begun[0])
                _teller(progress)(f"finding four effects would take about {most_s / 60.0:.1f} min; "
                                  "less where fewer are missing")

    return report


def _teller(progress: Progress) -> Callable[[str], None]:
    """Prints a line above the bar, as it is."""
    return lambda line: progress.console.print(line, markup=False, highlight=False, soft_wrap=True)


def _print(console: Console, answer: Diagnosis, folder: Path) -> None:
    """The verdict, each effect, and where the rest is; in a pipe each on one line."""
    from truck_blowout_sim.diagnosis.result import amount_text, label_of, summarize
    from truck_blowout_sim.diagnosis.result.evidence import FAR

    piped = not console.is_terminal

    def line(text: str) -> None:
        console.print(text, highlight=False, markup=False, soft_wrap=piped)

    summary = summarize(answer)
    console.print(f"[bold]{answer.verdict}[/]:", end=" ", highlight=False)
    line(summary.wrong)
    line(f"how sure: {summary.sure}")
    line(f"what changed: {summary.changed}")
    for effect, aliases in zip(answer.effects, answer.alias_sets, strict=True):
        what = f" of the {effect.instrument}" if effect.instrument else ""
        amounts = ", ".join(f"{name} {amount_text(name, p)}"
                            for name, p in effect.parameters.items())
        line(f"  {label_of(effect, answer.effects)}{what}: {amounts or 'no amount'}; "
             f"{effect.equation}")
        if len(aliases.names) > 1:
            line(f"  cannot be told from: {', '.join(aliases.names[1:])}")
    far = [n for n in answer.evidence.calibrated if abs(n.pull) > FAR]
    if far:
        line("numbers pulled far from the sheet: "
             + ", ".join(f"{n.name.replace('_', ' ')} ({n.pull:+.1f} prior sigmas)" for n in far))
    line(f"next test: {answer.next_test}")
    console.print(str(folder / "report.html"), markup=False, highlight=False, soft_wrap=True)
