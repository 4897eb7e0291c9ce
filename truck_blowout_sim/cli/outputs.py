"""What every verb that writes has in common: `--force`, `--json`, nothing overwritten unasked.

A verb declares ``force: bool = FORCE`` and ``as_json: bool = JSON`` among its parameters, calls
`claim` before it computes anything, and says its result through `say`.
"""

from __future__ import annotations

import math
import os
import sys
from collections.abc import Collection, Iterable, Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any

import typer

from truck_blowout_sim.errors import InputError

FORCE: Any = typer.Option(False, "--force", help="Replace what already exists at the output.")
JSON: Any = typer.Option(
    False, "--json", help="Print the result as one JSON object instead of text."
)

YES: Any = typer.Option(
    False, "--yes", help="Simulate implausible input without asking, such as 300 deg of road wheel."
)


def ask_about(problems: Sequence[str], yes: bool) -> None:
    """Ask a person whether to go on in spite of problems; a pipe is refused.

    Args:
        problems: clauses; empty: nothing to ask.
        yes: the user has said so already (`--yes`).

    Raises:
        InputError: nobody can be asked, or the answer was no.
    """
    if not problems or yes:
        return
    words = f"no vehicle of this kind does this: {'; '.join(problems)}"
    if not sys.stdin.isatty() or not typer.confirm(f"{words}. Simulate it all the same?",
                                                   err=True):
        raise InputError(words, expected="plausible input, or --yes to simulate it all the same")


def claim(output: str | PathLike[str], *, force: bool = False,
          inputs: Iterable[str | PathLike[str]] = (), writes: Sequence[str] = (),
          one_file: bool = False) -> Path:
    """Check, before any work is done, that an output may be written.

    Args:
        output: the file or folder that the user named.
        force: the user allows what exists to be replaced (`--force`).
        inputs: what the verb reads: paths, or names of shipped files (those are left alone, as
            they are no paths).
        writes: names of the files and folders written inside ``output``. Empty: ``output`` itself
            is written whole, as a file or a bag.
        one_file: ``output`` becomes a file, never a bag.

    Returns:
        ``output`` as a path.

    Raises:
        InputError: the output lies on, in or around an input, even with ``force``; or it exists
            and ``force`` is not given; or it is a folder in place of a file; or nothing can be
            written there.
    """
    target = Path(output)
    if not writes and target.name in ("", ".."):
        raise InputError("is a folder that exists", file=target, expected="a new name in it")
    written = [target / name for name in writes] if writes else [target]
    for source in (Path(i) for i in inputs):
        for path in written:
            if source.exists() and _overlap(source, path):
                raise InputError(f"would be written onto the input {source}", file=path,
                                 expected="an output apart from every input")
    if writes and target.exists() and not target.is_dir():
        raise InputError("is a file", file=target, expected="a folder to write into")
    if one_file and target.is_dir():
        raise InputError("is a folder", file=target, expected="a file to write")
    if not force:
        for path in written:
            if path.exists() and not (path.is_dir() and not any(path.iterdir())):
                raise InputError("exists already", file=path,
                                 expected="a new name, or --force to replace it")
    _check_writable(target)
    return target


def free_name(name: str, taken: Collection[str]) -> str:
    """The name, with a number where others have it; some disks tell no capitals apart."""
    lower = {one.lower() for one in taken}
    tries = (name, *(f"{name}_{k}" for k in range(2, len(lower) + 3)))
    return next(one for one in tries if one.lower() not in lower)


def check_span(start_s: float | None, end_s: float | None) -> None:
    """Refuse `--start` and `--end` between which there is no time.

    Raises:
        InputError: the start is not before the end, or one of them is no number.
    """
    start, end = -math.inf if start_s is None else start_s, math.inf if end_s is None else end_s
    if not start < end:
        raise InputError(f"--start {start:g} --end {end:g}", expected="a start before the end")


def say(as_json: bool, result: Mapping[str, object], lines: Iterable[str]) -> None:
    """Print what a verb has to say: the result as one JSON object, or lines for a person.

    Args:
        as_json: the user asked for `--json`.
        result: plain data; a number that is not finite is an error (`finite_or_none` helps).
        lines: read only where they are printed.
    """
    if as_json:
        from truck_blowout_sim.comparison.plain_json import json_text

        typer.echo(json_text(result), nl=False)
        return
    for line in lines:
        typer.echo(line)


def _overlap(source: Path, written: Path) -> bool:
    """Whether one path is the other, or lies inside it; links are followed."""
    a, b = source.resolve(), written.resolve()
    return a == b or (b.is_dir() and b in a.parents) or (a.is_dir() and a in b.parents)


def _check_writable(target: Path) -> None:
    place = target if target.is_dir() else target.parent
    while not place.exists() and place != place.parent:
        place = place.parent
    problem = "is no folder" if not place.is_dir() else ""
    if not problem and not os.access(place, os.W_OK | os.X_OK):
        problem = "cannot be written to: permission denied"
    if problem:
        raise InputError(f"{place} {problem}", file=target,
                         expected="an output in a folder that you may write to")
