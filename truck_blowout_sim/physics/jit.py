"""How the core is compiled: inlined parts, and entries that all callers share.

References: Numba manual, "Notes on Caching", ``@jit``.
Known limits: ``fastmath`` keeps NaN and infinity exact, because both are meaningful inputs.
Validated with: test/physics/test_jit.py.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar, cast

import numba
import numpy as np
from numba import njit
from numpy.typing import NDArray

from truck_blowout_sim.physics import choose_compiled  # noqa: F401  # for what it teaches
from truck_blowout_sim.physics.cache import cache_folder
from truck_blowout_sim.physics.entries import Entry, on_stack

Function = TypeVar("Function", bound=Callable[..., Any])

numba.config.CACHE_DIR = str(cache_folder())  # type: ignore[attr-defined]
PLAIN_PYTHON = bool(numba.config.DISABLE_JIT)  # type: ignore[attr-defined]
_OPTIONS: dict[str, Any] = {"cache": True, "fastmath": {"contract", "arcp", "nsz", "reassoc"},
            "error_model": "numpy", "nogil": True}


def core(function: Function) -> Function:
    """Compile a part of the core: no Python objects, cached, NaN-safe fast arithmetic, inlined."""
    return cast(Function, njit(forceinline=True, **_OPTIONS)(function))


def entry(function: Function) -> Function:
    """Compile a function of the core that many call: once, reached by its symbol.

    It is compiled, or loaded from the cache, when it or a compiled caller is first used.
    """
    return function if PLAIN_PYTHON else cast(Function, Entry(function, _OPTIONS))


def _numbers(_like: NDArray[np.float64], size: int) -> NDArray[np.float64]:
    """Uninitialized numbers."""
    return np.empty(size)


# scratch of the compiled function that asks for it: the compiler knows that nothing else is there
stack_floats = _numbers if PLAIN_PYTHON else cast(
    "Callable[[NDArray[np.float64], int], NDArray[np.float64]]", on_stack)
