"""MCAP files written in whole chunks, so that what is on disk is always readable.

A chunk (its messages compressed, with a checksum) and its index go to the file in one write. If
that write fails, the file is cut back to the chunk before; if the process is killed, at most the
tail of one chunk is lost. Closing adds the summary that indexed readers want.

References: MCAP specification 0 (mcap.dev), records Header, Schema, Channel, Chunk, MessageIndex,
ChunkIndex, Statistics, Metadata, SummaryOffset, Footer.
Known limits: no attachments; one file, no splitting.
Validated with: test/recordings/test_bag_writer.py, test_foreign_readers.py.
"""

from __future__ import annotations

import io
import os
import struct
import zlib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import zstandard
from mcap import records
from mcap.data_stream import RecordBuilder
from mcap.opcode import Opcode

from truck_blowout_sim.errors import StorageError
from truck_blowout_sim.recordings.chunk import ChannelIndex, Chunk

MAGIC = b"\x89MCAP0\r\n"
LIBRARY = "truck_blowout_sim"
_ZSTD_LEVEL = 1
_FOOTER_SIZE = 20


@dataclass
class Contents:
    """What a file holds so far; becomes its summary.

    Attributes:
        schemas, channels: by number.
        counts: messages by channel number.
        start_ns, end_ns: of the messages; 0 in an empty file.
    """

    schemas: dict[int, records.Schema] = field(default_factory=dict)
    channels: dict[int, records.Channel] = field(default_factory=dict)
    counts: dict[int, int] = field(default_factory=dict)
    chunk_indexes: list[records.ChunkIndex] = field(default_factory=list)
    metadata_indexes: list[records.MetadataIndex] = field(default_factory=list)
    start_ns: int = 0
    end_ns: int = 0

    @property
    def message_count(self) -> int:
        """Messages in all channels."""
        return sum(self.counts.values())

    def count(self, counts: Mapping[int, int], start_ns: int, end_ns: int) -> None:
        """Take note of the messages of one chunk."""
        if not self.message_count:
            self.start_ns, self.end_ns = start_ns, end_ns
        self.start_ns, self.end_ns = min(self.start_ns, start_ns), max(self.end_ns, end_ns)
        for channel_id, number in counts.items():
            self.counts[channel_id] = self.counts.get(channel_id, 0) + number

    def statistics(self) -> records.Statistics:
        """The statistics record."""
        return records.Statistics(
            attachment_count=0,
            channel_count=len(self.channels),
            channel_message_counts=dict(self.counts),
            chunk_count=len(self.chunk_indexes),
            message_count=self.message_count,
            message_end_time=self.end_ns,
            message_start_time=self.start_ns,
            metadata_count=len(self.metadata_indexes),
            schema_count=len(self.schemas),
        )


