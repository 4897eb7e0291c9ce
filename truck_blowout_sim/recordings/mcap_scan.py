"""MCAP files read front to back, finished or not.

Only what lies in the data section counts: an unfinished file (killed writer) is read up to its
last whole chunk, a finished one needs no index. Damage inside the file is an error, not an end.

References: MCAP specification 0: records and chunks; zstd, lz4 and no compression.
Known limits: the file is mapped, and its messages are held in memory.
Validated with: test/recordings/test_bad_bags.py (fuzzed), test_bag_writer.py.
"""

from __future__ import annotations

import mmap
import struct
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from mcap.opcode import Opcode

from truck_blowout_sim.errors import InputError, quoted
from truck_blowout_sim.recordings.mcap_file import MAGIC
from truck_blowout_sim.recordings.mcap_parts import (
    MESSAGE_HEADER,
    RECORD_HEADER,
    DamagedError,
    Fields,
    chunk_records,
    unpack_chunk,
)

_LAST = (Opcode.DATA_END, Opcode.FOOTER)
_SAVE_THE_REST = "`truck-blowout recover BAG` keeps what is whole"


@dataclass
class Topic:
    """Messages of one channel of the file, in the file's order; the type's definition if stated."""

    name: str
    ros_type: str
    encoding: str
    definition: str = ""
    log_times_ns: list[int] = field(default_factory=list)
    data: list[bytes] = field(default_factory=list)

    def require_type(self, ros_type: str, file: Path) -> None:
        """Refuse another type on the same topic, as its messages would be misread.

        Raises:
            InputError: it is another one.
        """
        if self.ros_type != ros_type:
            raise InputError(
                f"two types, {self.ros_type} and {ros_type}",
                file=file,
                where=f"topic /{self.name.strip('/')}",
                expected="one type a topic",
            )


@dataclass
class Scan:
    """What a file holds.

    Attributes:
        topics: by channel number.
        metadata: entries of metadata records by record name.
        finished: whether the summary and closing magic are there.
        good_end: byte after the last whole record.
        size: of the file.
    """

    topics: dict[int, Topic] = field(default_factory=dict)
    schemas: dict[int, tuple[str, str]] = field(default_factory=dict)
    metadata: dict[str, dict[str, str]] = field(default_factory=dict)
    finished: bool = False
    good_end: int = 0
    size: int = 0

    @property
    def message_count(self) -> int:
        """Messages in all topics."""
        return sum(len(topic.data) for topic in self.topics.values())


@dataclass(frozen=True)
class Record:
    """A whole record of the data section: opcode, where it starts, its content."""

    opcode: int
    start: int
    content: memoryview

    @property
    def end(self) -> int:
        """Byte after the record."""
        return self.start + RECORD_HEADER.size + len(self.content)


def scan(path: Path) -> Scan:
    """Read all messages of a file.

    Raises:
        InputError: not an MCAP file, or damaged; a missing end is no error here.
        FileNotFoundError: no such file.
    """
    result = Scan()
    with MappedFile(path) as data:
        result.size = len(data)
        result.good_end = len(MAGIC)
        for record in data_records(data, path):
            try:
                _take(result, record.opcode, record.content)
            except (struct.error, ValueError, KeyError, MemoryError) as error:
                raise damaged(path, record, error) from None
            result.good_end = record.end
            result.finished = record.opcode == Opcode.DATA_END
            record.content.release()
        result.finished = result.finished and bytes(data[-len(MAGIC) :]) == MAGIC
    return result


class MappedFile:
    """A file's bytes, mapped read-only; checks the opening magic."""

    def __init__(self, path: Path) -> None:
        self._path = path

    def __enter__(self) -> memoryview:
        with self._path.open("rb") as file:
            head = file.read(len(MAGIC))
            if head != MAGIC:
                found = "is empty" if not head else f"begins with {head.hex(' ')}"
                raise InputError(found, file=self._path, where="byte 0", expected="an MCAP file")
            self._map = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
        self._view = memoryview(self._map)
        return self._view

    def __exit__(self, *_: object) -> None:
        try:
            self._view.release()
            self._map.close()
        except BufferError:
            # an exception on its way out still holds a slice; the map goes with it
            return


