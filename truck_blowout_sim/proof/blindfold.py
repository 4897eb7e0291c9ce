"""A process that diagnoses cannot open a sealed answer, whatever its code tries.

An audit hook sees every file that Python opens and cannot be taken off again.

Validated with: test/proof/test_run.py.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path

_worn: list[bool] = []  # of this process; empty until it is put on


def blindfold() -> None:
    """From here on this process is refused every answer of a case."""
    if not blindfolded():
        sys.addaudithook(_refuse)
        _worn.append(True)


def blindfolded() -> bool:
    """Whether this process wears it."""
    return bool(_worn)


def _refuse(event: str, arguments: tuple[object, ...]) -> None:
    if event != "open" or not isinstance(arguments[0], (str, bytes)):
        return
    path = Path(os.fsdecode(arguments[0]))
    if path.name == "answers.json" or path.parent.name == "answers":
        raise PermissionError(f"{path}: a sealed answer, not for a process that diagnoses")
