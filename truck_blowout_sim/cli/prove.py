"""`truck-blowout prove`: concealed effects, sealed answers, failures shown."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from truck_blowout_sim.cli.outputs import JSON
from truck_blowout_sim.cli.progress import bar

if TYPE_CHECKING:
    from truck_blowout_sim.proof.cases import Case


def command(
    cases: Path | None = typer.Option(
        None, "--cases", help="Folder with generated cases; without it a set is generated."
    ),
    name: str = typer.Option(
        "ci", "--set", help="Set to generate: dev, test, or ci (24 small cases, all groups)."
    ),
    limit: int = typer.Option(
        0, "--limit", min=0, help="Number of cases, spread over the set; 0: all."
    ),
    output: Path = typer.Option(
        Path("proof"), "-o", "--output", help="Folder for the report, its tables and figures."
    ),
    workers: int = typer.Option(
        os.cpu_count() or 1, "--workers", min=1, help="Processes, one case each at a time."
    ),
    manifest: Path | None = typer.Option(
        None, "--manifest", help="Sealed hashes. By default the published ones of the set, else "
        "manifest.json beside the cases."
    ),
    step_s: float = typer.Option(0.0025, "--step-s", help="Step [s]."),
    baselines: bool = typer.Option(
        True, "--baselines/--no-baselines", help="Also try the rivals on every case."
    ),
    renew: bool = typer.Option(
        False, "--renew", help="Diagnose again what another version of the code answered."
    ),
    as_json: bool = JSON,
) -> None:
    """Run the concealed-effect benchmark; an interrupted run resumes.

    Example: truck-blowout prove --set ci -o out/proof
    """
    from truck_blowout_sim.proof.cases import find_cases
    from truck_blowout_sim.proof.generate import generate_set
    from truck_blowout_sim.proof.prove import score_run
    from truck_blowout_sim.proof.run import RESULTS, Manner, read_lines, unfinished
    from truck_blowout_sim.proof.seal import find_manifest
    from truck_blowout_sim.resources import code_hash

    root = cases or generate_set(name, output, limit=limit, workers=workers)
    found = find_cases(root, limit)
    code = code_hash()
    lines = read_lines(output / RESULTS)
    todo = unfinished(found, lines, Manner(step_s, baselines, code if renew else ""))
    _say_old([lines[c.id] for c in found if c.id in lines and c not in todo], code)
    _diagnose(todo, len(found), output, workers=workers, step_s=step_s,
              with_baselines=baselines, renew=renew)
    figures = score_run(found, read_lines(output / RESULTS), output,
                        manifest or find_manifest(root, "" if cases else name))
    if as_json:
        typer.echo((output / "proof.json").read_text(encoding="utf-8"), nl=False)
    else:
        _print(figures, output)


def _diagnose(todo: Sequence[Case], total: int, output: Path, **manner: Any) -> None:  # noqa: ANN401
    """Make the answers that are not there yet, under a bar; failures are told as they come.

    ``total``: how many there will be then.
    ``manner``: as :func:`truck_blowout_sim.proof.run.run_cases` takes it.
    """
    from truck_blowout_sim.proof.run import run_cases

    with _progress() as progress:
        task = progress.add_task("diagnosing", total=total, completed=total - len(todo))
        for line in run_cases(todo, output, **manner):
            progress.update(task, advance=1, description=line["case"])
            if line["error"]:
                progress.console.print(f"{line['case']}: {line['error']}", style="red",
                                       markup=False)


def _say_old(kept: Sequence[Mapping[str, Any]], code: str) -> None:
    """Say on stderr how many answers of other code are scored as they are."""
    old = sum(line.get("code") != code for line in kept)
    if old:
        typer.echo(f"answers of another version of the code: {old}; --renew makes them anew",
                   err=True)


def _progress() -> Progress:
    return bar(TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(),
               TimeRemainingColumn(), stays=True)


def _print(figures: dict[str, Any], output: Path) -> None:
    """The proportions, and where the rest is."""
    from truck_blowout_sim.proof.statistics import Proportion

    for name, entry in figures["proportions"].items():
        typer.echo(f"{name:<52} {Proportion(entry['hits'], entry['trials'])}")
    for state, words in (("broken", "BROKEN SEALS"), ("remade", "OTHER RECORDINGS THAN SEALED")):
        if figures["seals"][state]:
            typer.echo(f"{words}: {', '.join(figures['seals'][state])}", err=True)
    typer.echo(str(output / "proof.md"))
