"""Write docs/reference/commands.md from the programs' own help.

`python scripts/write_command_reference.py` brings the page up to date; test/test_documents.py holds
it against the programs.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import typer.main

from truck_blowout_sim.cli.main import VERBS, build

PAGE = Path(__file__).resolve().parents[1] / "docs" / "reference" / "commands.md"
HEAD = """# Commands

`truck-blowout VERB`, or `ros2 run truck_blowout_sim VERB` in a ROS 2 workspace. Exit status: 0
done; 2 bad usage or bad input, in one line; 1 an internal failure (`--traceback` shows where).
This page is written from the programs' own help.
"""


def command_reference() -> str:
    return HEAD + "".join(_verb(verb) for verb in sorted(VERBS))


def _verb(verb: str) -> str:
    app = build([verb])
    group = typer.main.get_command(app)  # type: ignore[arg-type]
    command = group.commands[verb]  # type: ignore[attr-defined]
    shown = [p for p in command.params if not getattr(p, "hidden", False)]
    about = (command.help or "").strip().split("\n\n")
    lines = [f"\n## {verb}\n", f"{about[0]}\n"]
    lines += [f"{part}\n" for part in about[1:]]
    lines += ["| argument or option | default | meaning |", "|---|---|---|"]
    lines += [_row(parameter) for parameter in shown]
    return "\n".join(lines) + "\n"


def _row(parameter: Any) -> str:  # noqa: ANN401 (typer brings a click of its own)
    option = parameter.param_type_name == "option"
    words = [*parameter.opts, *parameter.secondary_opts] if option else [parameter.name.upper()]
    name = ", ".join(f"`{word}`" for word in words)
    about = (getattr(parameter, "help", "") or "").replace("|", "\\|")
    return f"| {name} | {_default(parameter) if option else ''} | {' '.join(about.split())} |"


def _default(parameter: Any) -> str:  # noqa: ANN401
    value = parameter.default
    plain = isinstance(value, (str, int, float, Path)) and not isinstance(value, bool)
    shown = plain and str(value) not in ("", "None")
    return f"`{value}`" if shown else ""


if __name__ == "__main__":
    PAGE.write_text(command_reference(), encoding="utf-8")
    sys.stdout.write(f"{PAGE.name} written\n")