def whole_records(data: memoryview, at: int = len(MAGIC)) -> Iterator[Record]:
    """Whole records up to and with DataEnd, or as far as their lengths lead."""
    while at + RECORD_HEADER.size <= len(data):
        opcode, length = RECORD_HEADER.unpack_from(data, at)
        end = at + RECORD_HEADER.size + length
        if opcode == 0 or end > len(data):
            return
        yield Record(opcode, at, data[at + RECORD_HEADER.size : end])
        if opcode in _LAST:
            return
        at = end


def data_records(data: memoryview, path: Path) -> Iterator[Record]:
    """Whole records up to and with DataEnd, or up to where the file breaks off.

    Raises:
        InputError: bytes inside that are no record.
    """
    at, opcode = len(MAGIC), 0
    for record in whole_records(data):
        at, opcode = record.end, record.opcode  # the reader may release the content
        yield record
    if opcode not in _LAST and at + RECORD_HEADER.size <= len(data) and data[at] == 0:
        raise InputError(
            "opcode 0: damaged", file=path, where=f"byte {at}",
            expected=f"an MCAP record; {_SAVE_THE_REST}",
        )  # fmt: skip


def kind_of(opcode: int) -> str:
    """What a record is called."""
    try:
        return Opcode(opcode).name.lower().replace("_", " ")
    except ValueError:
        return f"opcode {opcode}"


def damaged(path: Path, record: Record, error: Exception) -> InputError:
    """The one line for a record that is whole but wrong inside."""
    words = str(error) or type(error).__name__
    return InputError(
        f"damaged {kind_of(record.opcode)} record: {words}",
        file=path,
        where=f"byte {record.start}",
        expected=f"an undamaged MCAP file; {_SAVE_THE_REST}",
    )


def _take(result: Scan, opcode: int, content: memoryview) -> None:
    if opcode == Opcode.CHUNK:
        _take_chunk(result, unpack_chunk(content))
    elif opcode == Opcode.MESSAGE:
        _take_message(result, bytes(content))
    elif opcode in (Opcode.SCHEMA, Opcode.CHANNEL, Opcode.METADATA):
        _take_description(result, opcode, bytes(content))


def _take_chunk(result: Scan, data: bytes) -> None:
    topics = result.topics
    unpack = MESSAGE_HEADER.unpack_from
    for opcode, _, start, stop in chunk_records(data):
        if opcode == Opcode.MESSAGE:
            if stop - start < MESSAGE_HEADER.size:
                raise DamagedError("a message is shorter than its own header")
            channel_id, _, log_time, _ = unpack(data, start)
            topic = topics[channel_id]
            topic.log_times_ns.append(log_time)
            topic.data.append(data[start + MESSAGE_HEADER.size : stop])
        else:
            _take_description(result, opcode, data[start:stop])


def _take_message(result: Scan, content: bytes) -> None:
    channel_id, _, log_time, _ = MESSAGE_HEADER.unpack_from(content)
    topic = result.topics[channel_id]
    topic.log_times_ns.append(log_time)
    topic.data.append(content[MESSAGE_HEADER.size :])


def _take_description(result: Scan, opcode: int, content: bytes) -> None:
    fields = Fields(content)
    if opcode == Opcode.SCHEMA:
        schema_id = fields.number("<H")
        result.schemas[schema_id] = (fields.text(), _definition(fields))
    elif opcode == Opcode.CHANNEL:
        channel_id, schema_id = fields.number("<H"), fields.number("<H")
        name, encoding = fields.text(), fields.text()
        if channel_id not in result.topics:
            ros_type, text = result.schemas.get(schema_id, ("", ""))
            result.topics[channel_id] = Topic(name, ros_type, encoding, text)
        elif result.topics[channel_id].name != name:
            raise DamagedError(f"channel {channel_id} is {quoted(name)} here and another before")
    elif opcode == Opcode.METADATA:
        record_name = fields.text()
        result.metadata[record_name] = fields.mapping()


def _definition(fields: Fields) -> str:
    """Text of a schema record; it is read only where the type is not a standard one."""
    encoding, data = fields.text(), fields.data()
    return data.decode("utf-8", "replace") if encoding in ("ros2msg", "ros2idl") else ""
