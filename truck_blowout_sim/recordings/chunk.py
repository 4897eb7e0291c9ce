"""Messages gathered in memory until they are written as one MCAP chunk."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.recordings.encoder import RECORD_HEADER, ByteArray, RowEncoder

_MESSAGE_OPCODE = 5


class ChannelIndex(NamedTuple):
    """Where a channel's messages lie in a chunk: rows of (log time in ns, byte)."""

    channel_id: int
    entries: NDArray[np.uint64]


@dataclass
class _Rows:
    """Where the rows of one encoder lie in the chunk: bytes, and stamps."""

    offsets: list[NDArray[np.int64]] = field(default_factory=list)
    times_ns: list[NDArray[np.int64]] = field(default_factory=list)


class Chunk:
    """An MCAP chunk under construction: records one behind the other, and where they lie."""

    def __init__(self) -> None:
        self.size = 0
        self.message_count = 0
        self.start_ns = 0
        self.end_ns = 0
        self._parts: list[bytes] = []
        self._rows: dict[RowEncoder, _Rows] = {}
        self._single: dict[int, list[tuple[int, int]]] = {}

    def content(self) -> bytes:
        """The uncompressed records."""
        return b"".join(self._parts)

    def add_record(self, data: bytes) -> None:
        """Add a schema or channel record."""
        self._parts.append(data)
        self.size += len(data)

    def add_message(self, channel_id: int, time_ns: int, data: bytes) -> None:
        """Add one serialised message."""
        self._single.setdefault(channel_id, []).append((time_ns, self.size))
        length = RECORD_HEADER.size - 9 + len(data)
        head = RECORD_HEADER.pack(_MESSAGE_OPCODE, length, channel_id, 0, time_ns, time_ns)
        self._span(time_ns, time_ns, 1)
        self.add_record(head + data)

    def add_rows(self, encoder: RowEncoder, times_ns: NDArray[np.int64], rows: ByteArray) -> None:
        """Add n instants of one encoder, shape (n, row size), in order of time."""
        n = len(times_ns)
        held = self._rows.setdefault(encoder, _Rows())
        held.offsets.append(self.size + encoder.row_size * np.arange(n))
        held.times_ns.append(times_ns)
        self._span(int(times_ns[0]), int(times_ns[-1]), n * len(encoder.slots))
        self.add_record(rows.tobytes())

    def message_indexes(self) -> Iterator[ChannelIndex]:
        """Index records by channel, entries in the order of the file."""
        entries: dict[int, list[NDArray[np.int64]]] = {}
        for encoder, held in self._rows.items():
            times = np.concatenate(held.times_ns)
            starts = np.concatenate(held.offsets)
            for channel_id, slot in zip(encoder.slot_ids, encoder.slots, strict=True):
                pair = np.stack((times, starts + slot.start), axis=1)
                entries.setdefault(channel_id, []).append(pair)
        for channel_id, single in self._single.items():
            entries.setdefault(channel_id, []).append(np.array(single, dtype=np.int64))
        for channel_id, pieces in entries.items():
            table = np.concatenate(pieces).astype("<u8")
            in_order = table[np.argsort(table[:, 1], kind="stable")]
            yield ChannelIndex(channel_id, in_order)

    def _span(self, start_ns: int, end_ns: int, count: int) -> None:
        if not self.message_count:
            self.start_ns, self.end_ns = start_ns, end_ns
        self.start_ns = min(self.start_ns, start_ns)
        self.end_ns = max(self.end_ns, end_ns)
        self.message_count += count
