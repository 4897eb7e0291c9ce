"""Choices in a step that is compiled for one truck and for eight abreast: no ``if`` on a truck.

Python runs what stands here. For one truck the compiler makes the same of it; for eight it works
place by place on octets, see `choose_compiled`.

References: none, this is bookkeeping.
Known limits: both sides of `where` are worked out; `any_of` around it spares a costly one.
Validated with: test/physics/test_choose.py, test/simulation/test_abreast.py.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np


def where(condition: Any, a: Any, b: Any) -> Any:
    """``a`` where the condition holds, else ``b``."""
    return a if condition else b


def any_of(condition: Any) -> bool:
    """Whether it holds for any truck, so that a branch must be taken."""
    return bool(condition)


def seldom(condition: Any) -> bool:
    """Whether a case that is costly and rare must be worked out: for eight trucks, as `any_of`.

    For one truck always: its tires stand in vectors, which a branch would break up.
    """
    return True


def shared(value: Any) -> Any:
    """A number that is the same for all trucks abreast, such as the model of a tire."""
    return value


def pick(values: Any, at: Any) -> Any:
    """``values[at]``, for each truck at a place of its own."""
    return values[at]


def whole(value: Any) -> Any:
    """Integer part, as a place, of a number that is not negative."""
    return int(value)


def nearest(value: Any) -> Any:
    """The nearest whole number."""
    return np.rint(value)


def cosine_and_sine(angle: Any) -> Any:
    """Of any angle: of one truck by the library, of eight by `trig.heading`."""
    return math.cos(angle), math.sin(angle)


def power_where(condition: Any, base: Any, exponent: Any) -> Any:
    """``base ** exponent`` where the condition holds, else ``base``."""
    return base ** exponent if condition else base


def trucks_in(values: Any) -> int:
    """How many trucks an array holds: 1 or 8."""
    return 1
