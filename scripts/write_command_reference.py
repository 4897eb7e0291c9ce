"""Write docs/reference/commands.md from the programs' own help.

`python scripts/write_command_reference.py` brings the page up to date; test/test_documents.py holds
it against the programs.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import typer.main

from truck_blowout_sim.cli.main import VERBS, build

PAGE = Path(__file__).resolve().parents[1] / "docs" / "reference" / "commands.md"
HEAD = """# Commands

`truck-blowout VERB`, or `ros2 run truck_blowout_sim VERB` in a ROS 2 workspace. Exit status: 0
done; 2 bad usage or bad input, in one line; 1 an internal failure (`--traceback` shows where);
130 interrupted.
This page is written from the programs' own help.
"""


SHARED_BY = 3  # verbs that have an option in the same words: it stands once, at the end


def command_reference() -> str:
    commands = {verb: _command(verb) for verb in sorted(VERBS)}
    count = Counter(_row(p) for command in commands.values() for p in _options(command))
    shared = sorted(row for row, verbs in count.items() if verbs >= SHARED_BY)
    pages = [_verb(verb, command, shared) for verb, command in commands.items()]
    last = ["\n## Shared options\n", *shared]
    return HEAD + "".join(pages) + "\n".join(last) + "\n"


def _command(verb: str) -> Any:  # noqa: ANN401 (typer brings a click of its own)
    group = typer.main.get_command(build([verb]))  # type: ignore[arg-type]
    return group.commands[verb]  # type: ignore[attr-defined]


def _options(command: Any) -> list[Any]:  # noqa: ANN401
    return [p for p in command.params if not getattr(p, "hidden", False)]


def _verb(verb: str, command: Any, shared: Sequence[str]) -> str:  # noqa: ANN401
    about = (command.help or "").strip().split("\n\n")
    rows = {_row(p): p for p in _options(command)}
    also = [f"`{p.opts[0]}`" for row, p in rows.items() if row in shared]
    lines = [f"\n## {verb}\n", *(f"{part}\n" for part in about)]
    lines += [row for row in rows if row not in shared]
    lines += [f"\nAnd [shared options](#shared-options): {', '.join(also)}."] if also else []
    return "\n".join(lines) + "\n"


def _row(parameter: Any) -> str:  # noqa: ANN401
    option = parameter.param_type_name == "option"
    words = [*parameter.opts, *parameter.secondary_opts] if option else [parameter.name.upper()]
    name = ", ".join(f"`{word}`" for word in words)
    about = " ".join((getattr(parameter, "help", "") or "").split())
    default = _default(parameter) if option else ""
    return f"- {name}: {about}" + (f" Default: {default}." if default else "")


def _default(parameter: Any) -> str:  # noqa: ANN401
    value = parameter.default
    plain = isinstance(value, (str, int, float, Path)) and not isinstance(value, bool)
    shown = plain and str(value) not in ("", "None")
    return f"`{value}`" if shown else ""


if __name__ == "__main__":
    PAGE.write_text(command_reference(), encoding="utf-8")
    sys.stdout.write(f"{PAGE.name} written\n")
