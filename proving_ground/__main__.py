"""Command line of the proving ground: `python -m proving_ground VERB`, `--help` for the verbs."""

from __future__ import annotations

import os
import sys
from collections import Counter
from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn
from rich.table import Table as RichTable

from proving_ground.cases import GROUPS, CaseSpec, read_case, write_case
from proving_ground.generate import generate as generate_cases
from proving_ground.generate import interleaved, pending
from proving_ground.seal import broken_seals, write_manifest
from proving_ground.table import SETS, cases_of
from proving_ground.worlds import world_cases

app = typer.Typer(no_args_is_help=True, add_completion=False, help=__doc__)
console = Console(stderr=True)
SetName = Annotated[str, typer.Option("--set", help="dev, test or ci")]
Out = Annotated[Path, typer.Option("--out", "-o", help="folder of the set")]


def _stop(message: str) -> typer.Exit:
    console.print(message, style="red", markup=False)
    return typer.Exit(2)


def _table(name: str) -> list[CaseSpec]:
    if name not in SETS:
        raise _stop(f"--set: {name!r}, expected one of {SETS}")
    return cases_of(name)


@app.command()
def generate(
    out: Out,
    name: SetName = "dev",
    cores: Annotated[int, typer.Option(help="processes")] = os.cpu_count() or 1,
    group: Annotated[list[str] | None, typer.Option(help="only this group; repeatable")] = None,
    limit: Annotated[int, typer.Option(help="the first so many, groups in "
                                         "proportion; 0: all")] = 0,
    case: Annotated[list[Path] | None, typer.Option(help="YAML case instead of a set")] = None,
) -> None:
    """Make the recordings and answers of a set, or of single case files; resumes where it was."""
    try:
        specs = [read_case(path) for path in case] if case else _table(name)
    except (OSError, ValueError) as error:
        raise _stop(str(error)) from error
    if group:
        specs = [spec for spec in specs if spec.group in group]
    specs = interleaved(specs)
    specs = specs[:limit] if limit else specs
    _make(specs, out, cores, "own" if case else name)


def _make(specs: list[CaseSpec], out: Path, cores: int, name: str) -> None:
    """Make what is not there yet, with a bar, and seal it."""
    todo = len(pending(specs, out))
    bar = Progress(TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(),
                   TimeRemainingColumn(), console=console)
    with bar:
        task = bar.add_task("cases", total=len(specs), completed=len(specs) - todo)
        for done, astray in generate_cases(specs, out, cores):
            bar.update(task, advance=1, description=done)
            if astray:
                console.print(f"{done}: {astray}", style="red", markup=False)
    left = len(pending(specs, out))
    typer.echo(f"{len(specs)} cases, {todo - left} made now, {left} failed; "
               f"{write_manifest(out, name)}")
    if left:
        raise typer.Exit(1)


@app.command()
def world(
    name: Annotated[str, typer.Argument(help="w1, w2, w3 or w4")],
    out: Out,
    first: Annotated[int, typer.Option(help="number of the first case")] = 0,
    count: Annotated[int, typer.Option(help="how many; 24 hold every group")] = 24,
    group: Annotated[list[str] | None, typer.Option(help="only this group; repeatable")] = None,
    more: Annotated[int, typer.Option(help="more baseline and training runs of a case")] = 0,
    alike: Annotated[int, typer.Option(help="more baseline runs, driven as training is")] = 0,
    cores: Annotated[int, typer.Option(help="processes")] = 1,
) -> None:
    """Make recordings and answers of cases `first` to `first + count - 1` of a world; resumes."""
    try:
        specs = world_cases(name, first, count)
    except (ImportError, ValueError) as error:
        raise _stop(str(error)) from error
    chosen = [replace(spec, more=more, alike=alike) for spec in specs
              if not group or spec.group in group]
    _make(chosen, out, cores, name)


