"""`truck-blowout validate`: the model beside the published figures, as tables."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path

import typer

from truck_blowout_sim.cli.outputs import FORCE, JSON, say
from truck_blowout_sim.recordings.atomic import replacing
from truck_blowout_sim.recordings.claims import claim
from truck_blowout_sim.simulation.validation import as_markdown, validate

MARK = "<!-- below: written by `truck-blowout validate -o docs/validation.md` -->"


def command(
    output: Path | None = typer.Option(
        None, "-o", "--output", help="Markdown file to write; text above the mark in an existing "
        "file is kept. Without it, print to the terminal."
    ),
    force: bool = FORCE,
    as_json: bool = JSON,
) -> None:
    """Measure the model against the published figures of the test, in both vehicles.

    Example: truck-blowout validate -o validation.md
    """
    if output is not None:
        claim(output, force=force, one_file=True)
    sections = validate(lambda words: typer.echo(words, err=True))
    table = as_markdown(sections)
    result = {name: {mode: [asdict(row) for row in rows] for mode, rows in by_mode.items()}
              for name, by_mode in sections.items()}
    if output is None:
        say(as_json, result, [table])
        return
    above = ""
    if output.is_file():
        # without the mark nothing in the older file is ours to replace
        above = output.read_text(encoding="utf-8").partition(MARK)[0]
    with replacing(output) as temporary:
        temporary.write_text(f"{above}{MARK}\n\n{table}", encoding="utf-8")
    say(as_json, {"output": str(output), **result}, [f"{output}: written"])
