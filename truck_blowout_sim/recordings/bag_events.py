"""Blowout events of a bag."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.errors import InputError, quoted
from truck_blowout_sim.recordings.bag_topics import TopicSeries
from truck_blowout_sim.recordings.names import Parts
from truck_blowout_sim.recordings.recording import Blowout
from truck_blowout_sim.recordings.resets import run_at


def read_blowouts(
    series: TopicSeries, times_s: NDArray[np.float64], parts: Parts, resets_s: Sequence[float] = ()
) -> tuple[tuple[Blowout, ...], list[str]]:
    """Events in order of time, tires blown at one instant together; and notes.

    A tire that is named again later (a latched message recorded twice) counts once in each run,
    and a reset begins another run.

    Raises:
        InputError: a name that is no tire of these parts.
    """
    at: dict[float, list[str]] = {}
    blown: set[tuple[int, str]] = set()
    notes = []
    for position, text in sorted(series.texts("data")):
        for tire in text.split("+"):
            if not parts.knows_tire(tire):
                raise InputError(
                    f"unknown tire {quoted(tire)}",
                    file=series.file,
                    where=series.where(position),
                    expected=f"one of {', '.join(parts.tires) or 'the tires of the vehicle'}",
                )
            at_s = float(times_s[position])
            if (run := run_at(at_s, resets_s), tire) in blown:
                notes.append(f"{tire} is blown again at {at_s} s: left out")
                continue
            blown.add((run, tire))
            at.setdefault(at_s, []).append(tire)
    return tuple(Blowout(time_s, tuple(tires)) for time_s, tires in sorted(at.items())), notes
