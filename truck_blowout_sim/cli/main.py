"""`truck-blowout`: finds the verb, runs it, turns every failure into one line and a status."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Sequence
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import typer

from truck_blowout_sim.cli.failures import INTERRUPTED, report
from truck_blowout_sim.cli.node import NODES
from truck_blowout_sim.cli.node import run as run_node
from truck_blowout_sim.cli.several import repeat_flags
from truck_blowout_sim.errors import InputError

PROGRAM = "truck-blowout"

# verb: (module below this package, one line of help). The help stands here and not in the module,
# so that `--help` lists every verb without importing any of them.
VERBS: dict[str, tuple[str, str]] = {
    "run": ("run", "Simulate a scenario without ROS and write a bag."),
    "inspect": ("inspect", "Show what a log holds and which channels it becomes."),
    "import": ("import_", "Convert a log of any logger to a bag."),
    "export": ("export", "Convert a bag or log to CSV, .mat or .mcap."),
    "compare": ("compare", "Drive the model with a recording's inputs and report the differences."),
    "diagnose": ("diagnose", "Locate, name and fit what the model lacks to explain recordings."),
    "calibrate": ("calibrate", "Fit the sheet's numbers to ordinary driving; write the vehicle."),
    "sweep": ("sweep", "Run a scenario many times with varied keys: one table, one page."),
    "prove": ("prove", "Run the concealed-effect benchmark and write its table."),
    "vehicle": ("vehicle", "Show loads, handling and filled-in values of a vehicle file."),
    "plot": ("plot", "Plot any channel of any run; the thesis's figures by number."),
    "view": ("view", "Show the truck of a run moving in 3-D, in one HTML file."),
    "recover": ("recover", "Repair a damaged bag, or one whose writer was killed."),
    "validate": ("validate", "Measure the model against the published figures of the test."),
}

TRACEBACK = "--traceback"


def main(arguments: Sequence[str] | None = None, program: str = PROGRAM) -> int:
    """Run one command line and return its exit status.

    Args:
        arguments: the words after the program's name; those of the process if None.
        program: the name that help and messages show.

    Returns:
        0 done; 1 internal failure; 2 bad usage or bad input; 130 interrupted.
    """
    words = list(sys.argv[1:] if arguments is None else arguments)
    if words and words[0] in NODES:
        try:
            return run_node(words[0], words[1:])
        except InputError as error:
            return report(error, program=program, traceback=False)
    # Taken wherever it stands: people add it at the end of the line that failed.
    traceback = TRACEBACK in words
    words = [word for word in words if word != TRACEBACK]
    try:
        program_of_verb = build(words)
        words = repeat_flags(words, _several_valued(words))
        status = program_of_verb(words or ["--help"], prog_name=program, standalone_mode=False,
                                 obj=tuple(words))
    except BaseException as error:  # noqa: BLE001 -- the one place where every failure ends
        return report(error, program=program, traceback=traceback)
    if status == INTERRUPTED:
        return report(KeyboardInterrupt(), program=program, traceback=traceback)
    if not words:
        return 2
    return status if isinstance(status, int) else 0


def build(words: Sequence[str] = ()) -> Callable[..., Any]:
    """Typer application for one command line; imports the module of the verb named there only."""
    # Markdown, or Rich would take "[Hz]" in a help text for a color and leave it out.
    app = typer.Typer(
        add_completion=True, pretty_exceptions_enable=False, rich_markup_mode="markdown"
    )
    app.callback()(_program)
    wanted = next((word for word in words or _words_completed() if not word.startswith("-")), None)
    for verb, (module, summary) in VERBS.items():
        full_name = f"truck_blowout_sim.cli.{module}"
        if find_spec(full_name) is None:
            continue
        if verb == wanted:
            app.command(verb)(import_module(full_name).command)
        else:
            app.command(verb, help=summary)(_not_loaded)
    for name, summary in NODES.items():
        app.command(name, help=summary)(_not_loaded)
    return app


def _several_valued(words: Sequence[str]) -> tuple[str, ...]:
    """Options of this command line's verb that take several values: ``SEVERAL`` of its module."""
    wanted = next((word for word in words if not word.startswith("-")), "")
    name, _ = VERBS.get(wanted, ("", ""))
    module = sys.modules.get(f"truck_blowout_sim.cli.{name}")
    return tuple(getattr(module, "SEVERAL", ()))


def _words_completed() -> list[str]:
    """What a shell that asks for completions has on its line, behind the program's name."""
    line = os.environ.get("COMP_WORDS", "") or os.environ.get("_TYPER_COMPLETE_ARGS", "")
    return line.split()[1:]


def ros2_verb() -> int:
    """Entry point of `ros2 run truck_blowout_sim VERB`: the program's own name is the verb."""
    verb = Path(sys.argv[0]).stem
    words = without_ros_arguments(sys.argv[1:])
    return main([verb, *words], program="ros2 run truck_blowout_sim")


def without_ros_arguments(words: Sequence[str]) -> list[str]:
    """Drop what a launch file appends for nodes: `--ros-args` up to `--` or the end."""
    kept: list[str] = []
    inside = False
    for word in words:
        if word == "--ros-args":
            inside = True
        elif inside and word == "--":
            inside = False
        elif not inside:
            kept.append(word)
    return kept


def _show_version(wanted: bool) -> None:
    if wanted:
        from truck_blowout_sim import __version__

        typer.echo(__version__)
        raise typer.Exit


def _program(
    version: bool = typer.Option(
        False,
        "--version",
        help="Print the version and exit.",
        callback=_show_version,
        is_eager=True,
    ),
    traceback: bool = typer.Option(
        False, TRACEBACK, help="Print where an error arose, not its message alone."
    ),
) -> None:
    """Tire blowouts of a tractor-semitrailer: simulate, compare with a recording, diagnose."""


def _not_loaded() -> None:
    raise AssertionError("the verb on the command line is always loaded")
