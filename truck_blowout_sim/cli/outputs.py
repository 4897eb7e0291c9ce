"""What every verb that writes has in common: `--force`, `--json`, nothing overwritten unasked.

A verb declares ``force: bool = FORCE`` and ``as_json: bool = JSON`` among its parameters, calls
`claim` (`recordings/claims.py`) before it computes anything, and says its result through `say`.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Collection, Iterable, Mapping, Sequence
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
