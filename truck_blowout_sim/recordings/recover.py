"""Make a bag whole again whose writer was killed: every whole chunk kept, index and summary new.

References: MCAP specification; rosbag2 ``metadata.yaml``.
Known limits: a chunk that breaks off in the middle is lost (at most the last half second here).
Validated with: test/recordings/test_bad_bags.py, with mcap and rosbags reading the result.
"""

from __future__ import annotations

import io
import struct
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from mcap import records
from mcap.data_stream import ReadDataStream
from mcap.exceptions import McapError
from mcap.opcode import Opcode

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings.atomic import replacing
from truck_blowout_sim.recordings.bag_metadata import describe, write_metadata
from truck_blowout_sim.recordings.bag_writer import METADATA_NAME
from truck_blowout_sim.recordings.chunk import ChannelIndex, Chunk
from truck_blowout_sim.recordings.mcap_file import McapFile
from truck_blowout_sim.recordings.mcap_parts import (
    MESSAGE_HEADER,
    chunk_records,
    unpack_chunk,
)
from truck_blowout_sim.recordings.mcap_scan import MappedFile, Record, damaged, data_records


@dataclass(frozen=True)
class Recovered:
    """What was saved.

    Attributes:
        path: file or folder that is readable again.
        messages: in it.
        lost_bytes: of the broken tail.
    """

    path: Path
    messages: int
    lost_bytes: int


def recover(path: Path, output: Path | None = None) -> Recovered:
    """Recover a bare file or a rosbag2 folder, in place unless an output is given.

    A file that is whole is rewritten with the same messages. The old file is replaced only when
    the new one is complete.

    Args:
        path: ``.mcap`` file, or folder with such files.
        output: file to write instead; for a folder, the folder.

    Raises:
        InputError: not MCAP, damaged inside, or nothing whole in it.
        StorageError: the new file cannot be written.
    """
    if not path.is_dir():
        return _recover_file(path, output or path)[0]
    files = sorted(path.glob("*.mcap"))
    if len(files) != 1:
        raise InputError(f"holds {len(files)} .mcap files", file=path, expected="a bag of one file")
    folder = output or path
    folder.mkdir(parents=True, exist_ok=True)
    saved, file, custom = _recover_file(files[0], folder / files[0].name)
    write_metadata(folder, describe(file.contents, file.path.name, custom))
    return Recovered(folder, saved.messages, saved.lost_bytes)


def _recover_file(path: Path, output: Path) -> tuple[Recovered, McapFile, dict[str, str]]:
    custom: dict[str, str] = {}
    with MappedFile(path) as data, replacing(output) as temporary:
        file = McapFile(temporary)
        good_end = 8
        for record in data_records(data, path):
            try:
                _copy(file, record, custom)
            except (struct.error, ValueError, KeyError, OverflowError, McapError) as error:
                file.abandon()
                raise damaged(path, record, error) from None
            good_end = record.end
        if not file.contents.message_count:
            file.abandon()
            raise InputError(
                "no whole chunk in it", file=path, expected="a bag with messages to recover"
            )
        file.close()
        lost = 0 if record.opcode == Opcode.DATA_END else len(data) - good_end
        file.path = output
    return Recovered(output, file.contents.message_count, lost), file, custom


def _copy(file: McapFile, record: Record, custom: dict[str, str]) -> None:
    if record.opcode == Opcode.CHUNK:
        content = unpack_chunk(record.content)
        chunk = records.Chunk.read(_stream(record.content))
        file.write_packed_chunk(chunk, _indexes(file, content))
    elif record.opcode == Opcode.METADATA:
        entry = records.Metadata.read(_stream(record.content))
        file.write_metadata(entry.name, entry.metadata)
        if entry.name == METADATA_NAME:
            custom.update(entry.metadata)
    elif record.opcode in (Opcode.SCHEMA, Opcode.CHANNEL):
        _describe(file, record.opcode, record.content)
        file.write_record(record.opcode, record.content)
    elif record.opcode == Opcode.MESSAGE:
        channel_id, _, log_time, _ = MESSAGE_HEADER.unpack_from(record.content)
        chunk_of_one = Chunk()
        body = bytes(record.content[MESSAGE_HEADER.size :])
        chunk_of_one.add_message(channel_id, log_time, body)
        file.write_chunk(chunk_of_one)


def _indexes(file: McapFile, content: bytes) -> Iterator[ChannelIndex]:
    entries: dict[int, list[tuple[int, int]]] = {}
    for opcode, at, start, stop in chunk_records(content):
        if opcode == Opcode.MESSAGE:
            channel_id, _, log_time, _ = MESSAGE_HEADER.unpack_from(content, start)
            entries.setdefault(channel_id, []).append((log_time, at))
        else:
            _describe(file, opcode, memoryview(content)[start:stop])
    for channel_id, pairs in entries.items():
        yield ChannelIndex(channel_id, np.array(pairs, dtype=np.uint64))


def _describe(file: McapFile, opcode: int, content: memoryview) -> None:
    if opcode == Opcode.SCHEMA:
        schema = records.Schema.read(_stream(content))
        file.contents.schemas[schema.id] = schema
    elif opcode == Opcode.CHANNEL:
        channel = records.Channel.read(_stream(content))
        file.contents.channels[channel.id] = channel


def _stream(content: memoryview) -> ReadDataStream:
    return ReadDataStream(io.BytesIO(bytes(content)))
