"""What is whole of a damaged MCAP file, copied record by record into a new one.

A chunk whose checksum or inner lengths are wrong is left out and counted. Topics are described in
the chunk that first uses them: if that one is lost, descriptions come from the summary of a closed
file; else later messages of these topics are left out too, as nothing says what they are.

References: MCAP specification 0.
Known limits: a wrong length of a record loses what follows it; attachments are not copied.
Validated with: test/recordings/test_recover_damaged.py, test_bad_bags.py (fuzzed).
"""

from __future__ import annotations

import io
import struct
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from mcap import records
from mcap.data_stream import ReadDataStream
from mcap.exceptions import McapError
from mcap.opcode import Opcode

from truck_blowout_sim.recordings.bag_writer import METADATA_NAME
from truck_blowout_sim.recordings.chunk import ChannelIndex, Chunk
from truck_blowout_sim.recordings.mcap_file import MAGIC, McapFile
from truck_blowout_sim.recordings.mcap_parts import (
    MESSAGE_HEADER,
    RECORD_HEADER,
    DamagedError,
    chunk_records,
    unpack_chunk,
)
from truck_blowout_sim.recordings.mcap_scan import Record, kind_of, whole_records

_WRONG_INSIDE = (struct.error, ValueError, KeyError, OverflowError, MemoryError, McapError)
_FOOTER = struct.Struct("<BQQQI")
_FIRST_PRIVATE_OPCODE = 0x80

Description = records.Schema | records.Channel


@dataclass
class _Content:
    """What a chunk holds: descriptions, and (log time, byte, end) of messages by channel."""

    descriptions: list[Description] = field(default_factory=list)
    messages: dict[int, list[tuple[int, int, int]]] = field(default_factory=dict)


class Salvage:
    """A new file that takes over what is whole of another one.

    Attributes:
        custom: the simulator's metadata.
        lost: records left out, by kind.
        lost_bytes: of them, and of the tail behind the last whole record.
    """

    def __init__(self, file: McapFile, data: memoryview) -> None:
        self.custom: dict[str, str] = {}
        self.lost: Counter[str] = Counter()
        self.lost_bytes = 0
        self._file = file
        self._data = data

    def take_all(self) -> None:
        """Copy all whole records of the damaged file.

        Raises:
            StorageError: the new file cannot be written.
        """
        data, end, opcode = self._data, len(MAGIC), 0
        for record in whole_records(data):
            try:
                self._take(record)
            except _WRONG_INSIDE:
                self._lose(kind_of(record.opcode), record.end - record.start)
                self._describe_from_summary()
            end, opcode = record.end, record.opcode
        if opcode != Opcode.DATA_END and end < len(data):
            self._lose(kind_of(data[end]) if data[end] == Opcode.CHUNK else "", len(data) - end)

    def _lose(self, kind: str, size: int) -> None:
        if kind:
            self.lost[kind] += 1
        self.lost_bytes += size

    def _take(self, record: Record) -> None:
        if record.opcode == Opcode.CHUNK:
            self._take_chunk(record.content)
        elif record.opcode == Opcode.METADATA:
            entry = records.Metadata.read(_stream(record.content))
            self._file.write_metadata(entry.name, entry.metadata)
            if entry.name == METADATA_NAME:
                self.custom.update(entry.metadata)
        elif record.opcode in (Opcode.SCHEMA, Opcode.CHANNEL):
            self._describe(_description(record.opcode, record.content))
        elif record.opcode == Opcode.MESSAGE:
            self._take_message(record.content)
        elif not (record.opcode in _IGNORED or record.opcode >= _FIRST_PRIVATE_OPCODE):
            raise DamagedError(f"opcode {record.opcode} is not known")

    def _take_message(self, content: memoryview) -> None:
        channel_id, _, log_time, _ = MESSAGE_HEADER.unpack_from(content)
        if channel_id not in self._file.contents.channels:
            raise DamagedError(f"channel {channel_id} is not described")
        chunk_of_one = Chunk()
        chunk_of_one.add_message(channel_id, log_time, bytes(content[MESSAGE_HEADER.size :]))
        self._file.write_chunk(chunk_of_one)

    def _take_chunk(self, packed: memoryview) -> None:
        data = unpack_chunk(packed)
        chunk = records.Chunk.read(_stream(packed))
        content = _content(data)
        # nothing of the chunk is noted before all of it is understood
        contents = self._file.contents
        described = {d.id for d in content.descriptions if isinstance(d, records.Channel)}
        nameless = content.messages.keys() - described - contents.channels.keys()
        if nameless:
            self._take_rest_of_chunk(data, content, nameless)
            return
        for description in content.descriptions:
            self._note(description)
        self._file.write_packed_chunk(chunk, _indexes(content))

    def _take_rest_of_chunk(self, data: bytes, content: _Content, nameless: set[int]) -> None:
        """Write a chunk anew without the messages of channels that nothing describes."""
        for description in content.descriptions:
            self._describe(description)
        rest = Chunk()
        entries = [(at, end, channel_id, time_ns) for channel_id, found in content.messages.items()
                   for time_ns, at, end in found]  # fmt: skip
        for at, end, channel_id, time_ns in sorted(entries):
            if channel_id in nameless:
                self._lose(kind_of(Opcode.MESSAGE), end - at)
            else:
                start = at + RECORD_HEADER.size + MESSAGE_HEADER.size
                rest.add_message(channel_id, time_ns, data[start:end])
        if rest.message_count:
            self._file.write_chunk(rest)

    def _describe(self, description: Description) -> None:
        self._note(description)
        self._file.write_description(description)

    def _note(self, description: Description) -> None:
        contents = self._file.contents
        if isinstance(description, records.Schema):
            contents.schemas[description.id] = description
        else:
            contents.channels[description.id] = description

    @cached_property
    def _summary(self) -> list[Description]:
        return _summary_descriptions(self._data)

    def _describe_from_summary(self) -> None:
        contents = self._file.contents
        for one in self._summary:
            known = contents.schemas if isinstance(one, records.Schema) else contents.channels
            if one.id not in known:
                self._describe(one)


