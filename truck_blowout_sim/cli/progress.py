"""The progress bar of every verb: on the terminal's error stream, silent where that is a pipe."""

from __future__ import annotations

import sys

from rich.console import Console
from rich.progress import Progress, ProgressColumn


def bar(*columns: str | ProgressColumn, stays: bool = False) -> Progress:
    """A bar that vanishes when its work is done, unless it ``stays``."""
    return Progress(*columns, console=Console(stderr=True), transient=not stays,
                    disable=not sys.stderr.isatty())
