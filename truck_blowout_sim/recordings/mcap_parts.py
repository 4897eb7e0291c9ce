"""Contents of MCAP records: fields, and chunks unpacked and checked."""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterator

import lz4.frame  # type: ignore[import-untyped]
import zstandard

from truck_blowout_sim.errors import quoted

RECORD_HEADER = struct.Struct("<BQ")
MESSAGE_HEADER = struct.Struct("<HIQQ")
_CHUNK = struct.Struct("<QQQII")
_LARGEST_CHUNK = 1 << 30


class DamagedError(ValueError):
    """A record's content contradicts itself."""


def unpack_chunk(content: memoryview) -> bytes:
    """Uncompressed records of a chunk, checked against size and checksum."""
    _, _, size, crc, name_size = _CHUNK.unpack_from(content)
    at = _CHUNK.size
    compression = bytes(content[at : at + name_size]).decode("utf-8", "replace")
    at += name_size
    (packed_size,) = struct.unpack_from("<Q", content, at)
    packed = bytes(content[at + 8 : at + 8 + packed_size])
    if len(packed) != packed_size or size > _LARGEST_CHUNK:
        raise DamagedError(f"sizes {packed_size} and {size} cannot be")
    data = _decompress(packed, compression, size)
    if len(data) != size:
        raise DamagedError(f"{len(data)} bytes where {size} are announced")
    if crc and zlib.crc32(data) != crc:
        raise DamagedError("the checksum does not match")
    return data


def chunk_records(data: bytes) -> Iterator[tuple[int, int, int, int]]:
    """Records in an uncompressed chunk: opcode, start of record, start and end of content."""
    at, end = 0, len(data)
    while at < end:
        opcode, length = RECORD_HEADER.unpack_from(data, at)
        start = at + RECORD_HEADER.size
        stop = start + length
        if stop > end:
            raise DamagedError(f"a record ends {stop - end} bytes beyond its chunk")
        yield opcode, at, start, stop
        at = stop


class Fields:
    """Fields of a record, one after the other."""

    def __init__(self, content: bytes) -> None:
        self._content = content
        self._at = 0

    def number(self, code: str) -> int:
        """The next field, an integer of this struct code."""
        (value,) = struct.unpack_from(code, self._content, self._at)
        self._at += struct.calcsize(code)
        return int(value)

    def text(self) -> str:
        """The next field, a text."""
        size = self.number("<I")
        end = self._at + size
        if end > len(self._content):
            raise DamagedError("a text ends beyond its record")
        text = self._content[self._at : end].decode()
        self._at = end
        return text

    def data(self) -> bytes:
        """The next field, bytes with their number before them."""
        size = self.number("<I")
        end = self._at + size
        if end > len(self._content):
            raise DamagedError("bytes end beyond their record")
        data = self._content[self._at : end]
        self._at = end
        return data

    def mapping(self) -> dict[str, str]:
        """The next field, texts by key."""
        size = self.number("<I")
        end = self._at + size
        if end > len(self._content):
            raise DamagedError("a list of entries ends beyond its record")
        entries = {}
        while self._at < end:
            key = self.text()
            entries[key] = self.text()
        return entries


def _decompress(packed: bytes, compression: str, size: int) -> bytes:
    if compression == "":
        return packed
    try:
        if compression == "zstd":
            return zstandard.ZstdDecompressor().decompress(packed, max_output_size=size)
        if compression == "lz4":
            return bytes(lz4.frame.decompress(packed))
    except (zstandard.ZstdError, RuntimeError) as error:
        raise DamagedError(f"{compression} data do not unpack ({error})") from None
    raise DamagedError(f"compression {quoted(compression)} is not known")