_IGNORED = (Opcode.HEADER, Opcode.FOOTER, Opcode.MESSAGE_INDEX, Opcode.CHUNK_INDEX,
            Opcode.ATTACHMENT, Opcode.ATTACHMENT_INDEX, Opcode.STATISTICS,
            Opcode.METADATA_INDEX, Opcode.SUMMARY_OFFSET, Opcode.DATA_END)  # fmt: skip


def _content(data: bytes) -> _Content:
    found = _Content()
    for opcode, at, start, stop in chunk_records(data):
        if opcode == Opcode.MESSAGE:
            if stop - start < MESSAGE_HEADER.size:
                raise DamagedError("a message is shorter than its own header")
            channel_id, _, log_time, _ = MESSAGE_HEADER.unpack_from(data, start)
            found.messages.setdefault(channel_id, []).append((log_time, at, stop))
        elif opcode in (Opcode.SCHEMA, Opcode.CHANNEL):
            found.descriptions.append(_description(opcode, memoryview(data)[start:stop]))
    return found


def _indexes(content: _Content) -> Iterator[ChannelIndex]:
    for channel_id, found in content.messages.items():
        yield ChannelIndex(channel_id, np.array([one[:2] for one in found], dtype=np.uint64))


def _description(opcode: int, content: memoryview) -> Description:
    of = records.Schema if opcode == Opcode.SCHEMA else records.Channel
    return of.read(_stream(content))


def _summary_descriptions(data: memoryview) -> list[Description]:
    """Schemas, then channels, of a closed file's summary; none if there is none."""
    footer_at = len(data) - len(MAGIC) - _FOOTER.size
    if footer_at < len(MAGIC) or data[-len(MAGIC) :] != MAGIC:
        return []
    opcode, _, summary_at, _, _ = _FOOTER.unpack_from(data, footer_at)
    if opcode != Opcode.FOOTER or not len(MAGIC) <= summary_at < footer_at:
        return []
    try:
        found = [_description(r.opcode, r.content) for r in whole_records(data, summary_at)
                 if r.opcode in (Opcode.SCHEMA, Opcode.CHANNEL)]  # fmt: skip
    except _WRONG_INSIDE:
        return []
    return sorted(found, key=lambda one: isinstance(one, records.Channel))


def _stream(content: memoryview) -> ReadDataStream:
    return ReadDataStream(io.BytesIO(bytes(content)))
