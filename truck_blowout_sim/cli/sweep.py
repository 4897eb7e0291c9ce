"""`truck-blowout sweep`: many runs of one scenario, one table, one page."""

from __future__ import annotations

import shlex
from dataclasses import fields
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

import typer
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from truck_blowout_sim.cli.failures import REFUSED, interruptible
from truck_blowout_sim.cli.listing import list_option, names_of
from truck_blowout_sim.cli.outputs import FORCE, JSON, YES, say
from truck_blowout_sim.cli.progress import bar
from truck_blowout_sim.recordings.claims import claim

if TYPE_CHECKING:
    from truck_blowout_sim.report.sweep_page import Findings
    from truck_blowout_sim.simulation.studies.sweep import Plan

SEVERAL = ("--vary", "--channels", "-c")
VEHICLE: Any = typer.Option(
    "international_9400i_trailmobile", help="Name of a shipped vehicle, or a YAML file.",
    autocompletion=names_of("vehicles"),
)
_LOADING = "loading the model; the first sweep compiles it, in up to a minute"
_CONTINUES = "the same command continues from here"


def command(
    scenario: str = typer.Argument(
        help="Name of a shipped scenario, or a YAML file.", autocompletion=names_of("scenarios")
    ),
    vary: list[str] = typer.Option(
        ..., "--vary", metavar="KEY=VALUES",
        help="Values a,b,c or lo:hi:n of any key of the scenario, vehicle, tire, blowout or road "
        "file, e.g. start.speed_mph=45:65:5 or blowouts.failure.tires=steer_left,none. "
        "0.5x,1x scales the file's value; * in a key stands for every name. May be repeated."
    ),
    output: Path = typer.Option(
        ..., "-o", "--output", help="Folder for runs.parquet, report.html and figures/."
    ),
    random: int = typer.Option(
        0, "--random", metavar="N", min=0,
        help="N runs of a random sample instead of every combination; lo:hi is then enough."
    ),
    seed: int = typer.Option(1, "--seed", help="Seed of the random sample."),
    vehicle: str = VEHICLE,
    channels: list[str] = typer.Option(
        [], "--channels", "-c", metavar="C",
        help="Outputs and inputs to keep over time in the table; one or several."
    ),
    rate_hz: float = typer.Option(100.0, "--rate-hz", help="Rate of measures and channels [Hz]."),
    step_s: float = typer.Option(0.001, "--step-s", help="Step [s]."),
    workers: int | None = typer.Option(
        None, "--workers", min=1, help="Runs at a time on this machine; by default one a core."
    ),
    scheduler: str = typer.Option(
        "", "--scheduler", metavar="ADDRESS",
        help="Run on the Dask cluster of this scheduler, e.g. tcp://host:8786 (extra: dask)."
    ),
    listed: bool = list_option("scenarios", "vehicles"),
    yes: bool = YES,
    force: bool = FORCE,
    as_json: bool = JSON,
) -> None:
    """Run a scenario many times with varied keys; a failed run is a row with its reason.

    Example: truck-blowout sweep hold_straight --vary reaction.time_s=0.5,1,2 -o out/reaction
    """
    from truck_blowout_sim.report.sweep_page import write_sweep_report
    from truck_blowout_sim.simulation.scenario import load_scenario
    from truck_blowout_sim.simulation.studies.sweep import Plan, run_sweep

    plan = Plan(scenario, vehicle, tuple(vary), random, seed, tuple(channels), step_s, rate_hz, yes)
    claim(output, force=force, inputs=[scenario, vehicle], writes=["report.html", "figures"])
    with _progress() as progress, interruptible(
            lambda: _CONTINUES if (output / "sweep.json").exists() else ""):
        task = progress.add_task(_LOADING, total=None)
        batch = run_sweep(
            plan, output, force=force, workers=workers, scheduler=scheduler,
            progress=lambda done, total: progress.update(
                task, completed=done, total=total, description="running" if done else _LOADING))
        progress.update(task, description="drawing")
        page, found = write_sweep_report(batch, [axis.key for axis in plan.axes],
                                         load_scenario(scenario).title, _command(plan), output)
    _tell(found, output, page, as_json=as_json)
    if set(found.counts) == {"failed"}:
        _refuse(found)


def _refuse(found: Findings) -> NoReturn:
    """Say that no run came about, and why."""
    runs, (reason, count) = sum(found.counts.values()), found.reasons[0]
    others = f"; {runs - count} for other reasons" if count < runs else ""
    words = "the only run failed" if runs == 1 else f"all {runs} runs failed"
    typer.echo(f"truck-blowout: {words}: {reason}{others}", err=True)
    raise typer.Exit(REFUSED)


def _tell(found: Findings, output: Path, page: Path, *, as_json: bool) -> None:
    """What the runs say together, and where the table and the page are."""
    from truck_blowout_sim.report.sweep_page import headline, sentences

    said = [headline(found), *sentences(found)]
    say(as_json, {
        "output": str(output), "table": str(output / "runs.parquet"), "page": str(page),
        "runs": sum(found.counts.values()), "by_status": dict(found.counts),
        "shares_explained": found.shares, "sentences": said,
        "reasons": [{"reason": reason, "runs": n} for reason, n in found.reasons],
    }, [*said, *(f"{n} failed: {reason}" for reason, n in found.reasons), str(page)])


def _command(plan: Plan) -> str:
    """The command line that repeats a plan."""
    words = ["truck-blowout", "sweep", plan.scenario, "--vehicle", plan.vehicle]
    for word in plan.vary:
        words += ["--vary", word]
    if plan.random:
        words += ["--random", str(plan.random), "--seed", str(plan.seed)]
    if plan.channels:
        words += ["--channels", *plan.channels]
    usual = {field.name: field.default for field in fields(plan)}
    for name in ("step_s", "rate_hz"):
        if getattr(plan, name) != usual[name]:
            words += [f"--{name.replace('_', '-')}", repr(getattr(plan, name))]
    return shlex.join([*words, *(["--yes"] if plan.insist else []), "-o", "DIR"])


def _progress() -> Progress:
    return bar(TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(),
               TimeRemainingColumn())
