"""Blowouts at set instants of simulated time. Knows nothing of ROS."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator

from truck_blowout_sim.errors import InputError, quoted
from truck_blowout_sim.recordings.checks import STAMPS_END_S

_NS = 1_000_000_000
EXPECTED = "TIRE@SECONDS or HUB@SECONDS, several joined by commas, as in steer_left@10.0"


def parse(text: str, parts: Collection[str]) -> tuple[tuple[int, str], ...]:
    """(nanoseconds, tire or hub) of each blowout, in order of time.

    Args:
        text: `steer_left@10.0,drive_1_left@12`; empty: none.
        parts: names that can be blown.

    Raises:
        InputError: a word of another form, an unknown name, or a time that cannot be.
    """
    found = []
    for word in filter(None, (word.strip() for word in text.split(","))):
        part, _, seconds = word.partition("@")
        try:
            at_s = float(seconds)
        except ValueError:
            at_s = math.nan
        if part not in parts or not 0.0 <= at_s < STAMPS_END_S:
            raise InputError(
                f"{quoted(word)} is no blowout of this vehicle", file="parameter", where="blow",
                expected=EXPECTED,
            )  # fmt: skip
        found.append((round(at_s * _NS), part))
    return tuple(sorted(found))


class BlowSchedule:
    """What is still to be blown in this run.

    Args:
        plan: as `parse` gives it; instants count from the start of the run.
    """

    def __init__(self, plan: tuple[tuple[int, str], ...]) -> None:
        self._plan = plan
        self._left = list(plan)

    def due(self, elapsed_ns: int) -> Iterator[str]:
        """Parts whose instant has come; each is given once a run."""
        while self._left and self._left[0][0] <= elapsed_ns:
            yield self._left.pop(0)[1]

    def replace(self, plan: tuple[tuple[int, str], ...], elapsed_ns: int) -> None:
        """Another plan from now on; what lies in the past of this run is left out of it."""
        self._plan = plan
        self._left = [entry for entry in plan if entry[0] > elapsed_ns]

    def restart(self) -> None:
        """A run begins."""
        self._left = list(self._plan)
