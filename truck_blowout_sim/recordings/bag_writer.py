"""A bag written while things happen: streaming, crash-safe, in simulation time.

Samples gather in a chunk that goes to disk at least every half second of wall time (by a thread
of its own, so that a slow disk does not hold up the caller). What is on disk is readable at any
instant; see `mcap_file`. `close` adds the summary and, for a folder, ``metadata.yaml``.

References: rosbag2 folder layout; MCAP specification.
Known limits: one file, no splitting; time may not run backwards (after a reset of simulation time
a new bag is due).
Validated with: test/recordings/test_bag_writer.py (kill -9, full disk, rates).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.recordings.bag_metadata import (
    as_yaml,
    describe,
    write_metadata,
)
from truck_blowout_sim.recordings.bag_stream import BagStream
from truck_blowout_sim.recordings.bag_target import create_target
from truck_blowout_sim.recordings.cdr import template
from truck_blowout_sim.recordings.channels import (
    BLOWOUT_EVENT,
    DEFAULT_NAMESPACE,
    STRING,
    Channel,
    by_name,
    channels_for,
)
from truck_blowout_sim.recordings.chunk import Chunk
from truck_blowout_sim.recordings.chunk_sink import ChunkSink
from truck_blowout_sim.recordings.encoder import RowEncoder
from truck_blowout_sim.recordings.mcap_file import McapFile, storage_error
from truck_blowout_sim.recordings.topic_registry import TopicRegistry

METADATA_NAME = "truck_blowout_sim"
ORIGIN_KEY = "time_origin_s"
_NS = 1_000_000_000
FloatArray = NDArray[np.float64]
TimeArray = NDArray[np.int64]


@dataclass(frozen=True)
class WriterState:
    """What a recorder can say of itself.

    Attributes:
        messages: accepted so far.
        bytes_on_disk: size of the file.
        dropped: messages refused after a storage error.
        error: one line, or empty.
    """

    messages: int
    bytes_on_disk: int
    dropped: int
    error: str


class BagWriter:
    """Writes channels, blowouts and other messages to a bag.

    Args:
        path: a name that ends in ``.mcap`` gives a bare file, any other a rosbag2 folder.
        channels: the table of the vehicle, from :func:`channels_for`; the default truck's if not
            given.
        namespace: absolute prefix of all topics.
        time_origin_s: time of a sample that gets stamp 0 (negative for a recording that starts
            before its origin; ROS stamps cannot be negative).
        metadata: free text by key.
        variances: noise variance by channel name, for the messages' covariances.
        qos: QoS profile by absolute topic, as :func:`message_types.qos_profile` makes it; the
            simulator's default for other topics.
        background: flush from a thread every ``flush_s`` of wall time; without it chunks follow
            from the data alone and the same data give the same bytes.
        flush_s: longest wall time that a sample stays in memory.
        raise_errors: raise a :class:`StorageError` from the next call after the disk fails;
            otherwise samples are dropped, counted, and the error is in :attr:`state`.
        file_stem: begins the data file's name in a folder; the folder's name if not given.

    Raises:
        InputError: the path exists and is not an empty folder.
        StorageError: it cannot be created.
    """

    def __init__(
        self,
        path: str | Path,
        *,
        channels: Sequence[Channel] | None = None,
        namespace: str = DEFAULT_NAMESPACE,
        time_origin_s: float = 0.0,
        metadata: Mapping[str, str] | None = None,
        variances: Mapping[str, float] | None = None,
        qos: Mapping[str, Mapping[str, Any]] | None = None,
        background: bool = True,
        flush_s: float = 0.5,
        raise_errors: bool = True,
        file_stem: str | None = None,
    ) -> None:
        self.path = Path(path)
        self._table = by_name(channels_for() if channels is None else channels)
        self._namespace = "/" + namespace.strip("/")
        self._origin_ns = round(time_origin_s * _NS)
        self._variances = dict(variances or {})
        self._raise_errors = raise_errors
        self._custom = dict(metadata or {})
        if self._origin_ns:
            self._custom[ORIGIN_KEY] = repr(self._origin_ns / _NS)
        self._streams: dict[tuple[str, ...], BagStream] = {}
        self._file = McapFile(create_target(self.path, file_stem or self.path.name))
        self._file.write_metadata(METADATA_NAME, self._custom)
        self._topics = TopicRegistry(self._file.contents, qos)
        self._sink = ChunkSink(self._file, flush_s if background else None)

    @property
    def state(self) -> WriterState:
        """Counters and the error, if any."""
        sink = self._sink
        error = str(sink.error) if sink.error else ""
        return WriterState(sink.accepted, self._file.size, sink.dropped, error)

    def stream(self, names: Sequence[str]) -> BagStream:
        """Prepare a fixed list of channels for fast writing.

        Args:
            names: channel names of the table; those without a place in a bag are not written.
        """
        key = tuple(names)
        if key not in self._streams:
            self._streams[key] = self._new_stream(key)
        return self._streams[key]

    def write(self, time_s: float, values: Mapping[str, float]) -> None:
        """Write one instant, values by channel name."""
        self.stream(tuple(values)).write(time_s, list(values.values()))

    def blowout(self, time_s: float, tire: str) -> None:
        """Write the event that a tire is blown."""
        data = template(STRING, data=tire)
        self.message(BLOWOUT_EVENT.topic, STRING, time_s, data)

    def message(self, topic: str, ros_type: str, time_s: float, data: bytes) -> None:
        """Write any other serialised message; a topic without leading slash is relative."""
        time_ns = self.stamp_ns(time_s)
        name = self.absolute(topic)

        def fill(chunk: Chunk) -> None:
            chunk.add_message(self._topics.number(name, ros_type, chunk), time_ns, data)

        self._sink.add(1, fill)
        self._raise_if_due()

    def absolute(self, topic: str) -> str:
        """Absolute name of a topic."""
        return topic if topic.startswith("/") else f"{self._namespace}/{topic}"

    def stamp_ns(self, time_s: float) -> int:
        """Stamp of an instant of the recording's clock."""
        if not math.isfinite(time_s):
            raise ValueError(f"time {time_s} is not finite")
        stamp = round(time_s * _NS) - self._origin_ns
        if stamp < 0:
            raise ValueError(f"time {time_s} s lies before the bag's origin")
        return stamp

    def stamps_ns(self, times_s: FloatArray) -> TimeArray:
        """Stamps of many instants."""
        return np.rint(times_s * _NS).astype(np.int64) - self._origin_ns

    def flush(self) -> None:
        """Write everything accepted so far to the file."""
        self._sink.drain()
        self._raise_if_due()

    def close(self) -> None:
        """Flush, write summary and metadata, and close; a second call does nothing."""
        if self._sink.stopped:
            return
        self._sink.stop()
        try:
            self._finish()
        except OSError as error:  # also from closing the file, which may write
            told = storage_error(self.path, error, "the bag has no end")
            self._sink.error = self._sink.error or told
        self._raise_if_due()

    def __enter__(self) -> BagWriter:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def _finish(self) -> None:
        tree = describe(self._file.contents, self._file.path.name, self._custom)
        if self._sink.error is None:
            self._file.write_metadata("rosbag2", {"serialized_metadata": as_yaml(tree)})
        self._file.close()
        if self.path != self._file.path:
            write_metadata(self.path, tree)

    def _accept(self, encoder: RowEncoder, times_ns: TimeArray, values: FloatArray) -> None:
        rows = encoder.encode(times_ns, values)
        messages = len(times_ns) * len(encoder.slots)
        self._sink.add(messages, lambda chunk: chunk.add_rows(encoder, times_ns, rows))
        self._raise_if_due()

    def _raise_if_due(self) -> None:
        if self._sink.error is not None and self._raise_errors:
            raise self._sink.error

    def _new_stream(self, names: tuple[str, ...]) -> BagStream:
        unknown = [name for name in names if name not in self._table]
        if unknown:
            raise KeyError(f"not in the table of channels: {', '.join(unknown)}")
        rows = [self._table[name] for name in names]
        encoder = RowEncoder(rows, self._variances)
        ids: dict[str, int] = {}

        def describe_topics(chunk: Chunk) -> None:
            for slot in encoder.slots:
                topic = self.absolute(slot.topic)
                ids[slot.topic] = self._topics.number(topic, slot.ros_type, chunk)

        self._sink.add(0, describe_topics)
        encoder.assign(ids)
        return BagStream(encoder, stamp_ns=self.stamp_ns, accept=self._accept)
