"""Reads one MDF file by asammdf, in a process of its own that `mdf_log` starts and asks.

asammdf's C code ends the process on some damaged files; here it ends only this one.

References: ASAM MDF 3.3 and 4.2.
Known limits: channels that hold numbers only; raw CAN frames are to be decoded by the logger's own
tool or asammdf first.
Validated with: test/recordings/test_logs_binary.py.
"""

from __future__ import annotations

import os
import pickle
import sys
from collections import Counter
from dataclasses import dataclass
from datetime import timezone
from typing import Any

import numpy as np

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings.logs.log import Column

CLOCK = "time stamp"
EXPECTED = "an MDF file of version 3 or 4"
_TIME_CHANNELS = frozenset({2, 3})  # master and virtual master, MDF 4


@dataclass(frozen=True)
class Contents:
    """What the file holds; columns are asked for by their names."""

    version: str
    log_start: str
    start_s: float | None
    names: tuple[str, ...]


def serve(path: str) -> None:
    """Answer the contents of a file, then each column whose name is read from stdin.

    Requests and answers are pickles; an answer that cannot be given is the `InputError`.
    """
    answer: object
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # asammdf prints
    try:
        file, places, answer = _opened(path)
    except InputError as error:
        pickle.dump(error, answers)
        return answers.close()
    while True:
        pickle.dump(answer, answers)
        answers.flush()
        try:
            name = pickle.load(sys.stdin.buffer)
        except EOFError:
            return None
        answer = _column(file, path, name, places[name])


def _opened(path: str) -> tuple[Any, dict[str, tuple[int, int]], Contents]:
    try:
        from asammdf import MDF
    except ImportError:
        raise InputError("is MDF, for which asammdf is needed", file=path,
                         expected="pip install 'truck_blowout_sim[mdf]'") from None  # fmt: skip
    try:
        file = MDF(path)
        places = _places(file)
        start_s = _start_s(file.header)
        began = "" if start_s is None else str(file.header.start_time)
        return file, places, Contents(file.version, began, start_s, tuple(places))
    except Exception as error:  # noqa: BLE001 -- the library names damage in many ways
        raise _damaged(path, error) from None


def _start_s(header: Any) -> float | None:  # noqa: ANN401 -- asammdf is untyped
    """Seconds from 1970 to time stamp 0, of local time where the file tells no zone."""
    start = header.start_time
    if start != header.start_time:  # asammdf puts the present for a date that it cannot read
        return None
    return float((start if start.tzinfo else start.replace(tzinfo=timezone.utc)).timestamp())


def _places(file: Any) -> dict[str, tuple[int, int]]:  # noqa: ANN401 -- asammdf is untyped
    """Group and index of each channel; names that occur twice carry their group's number."""
    listed = [
        (channel.name, (g, i))
        for g, group in enumerate(file.groups)
        for i, channel in enumerate(group.channels)
        if i != file.masters_db.get(g) and channel.channel_type not in _TIME_CHANNELS
    ]
    count = Counter(name for name, _ in listed)
    return {
        name if count[name] == 1 else f"{name} (group {place[0] + 1})": place
        for name, place in listed
    }


def _column(file: Any, path: str, name: str, place: tuple[int, int]) -> Column | InputError:  # noqa: ANN401
    """One channel with the time stamps of its group."""
    try:
        signal = file.get(group=place[0], index=place[1], ignore_invalidation_bits=True)
        numbers = signal.samples.dtype.kind in "iufb" and signal.samples.ndim == 1
        values = (signal.samples.astype(np.float64) if numbers
                  else np.full(len(signal), np.nan))  # fmt: skip
        times = np.asarray(signal.timestamps, dtype=np.float64)
        if signal.invalidation_bits is not None and numbers:
            values[np.asarray(signal.invalidation_bits, dtype=bool)] = np.nan
    except Exception as error:  # noqa: BLE001 -- the library names damage in many ways
        return _damaged(path, error, f"channel {name}")
    bad = "" if numbers else "it holds no numbers"
    return Column(values, signal.unit or "", {CLOCK: times}, bad)


def _damaged(path: str, error: Exception, where: str = "") -> InputError:
    words = str(error).splitlines()[0] if str(error) else type(error).__name__
    return InputError(f"damaged: {words}", file=path, where=where, expected=EXPECTED)
