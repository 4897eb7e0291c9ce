"""One way to compile: cached, inlined, without reference counting.

The named tuples hold some hundred arrays; counting references to them at every call would cost
six times the arithmetic. Nothing compiled here may therefore allocate. The cache of a module does
not notice a change in another one: after editing, delete `__pycache__/*.nb*`.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

from numba import njit

Function = TypeVar("Function", bound=Callable[..., object])
LEAN: dict[str, Any] = {"_nrt": False, "error_model": "numpy"}


def compiled(function: Function) -> Function:
    """Compile a function that is inlined into its caller."""
    result: Function = njit(cache=True, forceinline=True, **LEAN)(function)
    return result


def compiled_whole(function: Function) -> Function:
    """Compile a function that stays a unit of its own."""
    result: Function = njit(cache=True, **LEAN)(function)
    return result


def compiled_here(function: Function) -> Function:
    """Compile without a cache: for a function that holds addresses of this process."""
    result: Function = njit(**LEAN)(function)
    return result
