"""Where a benchmark writes what it measured: to the terminal, and between two marks of a page.

Validated with: test/benchmarks/test_page.py.
"""

from __future__ import annotations

import os
import platform
import re
import sys
from collections.abc import Callable
from datetime import date
from pathlib import Path
from typing import Annotated

import typer

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.report.marked import page_with, put_on_page

Page = Annotated[Path | None, typer.Option("--page", "-o", help="Page to write the table into.")]
PROCESSOR = Path("/proc/cpuinfo")
VECTORS = (("avx512f", "AVX-512"), ("avx2", "AVX2"))


class Table:
    """A table of Markdown; each row is printed as soon as it is measured."""

    def __init__(self, *head: str) -> None:
        self.lines: list[str] = []
        self.row(*head)
        self._add("|---" * len(head) + "|")

    def row(self, *cells: str) -> None:
        """Add a row and print it."""
        self._add("|" + "".join(f" {cell} |" if cell else " |" for cell in cells))

    def _add(self, line: str) -> None:
        self.lines.append(line)
        print(line, flush=True)

    def __str__(self) -> str:
        return "\n".join(self.lines)


class Place:
    """A place on a page, known to be there before hours are spent on measuring.

    Args:
        page: the file; None: nothing is written, only printed.
        name: of the marks, ``<!-- name: begin -->``.

    Raises:
        InputError: no such file, or the marks are not in it.
    """

    def __init__(self, page: Path | None, name: str) -> None:
        self._page, self._name = page, name
        self._load = load()
        if page is not None:
            page_with(page, name, "")

    def put(self, *parts: Table | str) -> None:
        """Print on what machine a time was measured, and write that and the parts."""
        said = f"Measured {date.today().isoformat()}: {machine()}, {_loads(self._load, load())}."
        print(said)
        self.write(said, *parts)

    def write(self, *parts: Table | str) -> None:
        """Write the parts alone: no time was measured."""
        if self._page is not None:
            put_on_page(self._page, self._name, "\n\n".join(map(str, parts)))


def load() -> float:
    """Processes that ran or wanted to, mean of the last minute."""
    return os.getloadavg()[0]


def _loads(*values: float) -> str:
    low, high = f"{min(values):.1f}", f"{max(values):.1f}"
    return f"load average {low}" + ("" if low == high else f" to {high}")


def machine() -> str:
    """Processor, its widest vectors, how many cores, and the priority if it is lowered."""
    text = PROCESSOR.read_text(encoding="utf-8") if PROCESSOR.is_file() else ""
    told = dict(re.findall(r"^(model name|cpu MHz|flags)\s*: (.*)$", text, re.MULTILINE))
    name = told.get("model name") or platform.processor() or platform.machine()
    speed = f", {float(told['cpu MHz']) / 1000.0:.1f} GHz" if "cpu MHz" in told else ""
    words = told.get("flags", "").split()
    vectors = next((f", {word}" for flag, word in VECTORS if flag in words), "")
    nice = f", `nice` {os.nice(0)}" if os.nice(0) > 0 else ""
    return f"{name}{speed}{vectors}, {os.cpu_count()} cores{nice}"


def number(value: float) -> str:
    """A figure as a table shows it: three digits, or whole with commas."""
    return f"{value:,.0f}" if abs(value) >= 100.0 else f"{value:.3g}"


def start(program: Callable[[], object]) -> None:
    """Run a command line; bad input ends in one line."""
    try:
        program()
    except InputError as error:
        print(error, file=sys.stderr)
        sys.exit(2)


def start_function(function: Callable[..., None]) -> None:
    """Run a function whose arguments are the words and options of the command line."""
    app = typer.Typer(add_completion=False)
    app.command()(function)
    start(app)
