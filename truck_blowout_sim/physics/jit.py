"""How the core is compiled: one decorator, and a cache that follows the sources.

Numba's cache looks only at the file of the cached function, so a change in a tire file would not
reach a cached step. The cache folder is therefore named after a digest of all sources here.

References: Numba manual, "Notes on Caching".
Known limits: ``fastmath`` keeps NaN and infinity exact, because both are meaningful inputs.
Validated with: test/physics/test_jit.py.
"""

from __future__ import annotations

import hashlib
import os
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar, cast

import numba
from numba import njit

Function = TypeVar("Function", bound=Callable[..., Any])


def _digest() -> str:
    """Digest of Numba's version, of physics/, and of what simulation/ compiles with it."""
    root = Path(__file__).parent
    digest = hashlib.sha256(numba.__version__.encode())
    for path in sorted(root.rglob("*.py")):
        digest.update(path.read_bytes())
    for path in sorted((root.parent / "simulation").rglob("*.py")):
        source = path.read_bytes()
        if b"physics.jit" in source:
            digest.update(source)
    return digest.hexdigest()[:16]


def _cache_folder() -> Path:
    """A writable folder for compiled code: the user's cache, else the temporary folder."""
    base = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    folder = base / "truck_blowout_sim" / _digest()
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError:
        folder = Path(tempfile.gettempdir()) / f"truck_blowout_sim-{os.getuid()}" / _digest()
        folder.mkdir(parents=True, exist_ok=True)
    return folder


if not os.environ.get("NUMBA_CACHE_DIR"):
    numba.config.CACHE_DIR = str(_cache_folder())  # type: ignore[attr-defined]

_FAST = {"contract", "arcp", "nsz", "reassoc"}


def core(function: Function) -> Function:
    """Compile a part of the core: no Python objects, cached, NaN-safe fast arithmetic, inlined.

    Calls would cost more than what they call: every array goes over as seven arguments.
    """
    return _compiled(function, inlined=True)


def entry(function: Function) -> Function:
    """Compile a function of the core that many call: as `core`, but compiled once and called."""
    return _compiled(function, inlined=False)


def _compiled(function: Function, *, inlined: bool) -> Function:
    decorate = njit(forceinline=inlined, cache=True, fastmath=_FAST, error_model="numpy",
                    nogil=True)
    return cast(Function, decorate(function))
