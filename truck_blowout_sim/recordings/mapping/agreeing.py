"""Guessed units held against each other, where small numbers may be in several units.

    lateral acceleration = speed * yaw rate
    yaw rate             = d(heading)/dt

Numbers too large for the SI unit say so themselves; small ones are in SI, or g, only by default,
and that default gives way where the other unit makes both sides agree.

References: planar kinematics of a rigid body.
Validated with: test/recordings/test_proposing.py.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import product
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.recordings.channels import UNITS
from truck_blowout_sim.recordings.logs.log import Column
from truck_blowout_sim.recordings.units import Unit, find_unit

if TYPE_CHECKING:
    from truck_blowout_sim.recordings.mapping.proposing import Proposal

FloatArray = NDArray[np.float64]

BY_SIZE = "unit from the size of the numbers"
_OTHER = {"rad": "deg", "rad/s": "deg/s", "m/s": "km/h", "g": "m/s2"}
_SIBLINGS = {"yaw_rate_radps": ("roll_rate_radps", "pitch_rate_radps"), "ay_mps2": ("ax_mps2",)}
_ALIKE = 0.8  # correlation below which two sides say nothing about each other
_AGREE = math.log(1.35)  # roll adds a fifth to a lateral acceleration; units differ by 2.7 or more
_STEP_S = 0.1
_FEWEST = 20
_WRAP = 100.0  # from step to step: a heading in deg that begins at 0 again


class Guesses:
    """Proposals by channel, with their columns and the times of rows."""

    def __init__(
        self, pairs: Sequence[tuple[Proposal, Column]], time_s: FloatArray | None = None
    ) -> None:
        self.proposals = {proposal.channel: proposal for proposal, _ in pairs}
        self._columns = {proposal.channel: column for proposal, column in pairs}
        self._time_s = time_s

    def agreed(self) -> list[tuple[Proposal, Column]]:
        """The same pairs, with units that agree."""
        for unit in UNITS:
            self._hold_turn(unit)
            self._hold_heading(unit)
        return [(self.proposals[name], column) for name, column in self._columns.items()]

    def _hold_turn(self, unit: str) -> None:
        names = [f"{unit}_{stem}" for stem in ("ay_mps2", "vx_mps", "yaw_rate_radps")]
        sides = self._together(names, timed=False)
        if sides is not None:
            _, (lateral, speed, rate) = sides
            self._settle(names, lateral, speed * rate, "speed times yaw rate")

    def _hold_heading(self, unit: str) -> None:
        names = [f"{unit}_yaw_rad", f"{unit}_yaw_rate_radps"]
        sides = self._together(names, timed=True)
        if sides is not None:
            times, (heading, rate) = sides
            step = np.diff(heading)
            kept = np.abs(step) < _WRAP
            turning = step[kept] / np.diff(times)[kept]
            self._settle(names, turning, 0.5 * (rate[1:] + rate[:-1])[kept], "heading and yaw rate")

    def _together(
        self, names: Sequence[str], *, timed: bool
    ) -> tuple[FloatArray, list[FloatArray]] | None:
        """Columns on one time base: of their own times every 0.1 s, or row by row."""
        columns = [self._columns.get(name) for name in names]
        if any(column is None or self._unit(name) is None
               for name, column in zip(names, columns, strict=True)):  # fmt: skip
            return None
        there = [column for column in columns if column is not None]
        bases = [next(iter(column.times.values()), self._time_s) for column in there]
        if any(b is None or b.size != c.values.size for b, c in zip(bases, there, strict=True)):
            alike = len({column.values.size for column in there}) == 1
            return None if timed or not alike else (np.zeros(0), [c.values for c in there])
        known = [(b[np.isfinite(b + c.values)], c.values[np.isfinite(b + c.values)])
                 for b, c in zip(bases, there, strict=True) if b is not None]  # fmt: skip
        if any(base.size < _FEWEST or (np.diff(base) < 0.0).any() for base, _ in known):
            return None
        times = np.arange(max(b[0] for b, _ in known), min(b[-1] for b, _ in known), _STEP_S)
        return times, [np.interp(times, base, values) for base, values in known]

    def _settle(
        self, names: Sequence[str], one: FloatArray, other: FloatArray, why: str
    ) -> None:
        """Give way where the units as they are do not make ``one`` as large as ``other``."""
        ratio = _ratio(one, other)
        if ratio is None:
            return
        options = [self._options(name) for name in names]
        fitting = []
        for units in product(*options):
            first, *rest = (unit.factor for unit in units)
            miss = abs(math.log(ratio * first / math.prod(rest)))
            changes = sum(unit is not found[0] for unit, found in zip(units, options, strict=True))
            if miss < _AGREE:
                fitting.append((changes, miss, units))
        if not fitting:
            return
        for name, unit, found in zip(names, min(fitting, key=lambda f: f[:2])[2], options,
                                     strict=True):  # fmt: skip
            if unit is not found[0]:
                self._change(name, unit, f"unit from {why}")

    def _options(self, name: str) -> list[Unit]:
        """The unit as it is, then the one that it may give way to."""
        found = self._unit(name)
        other = find_unit(_OTHER.get(found.name, "")) if found else None
        return [unit for unit in (found, other if self._by_default(name) else None) if unit]

    def _change(self, name: str, unit: Unit, why: str) -> None:
        part, _, stem = name.partition("_")
        for each in (name, *(f"{part}_{sibling}" for sibling in _SIBLINGS.get(stem, ()))):
            found = self._unit(each)
            if found and _OTHER.get(found.name) == unit.name and self._by_default(each):
                words = tuple(why if text == BY_SIZE else text
                              for text in self.proposals[each].why)  # fmt: skip
                self.proposals[each] = replace(self.proposals[each], unit=unit.name, why=words)

    def _by_default(self, name: str) -> bool:
        return BY_SIZE in self.proposals[name].why

    def _unit(self, name: str) -> Unit | None:
        if name not in self.proposals:
            return None
        return find_unit(self.proposals[name].unit or self._columns[name].unit)


def _ratio(one: FloatArray, other: FloatArray) -> float | None:
    """How many times larger one is where both go together, in size."""
    there = np.isfinite(one) & np.isfinite(other)
    a, b = one[there], other[there]
    if a.size < _FEWEST or np.std(a) == 0.0 or np.std(b) == 0.0:
        return None
    if abs(float(np.corrcoef(a, b)[0, 1])) < _ALIKE:
        return None
    return abs(float(np.sum(a * b) / np.sum(b * b))) or None
