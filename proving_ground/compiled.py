"""One way to compile: cached, inlined, without reference counting.

The named tuples hold some hundred arrays; counting references to them at every call would cost
six times the arithmetic. Nothing compiled here may therefore allocate.

Numba's cache looks only at the file of the cached function, so a change in a tire file would not
reach a cached step. The cache folder is therefore named after a digest of all sources here.
"""

from __future__ import annotations

import hashlib
import os
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import numba
from numba import njit

Function = TypeVar("Function", bound=Callable[..., object])
LEAN: dict[str, Any] = {"_nrt": False, "error_model": "numpy"}


def digest() -> str:
    """Sixteen digits that change with any source file of the truth and with Numba's version."""
    total = hashlib.sha256(numba.__version__.encode())
    for path in sorted(Path(__file__).parent.rglob("*.py")):
        total.update(path.read_bytes())
    return total.hexdigest()[:16]


def cache_folder() -> Path:
    """A writable folder for compiled code: the user's cache, else a new one of this process.

    Compiled code is loaded and run, so a folder that others may have made is not used.
    """
    base = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    folder = base / "proving_ground" / digest()
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError:
        folder = Path(tempfile.mkdtemp(prefix="proving_ground-"))
    return folder


FOLDER = os.environ.get("NUMBA_CACHE_DIR") or str(cache_folder())


def _cached(function: Function, **options: object) -> Function:
    """Compile with a cache of our own: others in this process keep theirs."""
    config: Any = numba.config
    before, config.CACHE_DIR = config.CACHE_DIR, FOLDER
    try:
        choices: dict[str, Any] = {"cache": True, **options, **LEAN}
        result: Function = njit(**choices)(function)
    finally:
        config.CACHE_DIR = before
    return result


def compiled(function: Function) -> Function:
    """Compile a function that is inlined into its caller."""
    return _cached(function, forceinline=True)


def compiled_whole(function: Function) -> Function:
    """Compile a function that stays a unit of its own."""
    return _cached(function)


def compiled_here(function: Function) -> Function:
    """Compile without a cache: for a function that holds addresses of this process."""
    result: Function = njit(**LEAN)(function)
    return result
