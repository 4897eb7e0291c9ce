"""Recording to bag: each topic's messages at its own instants, in order of time.

Channels that share their instants are encoded together, thousands of instants at a time. Where a
message can only be filled in part, its other fields say that they were not measured.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.recordings.atomic import replacing
from truck_blowout_sim.recordings.bag_target import check_target
from truck_blowout_sim.recordings.bag_writer import BagWriter
from truck_blowout_sim.recordings.channels import Channel
from truck_blowout_sim.recordings.names import parts_of
from truck_blowout_sim.recordings.recording import Blowout, Recording

_WINDOW_NS = 2_000_000_000
_WINDOW_BESIDE_NS = 100_000_000  # so far may messages of a bag be out of order
TimeArray = NDArray[np.int64]


@dataclass(frozen=True)
class _Group:
    """Channels whose messages are due at the same instants: stamps (n,), values (n, channels)."""

    names: tuple[str, ...]
    stamps_ns: TimeArray
    values: NDArray[np.float64]


@dataclass(frozen=True)
class Extra:
    """A serialised message beside the channels; a topic without leading slash is relative."""

    time_s: float
    topic: str
    ros_type: str
    data: bytes


def write_bag(recording: Recording, path: Path, beside: Iterable[Extra] = ()) -> None:
    """Write a rosbag2 folder, or a bare file if the path ends in ``.mcap``.

    The same recording gives the same bytes. A bag that is there already is replaced.

    Args:
        recording: what is written.
        path: of the bag.
        beside: further messages, in order of time.

    Raises:
        InputError: the path is a file, or a folder with other things in it.
        KeyError: a channel that is not in the table.
        StorageError: it cannot be written; nothing is left behind.
    """
    check_target(path)
    table = parts_of(recording.channels).table()
    unknown = set(recording.channels) - {channel.name for channel in table}
    if unknown:
        raise KeyError(f"not in the table of channels: {', '.join(sorted(unknown))}")
    with (
        replacing(path) as temporary,
        BagWriter(
            temporary,
            channels=table,
            time_origin_s=_origin_s(recording),
            metadata=recording.metadata,
            background=False,
            file_stem=path.name,
        ) as writer,
    ):
        _interleave(recording, _groups(recording, table, writer), writer, iter(beside))


def _origin_s(recording: Recording) -> float:
    """What stamps count from: a bag has none below zero."""
    times = [b.time_s for b in recording.blowouts] + [recording.start_s] * bool(recording.channels)
    return min(0.0, *times) if recording.channels else 0.0


def _groups(recording: Recording, table: tuple[Channel, ...], writer: BagWriter) -> list[_Group]:
    stamps = {n: writer.stamps_ns(s.time_s) for n, s in recording.channels.items()}
    topics: dict[str, list[str]] = defaultdict(list)
    for channel in table:
        if channel.name in recording and channel.place:
            topics[channel.topic].append(channel.name)
    shared: dict[bytes, tuple[TimeArray, list[str]]] = {}
    for names in topics.values():
        for members, instants in _patterns(names, stamps):
            shared.setdefault(instants.tobytes(), (instants, []))[1].extend(members)
    return [
        _Group(tuple(names), instants, _values(recording, names, instants, stamps))
        for instants, names in shared.values()
    ]


def _patterns(
    names: list[str], stamps: dict[str, TimeArray]
) -> Iterator[tuple[list[str], TimeArray]]:
    """Split a topic's instants by which of its channels have a sample there."""
    instants = np.unique(np.concatenate([stamps[name] for name in names]))
    present = np.stack([np.isin(instants, stamps[name]) for name in names], axis=1)
    for pattern in np.unique(present, axis=0):
        members = [name for name, there in zip(names, pattern, strict=True) if there]
        yield members, instants[(present == pattern).all(axis=1)]


def _values(
    recording: Recording, names: list[str], instants: TimeArray, stamps: dict[str, TimeArray]
) -> NDArray[np.float64]:
    columns = [recording[n].value[np.searchsorted(stamps[n], instants)] for n in names]
    return np.stack(columns, axis=1)


def _interleave(
    recording: Recording, groups: list[_Group], writer: BagWriter, beside: Iterator[Extra]
) -> None:
    streams = [writer.stream(group.names) for group in groups]
    events = [(writer.stamp_ns(b.time_s), b) for b in recording.blowouts]
    instants = np.concatenate([group.stamps_ns for group in groups] or [np.zeros(0, np.int64)])
    owner = np.repeat(np.arange(len(groups)), [len(group.stamps_ns) for group in groups])
    row = np.concatenate([np.arange(len(g.stamps_ns)) for g in groups] or [np.zeros(0, np.int64)])
    order = np.argsort(instants, kind="stable")
    extra = next(beside, None)
    window_ns = _WINDOW_NS if extra is None else _WINDOW_BESIDE_NS
    for run in _runs(instants[order], owner[order], [stamp for stamp, _ in events], window_ns):
        picked = order[run]
        while extra is not None and writer.stamp_ns(extra.time_s) <= instants[picked[-1]]:
            writer.message(extra.topic, extra.ros_type, extra.time_s, extra.data)
            extra = next(beside, None)
        while events and events[0][0] <= instants[picked[0]]:
            _write_event(writer, events.pop(0)[1])
        group = groups[int(owner[picked[0]])]
        rows = row[picked]
        streams[int(owner[picked[0]])].write_many(group.stamps_ns[rows], group.values[rows])
    for _, blowout in events:
        _write_event(writer, blowout)


def _runs(
    instants: TimeArray, owner: NDArray[np.int64], event_ns: list[int], window_ns: int
) -> Iterator[slice]:
    """Stretches that one group fills alone, cut at events and after a window of time."""
    if not len(instants):
        return
    window = instants // window_ns + np.searchsorted(np.array(event_ns), instants, side="right")
    cut = np.flatnonzero((np.diff(owner) != 0) | (np.diff(window) != 0)) + 1
    edges = [0, *cut.tolist(), len(instants)]
    for start, end in pairwise(edges):
        yield slice(start, end)


def _write_event(writer: BagWriter, blowout: Blowout) -> None:
    for tire in blowout.tires:
        writer.blowout(blowout.time_s, tire)
