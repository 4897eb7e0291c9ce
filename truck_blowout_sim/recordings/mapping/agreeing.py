"""Guessed units held against each other, where small numbers may be in several units.

    lateral acceleration      = speed * yaw rate
    longitudinal acceleration = d(speed)/dt
    speed                     = length of d(position)/dt
    yaw rate                  = d(heading)/dt

Numbers too large for the SI unit say so themselves; small ones are in SI, or g, only by default,
and that default gives way where another unit makes both sides agree. What nothing else tells has
the unit that the log uses for the same quantity.

References: planar kinematics of a rigid body.
Known limits: accelerations tell mph from km/h, but only positions tell knots from mph.
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
from truck_blowout_sim.recordings.units import GRAVITY_MPS2, Unit, find_unit

if TYPE_CHECKING:
    from truck_blowout_sim.recordings.mapping.proposing import Proposal

FloatArray = NDArray[np.float64]

BY_SIZE = "unit from the size of the numbers"
_OTHERS = {"rad": ("deg",), "rad/s": ("deg/s",), "m/s": ("km/h", "mph"), "km/h": ("mph", "m/s"),
           "g": ("m/s2",), "m": ("ft",)}  # fmt: skip
_BY_PLACE = {"m/s": ("km/h", "mph", "knots"), "km/h": ("mph", "m/s", "knots")}
_DEFAULTS = ("rad", "rad/s", "m/s", "g")  # of numbers that are small in any unit
_OWN_UNIT = ("steering_wheel_angle_rad", "latitude_rad", "longitude_rad")  # says nothing of others
_SIBLINGS = {"yaw_rate_radps": ("roll_rate_radps", "pitch_rate_radps"), "ay_mps2": ("ax_mps2",),
             "ax_mps2": ("ay_mps2",), "vx_mps": ("vy_mps",), "x_m": ("y_m",)}  # fmt: skip
_ALIKE = 0.8  # correlation below which two sides say nothing about each other
_AGREE = math.log(1.35)  # roll adds a fifth to a lateral acceleration; units differ by 1.6 or more
_AGREE_PLACE = math.log(1.07)  # half of what knots and mph differ by
_STEP_S, _SMOOTH = 0.1, 10
_GRAVITY_CLOSE = 0.3  # of gravity: an acceleration with it, in g or m/s2
_MOVING = 0.2  # of the largest speed
_FEWEST = 20
_WRAP = 100.0  # from step to step: a heading in deg that begins at 0 again


class Guesses:
    """Proposals by channel, with their columns and the times of rows.

    Attributes:
        proposals: by channel.
        together: correlation of a heading's change, or of a lateral acceleration, with the yaw
            rate, where there is a clear one.
    """

    def __init__(
        self, pairs: Sequence[tuple[Proposal, Column]], time_s: FloatArray | None = None
    ) -> None:
        self.proposals = {proposal.channel: proposal for proposal, _ in pairs}
        self.together: dict[str, float] = {}
        self._columns = {proposal.channel: column for proposal, column in pairs}
        self._time_s = time_s
        self._settled: set[str] = set()

    def agreed(self) -> list[tuple[Proposal, Column]]:
        """The same pairs, with units that agree."""
        for unit in UNITS:
            self._hold_place(unit)
            self._hold_speed(unit)
            self._hold_turn(unit)
            self._hold_heading(unit)
        self._follow()
        return [(self.proposals[name], column) for name, column in self._columns.items()]

    def _hold_place(self, unit: str) -> None:
        names = [f"{unit}_{stem}" for stem in ("vx_mps", "x_m", "y_m")]
        sides = self._together(names, timed=True)
        if sides is not None:
            times, (speed, x, y) = sides
            moved = np.hypot(np.gradient(x, times), np.gradient(y, times))
            kept = (moved > _MOVING * moved.max(initial=0.0)) & (speed > 0.0)
            if np.count_nonzero(kept) >= _FEWEST:
                ratio = float(np.median(speed[kept] / moved[kept]))
                self._settle(names[:2], ratio, "unit from the change of position", place=True)

    def _hold_speed(self, unit: str) -> None:
        names = [f"{unit}_{stem}" for stem in ("ax_mps2", "vx_mps")]
        sides = self._together(names, timed=True)
        if sides is not None:
            times, (along, speed) = sides
            change = np.gradient(speed, times)
            mean = np.ones(_SMOOTH) / _SMOOTH
            smooth = [np.convolve(side, mean, "valid") for side in (along, change)]
            # a slope, or an instrument that leans, adds the same all the time
            found = _ratio(*(side - np.mean(side) for side in smooth))
            if found is not None:
                self._settle(names, found[0], "unit from the change of speed")

    def _hold_turn(self, unit: str) -> None:
        names = [f"{unit}_{stem}" for stem in ("ay_mps2", "vx_mps", "yaw_rate_radps")]
        sides = self._together(names, timed=False)
        if sides is not None:
            _, (lateral, speed, rate) = sides
            self._turn_alike(names, lateral, speed * rate, "unit from speed times yaw rate")

    def _hold_heading(self, unit: str) -> None:
        names = [f"{unit}_yaw_rad", f"{unit}_yaw_rate_radps"]
        sides = self._together(names, timed=True)
        if sides is not None:
            times, (heading, rate) = sides
            step = np.diff(heading)
            kept = np.abs(step) < _WRAP
            turning = step[kept] / np.diff(times)[kept]
            rates = 0.5 * (rate[1:] + rate[:-1])[kept]
            self._turn_alike(names, turning, rates, "unit from heading and yaw rate")

    def _turn_alike(self, names: Sequence[str], one: FloatArray, other: FloatArray, why: str
                    ) -> None:  # fmt: skip
        found = _ratio(one, other)
        if found is not None:
            self._settle(names, found[0], why)
            self.together[names[0]] = found[1]

    def _follow(self) -> None:
        """Small numbers that nothing tells have the unit of the same quantity in this log."""
        known: dict[tuple[str, str], tuple[str, str]] = {}
        unknown: list[tuple[str, tuple[str, str]]] = []
        for name, proposal in self.proposals.items():
            unit = self._unit(name)
            if unit is None or name.endswith(_OWN_UNIT):
                continue
            topic, colon, _ = proposal.column.partition(":")
            family = (unit.quantity, topic if colon else "")
            if not self._by_default(name) or unit.name not in _DEFAULTS or self._told(name):
                known.setdefault(family, (unit.name, proposal.column))
            elif name not in self._settled:
                unknown.append((name, family))
        for name, family in unknown:
            unit_name, column = known.get(family, self._in_degrees(family))
            if unit_name in _ways(self.proposals[name].unit):
                self._take(name, unit_name, f"unit as of {column}")

    def _in_degrees(self, family: tuple[str, str]) -> tuple[str, str]:
        """Degrees, where a logger (no ROS topic) has its speed in km/h, mph or knots."""
        quantity, topic = family
        unit = {"angle": "deg", "angular rate": "deg/s"}.get(quantity, "")
        for name, proposal in self.proposals.items():
            speed = self._unit(name)
            if unit and not topic and speed and speed.name in _ways("m/s"):
                return unit, f"a log with {proposal.column} in {speed.name}"
        return "", ""

    def _told(self, name: str) -> bool:
        """Whether gravity tells the unit of an acceleration."""
        if not name.endswith("az_mps2"):
            return False
        middle = abs(float(np.nanmedian(self._columns[name].values)))
        return any(abs(middle / gravity - 1.0) < _GRAVITY_CLOSE for gravity in (1.0, GRAVITY_MPS2))

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
        if times.size < _FEWEST:
            return None
        return times, [np.interp(times, base, values) for base, values in known]

    def _settle(
        self, names: Sequence[str], ratio: float, why: str, *, place: bool = False
    ) -> None:
        """Give way where the units as they are do not fit the ratio of the first to the others."""
        options = [self._options(name, place=place) for name in names]
        fitting = []
        for units in product(*options):
            first, *rest = (unit.factor for unit in units)
            miss = abs(math.log(ratio * first / math.prod(rest)))
            changes = sum(unit is not found[0] for unit, found in zip(units, options, strict=True))
            if miss < (_AGREE_PLACE if place else _AGREE):
                fitting.append((changes, miss, units))
        if not fitting:
            return
        self._settled |= set(names)
        for name, unit, found in zip(names, min(fitting, key=lambda f: f[:2])[2], options,
                                     strict=True):  # fmt: skip
            if unit is not found[0]:
                self._change(name, unit, why)

    def _options(self, name: str, *, place: bool) -> list[Unit]:
        """The unit as it is, then those that it may give way to."""
        found = self._unit(name)
        if found is None or not self._by_default(name):
            return [found] if found else []
        names = _ways(found.name) if place else _OTHERS.get(found.name, ())
        others = (find_unit(other) for other in names)
        return [found, *(unit for unit in others if unit)]

    def _change(self, name: str, unit: Unit, why: str) -> None:
        part, _, stem = name.partition("_")
        was = self._unit(name)
        for each in (name, *(f"{part}_{sibling}" for sibling in _SIBLINGS.get(stem, ()))):
            if each in self.proposals and self._unit(each) == was and self._by_default(each):
                self._take(each, unit.name, why)

    def _take(self, name: str, unit: str, why: str) -> None:
        words = tuple(why if text == BY_SIZE else text for text in self.proposals[name].why)
        self.proposals[name] = replace(self.proposals[name], unit=unit, why=words)

    def _by_default(self, name: str) -> bool:
        return BY_SIZE in self.proposals[name].why

    def _unit(self, name: str) -> Unit | None:
        if name not in self.proposals:
            return None
        return find_unit(self.proposals[name].unit or self._columns[name].unit)


def _ways(unit: str) -> tuple[str, ...]:
    """All units that a guessed one may give way to."""
    return _BY_PLACE.get(unit, _OTHERS.get(unit, ()))


def _ratio(one: FloatArray, other: FloatArray) -> tuple[float, float] | None:
    """How many times larger one is where both go together, in size; and their correlation."""
    there = np.isfinite(one) & np.isfinite(other)
    a, b = one[there], other[there]
    if a.size < _FEWEST or np.std(a) == 0.0 or np.std(b) == 0.0:
        return None
    together = float(np.corrcoef(a, b)[0, 1])
    ratio = abs(float(np.sum(a * b) / np.sum(b * b)))
    return (ratio, together) if abs(together) >= _ALIKE and ratio > 0.0 else None
