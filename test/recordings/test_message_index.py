"""Index records point at the messages they speak of, in new files and in recovered ones."""

from __future__ import annotations

import struct
from pathlib import Path

import pytest
import zstandard
from mcap.records import Chunk, MessageIndex
from mcap.stream_reader import StreamReader

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import Recording, read_recording, write_recording
from truck_blowout_sim.recordings.recover import recover

MESSAGE = struct.Struct("<BQHIQQ")


def check_indexes(path: Path) -> int:
    """Look every index entry up in its chunk; returns how many there are."""
    content, seen = b"", 0
    with path.open("rb") as file:
        for record in StreamReader(file, emit_chunks=True).records:
            if isinstance(record, Chunk):
                content = zstandard.decompress(record.data, record.uncompressed_size)
            elif isinstance(record, MessageIndex):
                for log_time, at in record.records:
                    opcode, _, channel_id, _, time_ns, _ = MESSAGE.unpack_from(content, at)
                    assert (opcode, channel_id, time_ns) == (5, record.channel_id, log_time)
                    seen += 1
    return seen


@pytest.fixture
def bag(tmp_path: Path, full_recording: Recording) -> Path:
    return write_recording(full_recording, tmp_path / "bag.mcap")


def test_of_a_new_file(bag: Path) -> None:
    with bag.open("rb") as file:
        counts = [type(r).__name__ for r in StreamReader(file).records].count("Message")
    assert check_indexes(bag) == counts > 5000


def test_of_a_recovered_file(bag: Path) -> None:
    whole = check_indexes(bag)
    bag.write_bytes(bag.read_bytes()[:-100])
    assert recover(bag).messages == whole
    assert check_indexes(bag) == whole


def test_a_chunk_that_fails_its_checksum_is_refused(bag: Path) -> None:
    data = bytearray(bag.read_bytes())
    crc_at = data.index(b"\x04\x00\x00\x00zstd") - 4
    data[crc_at] ^= 0xFF
    bag.write_bytes(data)
    with pytest.raises(InputError, match="checksum"):
        read_recording(bag)
