"""MDF 3 and 4, as CAN loggers write them, by asammdf (an extra).

References: ASAM MDF 3.3 and 4.2.
Known limits: channels that hold numbers only; raw CAN frames are to be decoded by the logger's own
tool or asammdf first; about one damaged file in a hundred ends the process in asammdf's C code.
Validated with: test/recordings/test_logs_binary.py.
"""

from __future__ import annotations

import contextlib
import gc
import logging
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings.logs.log import Column, find_name

CLOCK = "time stamp"
_TIME_CHANNELS = frozenset({2, 3})  # master and virtual master, MDF 4
_EXPECTED = "an MDF file of version 3 or 4"


@dataclass
class MdfLog:
    """An open MDF file; channels are read when they are asked for."""

    path: Path
    kind: str
    file: Any
    places: dict[str, tuple[int, int]]
    notes: list[str] = field(default_factory=list)
    metadata: dict[str, str] = field(default_factory=dict)

    @property
    def names(self) -> Sequence[str]:
        """Channels, time channels left out."""
        return list(self.places)

    def find(self, name: str) -> str | None:
        """The channel itself, but for case."""
        return find_name(name, self.places)

    def column(self, name: str) -> Column:
        """Read one channel with the time stamps of its group.

        Raises:
            InputError: damaged.
        """
        group, index = self.places[name]
        try:
            signal = self.file.get(group=group, index=index, ignore_invalidation_bits=True)
            numbers = signal.samples.dtype.kind in "iufb" and signal.samples.ndim == 1
            values = (signal.samples.astype(np.float64) if numbers
                      else np.full(len(signal), np.nan))  # fmt: skip
            times = np.asarray(signal.timestamps, dtype=np.float64)
            if signal.invalidation_bits is not None and numbers:
                values[np.asarray(signal.invalidation_bits, dtype=bool)] = np.nan
        except Exception as error:  # noqa: BLE001 -- the library names damage in many ways
            raise _damaged(self.path, error, f"channel {name}") from None
        bad = "" if numbers else "it holds no numbers"
        return Column(values, signal.unit or "", {CLOCK: times}, bad)


def open_mdf(path: Path) -> MdfLog:
    """Open an MDF file.

    Raises:
        InputError: asammdf is not installed; no MDF file, or damaged.
    """
    try:
        from asammdf import MDF
    except ImportError:
        raise InputError("is MDF, for which asammdf is needed", file=path,
                         expected="pip install 'truck_blowout_sim[mdf]'") from None  # fmt: skip
    logging.getLogger("asammdf").setLevel(logging.CRITICAL)
    with path.open("rb") as head:
        if head.read(3) not in (b"MDF", b"UnF"):
            raise InputError("begins with other bytes than MDF", file=path, expected=_EXPECTED)
    problem = None
    with _quiet_destructors():
        try:
            file = MDF(path)
            places = _places(file)
            metadata = {"log_start": str(file.header.start_time)}
        except Exception as error:  # noqa: BLE001 -- the library names damage in many ways
            problem = _damaged(path, error)
    if problem:
        raise problem
    return MdfLog(path, f"MDF {file.version}", file, places, metadata=metadata)


@contextlib.contextmanager
def _quiet_destructors() -> Iterator[None]:
    """A file that asammdf could not open fails once more, on stderr, when it is deleted."""
    before = sys.unraisablehook
    sys.unraisablehook = lambda _: None
    try:
        yield
        gc.collect()
    finally:
        sys.unraisablehook = before


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


def _damaged(path: Path, error: Exception, where: str = "") -> InputError:
    words = str(error).splitlines()[0] if str(error) else type(error).__name__
    return InputError(f"damaged: {words}", file=path, where=where, expected=_EXPECTED)