@app.command()
def severities(
    name: Annotated[str, typer.Argument(help="w1, w2, w3 or w4")],
    first: Annotated[int, typer.Option(help="number of the first case")],
    count: Annotated[int, typer.Option(help="how many")] = 24,
    nulls: Annotated[Path, typer.Option(help="folder where trucks with nothing missing are kept, "
                                        "for all sets of the worlds")] = Path("out/nulls"),
    trucks: Annotated[int, typer.Option(help="how many")] = 100,
) -> None:
    """Find severities for the drawn sigma_b of cases of a later draw; resumes."""
    from proving_ground.settle import settle

    try:
        for case, found in settle(name, first, count, nulls, trucks):
            typer.echo(f"{case}: severity {found['severity']}, sigma_b {found['sigma_b']}, "
                       f"spreads {found['individual']}")
    except ValueError as error:
        raise _stop(str(error)) from error


@app.command()
def sigma(
    out: Out,
    nulls: Annotated[Path, typer.Option(help="folder where trucks with nothing missing are kept, "
                                        "for all sets of the worlds")] = Path("out/nulls"),
    trucks: Annotated[int, typer.Option(help="how many; 100 for a figure to publish")] = 100,
    spreads_only: Annotated[bool, typer.Option(
        "--spreads-only", help="only each strength in spreads of fault-free vehicles: no simulation"
    )] = False,
) -> None:
    """Measure sigma_b of every effect of a set of a world on nulls of that world; resumes."""
    from proving_ground.visibility import count_spreads, measure

    try:
        if spreads_only:
            count_spreads(out)
            return
        for case, found in measure(out, nulls, trucks):
            typer.echo(f"{case}: {', '.join(f'{value:.3g}' for value in found)}")
    except ValueError as error:
        raise _stop(str(error)) from error


@app.command("apart")
def measure_how_far_apart(
    out: Out,
    nulls: Annotated[Path, typer.Option(help="as for `sigma`")] = Path("out/nulls"),
    trucks: Annotated[int, typer.Option(help="as for `sigma`")] = 100,
) -> None:
    """Measure how far effects of no list, and of a pair, are from what others imitate; resumes."""
    from proving_ground.apart import measure_apart

    try:
        for case, found in measure_apart(out, nulls, trucks):
            typer.echo(f"{case}: " + ", ".join(f"{size:.3g} beside {name}" for size, name in found))
    except ValueError as error:
        raise _stop(str(error)) from error


@app.command("list")
def list_cases(name: SetName = "dev",
               out: Annotated[Path | None, typer.Option("--out", "-o", help="write the cases as "
                              "YAML files into this folder")] = None) -> None:
    """Count the cases of a set by group and name, or write them as files."""
    specs = _table(name)
    if out is not None:
        out.mkdir(parents=True, exist_ok=True)
        for spec in specs:
            write_case(out / f"{spec.id}.yaml", spec)
    table = RichTable("group", "names", "cases")
    for group in GROUPS:
        members = [spec for spec in specs if spec.group == group]
        names = Counter(effect.name for spec in members for effect in spec.effects)
        names.update(fault.name for spec in members for fault in spec.faults)
        table.add_row(group, str(len(names)), str(len(members)))
    Console().print(table)


@app.command()
def seal(
    out: Out,
    check: Annotated[Path | None, typer.Option(help="manifest to check against")] = None,
    name: SetName = "test",
    to: Annotated[Path | None, typer.Option(help="file to publish instead of manifest.json "
                                      "beside the cases; the set must be whole")] = None,
    part: Annotated[bool, typer.Option("--part", help="publish what is made of the set")] = False,
) -> None:
    """Write the manifest of a generated set, or check the set against an earlier manifest."""
    if check is not None:
        broken = broken_seals(out, check)
        if broken:
            raise _stop(f"{len(broken)} broken seals: {', '.join(broken[:10])}")
        typer.echo("all seals hold")
        return
    left = pending(_table(name), out) if to and not part else []
    if left:
        raise _stop(f"{len(left)} cases of {name} are not made yet: {left[0].id}, ...")
    typer.echo(str(write_manifest(out, name, to)))


@app.command()
def validate(recordings: Annotated[Path | None, typer.Option(help="folder with the recordings "
                                   "`nominal/*.csv` to compare with")] = None) -> None:
    """Check the truth itself: axle loads, cornering, stops, roll, blowout; prints the figures."""
    from proving_ground.validate import figures

    table = RichTable("quantity", "value", "unit", "expected")
    for row in figures(recordings):
        table.add_row(row.name, f"{row.value:.4g}", row.unit, row.expected)
    Console().print(table)


if __name__ == "__main__":
    sys.exit(app())
