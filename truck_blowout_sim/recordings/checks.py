"""What every reader asks of the numbers it read: finite, possible, in order of time."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings.channels import Channel

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
# header stamps of ROS 2 count seconds in 32 bits
STAMPS_END_S = 2.0**31
EARLIEST_S = -1.0e9
# A bus or an encoder now and then reads nonsense; a wrong unit does so more often than this.
_GLITCHES = 0.01


def without_glitches(
    channel: Channel, times: FloatArray, values: FloatArray, notes: list[str]
) -> tuple[FloatArray, FloatArray]:
    """Leave out an instrument's impossible readings where they are rare, with a note.

    Args:
        channel: row of the table.
        times: of the samples, in s.
        values: in the channel's unit, as `check_values` let them pass.
        notes: gets a line for what is left out.
    """
    return leave_out(_glitches(channel, values), channel, times, values, notes)


def leave_out(
    glitch: BoolArray, channel: Channel, times: FloatArray, values: FloatArray, notes: list[str]
) -> tuple[FloatArray, FloatArray]:
    """The other samples, with a note on those that are left out."""
    if not glitch.any():
        return times, values
    unit = "" if channel.unit == "1" else f" {channel.unit}"
    notes.append(
        f"{channel.name}: {np.count_nonzero(glitch)} of {values.size} readings are left out as"
        f" impossible (the first: {values[glitch][0]:g}{unit} at {times[glitch][0]:g} s)")
    return times[~glitch], values[~glitch]


def _glitches(channel: Channel, values: FloatArray) -> BoolArray:
    """Impossible readings among a hundred times as many others.

    None of a command, which the simulated truck has to obey; none where there are more, as under a
    wrong unit.
    """
    beyond = np.isfinite(values) & ~_possible(channel, values)
    few = channel.group != "input" and np.count_nonzero(beyond) <= _GLITCHES * values.size
    return beyond if few else np.zeros(values.size, dtype=bool)


def _possible(channel: Channel, values: FloatArray) -> BoolArray:
    return np.isfinite(values) & (values >= channel.lowest) & (values <= channel.highest)


def check_values(
    channel: Channel, values: FloatArray, *, file: Path, where: Callable[[int], str]
) -> None:
    """Refuse numbers that this channel cannot have.

    Args:
        channel: row of the table.
        values: in the channel's unit.
        file: for the error.
        where: place in the file of the i-th value.

    Raises:
        InputError: for the first NaN, infinity, or value out of the channel's bounds that is no
            glitch.
    """
    good = _possible(channel, values) | _glitches(channel, values)
    if good.all():
        return
    first = int(np.flatnonzero(~good)[0])
    value = values[first]
    unit = "" if channel.unit == "1" else f" {channel.unit}"
    expected = f"{channel.quantity}: {channel.lowest:g} to {channel.highest:g}{unit}"
    if not np.isfinite(value):
        expected = f"a finite number{unit and ' in' + unit}, or nothing where none was measured"
    raise InputError(
        f"{channel.name} is {float(value)!r}", file=file, where=where(first), expected=expected
    )


def check_times(times: FloatArray, *, file: Path, where: Callable[[int], str]) -> None:
    """Refuse times that do not increase strictly, or that no stamp can hold.

    Raises:
        InputError: for the first time beyond all stamps, or not later than the one before.
    """
    far = np.flatnonzero(~(np.abs(times) < STAMPS_END_S))
    if far.size:
        i = int(far[0])
        raise InputError(f"time {times[i]:.10g} s", file=file, where=where(i),
                         expected=f"seconds, below {STAMPS_END_S:.0f}")  # fmt: skip
    back = np.flatnonzero(times[1:] <= times[:-1])
    if back.size:
        i = int(back[0]) + 1
        raise InputError(
            f"time {times[i]} does not follow {times[i - 1]}",
            file=file,
            where=where(i),
            expected="times that increase from row to row",
        )
