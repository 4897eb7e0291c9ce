"""What `import` and `export` share: remapping words, and what they say at the end."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import typer

from truck_blowout_sim.errors import InputError, quoted
from truck_blowout_sim.recordings import Recording


def parse_remap(words: Sequence[str]) -> dict[str, str]:
    """``FROM:=TO`` words as a mapping.

    Raises:
        InputError: a word of another form.
    """
    mapping = {}
    for word in words:
        source, sign, target = word.partition(":=")
        if not (source and sign and target):
            raise InputError(f"--remap {quoted(word)}", expected="FROM:=TO")
        mapping[source] = target
    return mapping


def warn(recording: Recording) -> None:
    """Say on stderr what the reader had to assume or leave out."""
    for note in recording.notes:
        typer.echo(f"note: {note}", err=True)


def report(recording: Recording, output: Path) -> None:
    """Say what was written."""
    tires = "+".join(tire for blowout in recording.blowouts for tire in blowout.tires)
    event = f", {tires} blown at {recording.blowouts[0].time_s:g} s" if tires else ""
    typer.echo(
        f"{output}: {len(recording.channels)} channels,"
        f" {recording.start_s:g} s to {recording.end_s:g} s{event}"
    )
