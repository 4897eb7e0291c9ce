"""Which values a study runs: every combination, or a random sample.

References: Latin hypercube sampling, McKay, Beckman & Conover 1979: each key's range is covered
evenly however few runs there are.
Validated with: test/simulation/test_studies.py.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from truck_blowout_sim.errors import InputError, quoted
from truck_blowout_sim.simulation.studies.keys import scale_of

Value = float | str
_MOST_RUNS = 10_000_000


@dataclass(frozen=True)
class Axis:
    """One key and what it may be: listed values, or a range with its number of even steps.

    Attributes:
        key: as written; ``values``: listed, empty for a range.
        low, high: ends of a range; ``count``: its values in a grid, 0: only to be sampled.
        scaled: the ends multiply the value of the file.
    """

    key: str
    values: tuple[Value, ...] = ()
    low: float = math.nan
    high: float = math.nan
    count: int = 0
    scaled: bool = False

    def grid_values(self) -> tuple[Value, ...]:
        """The values in a grid.

        Raises:
            InputError: a range without a number of values.
        """
        if self.values:
            return self.values
        if self.count < 1:
            raise InputError(f"--vary {self.key}={self.low:g}:{self.high:g}: how many values?",
                             expected="lo:hi:n, or --random N")
        return tuple(self._value(v) for v in np.linspace(self.low, self.high, self.count).tolist())

    def sampled(self, share: float) -> Value:
        """The value at a share of 0 to 1 of the axis."""
        if self.values:
            return self.values[min(int(share * len(self.values)), len(self.values) - 1)]
        return self._value(self.low + share * (self.high - self.low))

    def _value(self, number: float) -> Value:
        number = float(f"{number:.12g}")  # 0.3, not 0.30000000000000004
        return f"{number!r}x" if self.scaled else number


def parse_axis(word: str) -> Axis:
    """An axis from ``KEY=a,b,c``, ``KEY=lo:hi:n`` or ``KEY=lo:hi``; ``0.5x`` scales a file's value.

    Raises:
        InputError: a word of another form.
    """
    key, sign, text = (part.strip() for part in word.partition("="))
    if not (key and sign and text):
        raise InputError(f"--vary {quoted(word)}", expected="KEY=a,b,c or KEY=lo:hi:n")
    parts = text.split(":")
    if len(parts) == 1:
        values = tuple(_value(part.strip()) for part in text.split(","))
        if "" in values or len(set(values)) < len(values):
            raise InputError(f"--vary {quoted(word)}: a value is empty or stands there twice",
                             expected="values that differ")
        return Axis(key, values)
    scales = [scale_of(part) for part in parts[:2]]
    scaled = None not in scales
    try:
        low, high = (s if s is not None else float(p) for s, p in zip(scales, parts, strict=False))
        count = int(parts[2]) if len(parts) == 3 else 0
    except ValueError:
        raise InputError(f"--vary {quoted(word)}", expected="KEY=lo:hi:n of numbers") from None
    if len(parts) > 3 or not (math.isfinite(low) and math.isfinite(high) and low <= high
                              and (count >= 1 or len(parts) == 2)):
        raise InputError(f"--vary {quoted(word)}", expected="KEY=lo:hi:n, lo up to hi, n above 0")
    return Axis(key, (), low, high, count, scaled)


def grid(axes: Sequence[Axis]) -> list[dict[str, Value]]:
    """Every combination; the last axis changes fastest.

    Raises:
        InputError: a range without a number of values, a key twice, or far too many runs.
    """
    _check(axes)
    runs = math.prod(len(axis.values) or max(axis.count, 1) for axis in axes)
    if runs > _MOST_RUNS:  # before the values are made: they might not fit into memory
        raise InputError(f"{runs} runs", expected=f"at most {_MOST_RUNS}, or --random N")
    values = [axis.grid_values() for axis in axes]
    names = [axis.key for axis in axes]
    return [dict(zip(names, row, strict=True)) for row in itertools.product(*values)]


def sample(axes: Sequence[Axis], count: int, seed: int) -> list[dict[str, Value]]:
    """``count`` runs spread evenly over every axis, the same for the same ``seed``.

    Raises:
        InputError: a key twice, or far too many runs.
    """
    from scipy.stats import qmc

    _check(axes)
    if not 1 <= count <= _MOST_RUNS:
        raise InputError(f"--random {count}", expected=f"1 to {_MOST_RUNS} runs")
    shares = qmc.LatinHypercube(len(axes), seed=seed).random(count)
    return [{axis.key: axis.sampled(float(s)) for axis, s in zip(axes, row, strict=True)}
            for row in shares]


def _check(axes: Sequence[Axis]) -> None:
    keys = [axis.key for axis in axes]
    if not keys:
        raise InputError("nothing varies", expected="--vary KEY=a,b,c, once or more")
    for key in keys:
        if keys.count(key) > 1:
            raise InputError(f"--vary {quoted(key)} is given twice", expected="each key once")


def _value(text: str) -> Value:
    """A number, without end also as files write it (``.inf``), or else the word."""
    plain = text.lower().replace(".inf", "inf")
    try:
        number = float(plain)
    except ValueError:
        return text
    return number if math.isfinite(number) or "inf" in plain else text
