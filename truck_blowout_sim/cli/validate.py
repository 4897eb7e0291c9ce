"""`truck-blowout validate`: the model beside the published figures, as tables."""

from __future__ import annotations

from pathlib import Path

import typer

from truck_blowout_sim.simulation.validation import as_markdown, validate

MARK = "<!-- below: written by `truck-blowout validate -o docs/validation.md` -->"


def command(
    output: Path | None = typer.Option(
        None, "-o", "--output", help="Markdown file to write; what stands above the mark in an "
        "older one is kept. To the terminal if not given."
    ),
) -> None:
    """Measure the model against the published figures of the test, in both vehicles."""
    table = as_markdown(validate(lambda words: typer.echo(words, err=True)))
    if output is None:
        typer.echo(table)
        return
    above = ""
    if output.is_file():
        # without the mark nothing in the older file is ours to replace
        above = output.read_text(encoding="utf-8").partition(MARK)[0]
    output.write_text(f"{above}{MARK}\n\n{table}", encoding="utf-8")
    typer.echo(f"{output}: written")
