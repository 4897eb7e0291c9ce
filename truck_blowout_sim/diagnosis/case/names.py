"""Names of runs: events, start speeds and pictures are kept by them, so none is had twice."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

from truck_blowout_sim.recordings import Recording


def names_apart(*groups: Sequence[Recording]) -> list[list[Recording]]:
    """The groups, the second run of one name called ``drive (2)`` and so on; others as they are.

    Args:
        groups: runs by role; names are apart over all of them together.
    """
    taken = {run.name for group in groups for run in group}
    seen = Counter[str]()

    def named(run: Recording) -> Recording:
        seen[run.name] += 1
        if seen[run.name] == 1:
            return run
        name = f"{run.name} ({seen[run.name]})"
        while name in taken:
            seen[run.name] += 1
            name = f"{run.name} ({seen[run.name]})"
        taken.add(name)
        return replace(run, name=name)

    return [[named(run) for run in group] for group in groups]