class McapFile:
    """An MCAP file being written.

    Args:
        path: file to create; an existing one is replaced.

    Raises:
        StorageError: from any method that writes; the file then ends with the last whole chunk.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.contents = Contents()
        self.size = 0
        self._torn = False
        try:
            self._file = io.FileIO(path, "wb")
        except OSError as error:
            raise storage_error(path, error, "nothing written") from error
        self._compressor = zstandard.ZstdCompressor(level=_ZSTD_LEVEL)
        self._write(MAGIC + to_bytes(records.Header(profile="ros2", library=LIBRARY)))

    def write_metadata(self, name: str, entries: Mapping[str, str]) -> None:
        """Append a metadata record."""
        data = to_bytes(records.Metadata(name=name, metadata=dict(entries)))
        index = records.MetadataIndex(offset=self.size, length=len(data), name=name)
        self._write(data)
        self.contents.metadata_indexes.append(index)

    def write_description(self, record: records.Schema | records.Channel) -> None:
        """Append a schema or channel record."""
        self._write(to_bytes(record))

    def write_chunk(self, chunk: Chunk) -> None:
        """Compress a chunk and append it with its index."""
        content = chunk.content()
        record = records.Chunk(
            compression="zstd",
            data=self._compressor.compress(content),
            message_end_time=chunk.end_ns,
            message_start_time=chunk.start_ns,
            uncompressed_crc=zlib.crc32(content),
            uncompressed_size=len(content),
        )
        self.write_packed_chunk(record, chunk.message_indexes())

    def write_packed_chunk(self, chunk: records.Chunk, indexes: Iterable[ChannelIndex]) -> None:
        """Append a chunk that is compressed already, with the index records given."""
        body = to_bytes(chunk)
        index_offsets: dict[int, int] = {}
        parts = [body]
        at = self.size + len(body)
        counts: dict[int, int] = {}
        for index in indexes:
            index_offsets[index.channel_id] = at
            counts[index.channel_id] = len(index.entries)
            parts.append(_index_bytes(index))
            at += len(parts[-1])
        entry = records.ChunkIndex(
            chunk_length=len(body),
            chunk_start_offset=self.size,
            compression=chunk.compression,
            compressed_size=len(chunk.data),
            message_end_time=chunk.message_end_time,
            message_index_length=at - self.size - len(body),
            message_index_offsets=index_offsets,
            message_start_time=chunk.message_start_time,
            uncompressed_size=chunk.uncompressed_size,
        )
        self._write(b"".join(parts))
        self.contents.chunk_indexes.append(entry)
        self.contents.count(counts, chunk.message_start_time, chunk.message_end_time)

    def close(self) -> None:
        """Write the summary and close; the file is closed even if that fails."""
        try:
            if not self._torn:  # behind half a chunk, a summary would mislead: it gives offsets
                end = to_bytes(records.DataEnd(data_section_crc=0))
                self._write(end + _summary(self.contents, self.size + len(end)) + MAGIC)
        finally:
            self._file.close()

    def abandon(self) -> None:
        """Close without a summary: the file stays readable as an unfinished one."""
        self._file.close()

    def _write(self, data: bytes) -> None:
        left = memoryview(data)
        try:
            while left:
                left = left[self._file.write(left) or 0 :]
        except OSError as error:
            self._cut_back()
            raise storage_error(
                self.path, error, f"{self.contents.message_count} messages saved before that"
            ) from error
        self.size += len(data)

    def _cut_back(self) -> None:
        try:
            os.ftruncate(self._file.fileno(), self.size)
            self._file.seek(self.size)
        except OSError:  # the disk is gone: why the write failed says more
            self._torn = True


def to_bytes(record: records.McapRecord) -> bytes:
    """A record as it stands in a file."""
    builder = RecordBuilder()
    record.write(builder)
    data: bytes = builder.end()  # type: ignore[no-untyped-call]
    return data


def _index_bytes(index: ChannelIndex) -> bytes:
    packed = index.entries.astype("<u8").tobytes()
    length = 6 + len(packed)
    head = struct.pack("<BQHI", Opcode.MESSAGE_INDEX, length, index.channel_id, len(packed))
    return head + packed


def _summary(contents: Contents, start: int) -> bytes:
    groups: tuple[tuple[Opcode, list[records.McapRecord]], ...] = (
        (Opcode.SCHEMA, list(contents.schemas.values())),
        (Opcode.CHANNEL, list(contents.channels.values())),
        (Opcode.STATISTICS, [contents.statistics()]),
        (Opcode.CHUNK_INDEX, list(contents.chunk_indexes)),
        (Opcode.METADATA_INDEX, list(contents.metadata_indexes)),
    )
    body, offsets = b"", b""
    for opcode, members in groups:
        data = b"".join(map(to_bytes, members))
        if data:
            offset = records.SummaryOffset(opcode, start + len(body), len(data))
            offsets += to_bytes(offset)
            body += data
    head = struct.pack("<BQQQ", Opcode.FOOTER, _FOOTER_SIZE, start, start + len(body))
    crc = zlib.crc32(body + offsets + head)
    return body + offsets + head + struct.pack("<I", crc)


def storage_error(path: Path, error: OSError, saved: str) -> StorageError:
    """What the operating system refused, as the error that says what was saved before."""
    if isinstance(error, StorageError):
        return error
    words = error.strerror or str(error)
    return StorageError(f"cannot write: {words}", file=path, number=error.errno or 5, saved=saved)
