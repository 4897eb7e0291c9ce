"""One topic of a bag as columns of numbers with stamps."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from rosbags.typesys.store import Typestore

from truck_blowout_sim.errors import InputError, quoted
from truck_blowout_sim.recordings.angles import angles
from truck_blowout_sim.recordings.cdr import Block, MalformedMessageError, blocks
from truck_blowout_sim.recordings.covariance import measured
from truck_blowout_sim.recordings.mcap_scan import Topic

FloatArray = NDArray[np.float64]
TimeArray = NDArray[np.int64]
IndexArray = NDArray[np.intp]

_NS = 1_000_000_000
_LATEST_NS = np.iinfo(np.int64).max


@dataclass
class TopicSeries:
    """Messages of one topic, taken apart.

    Attributes:
        name: absolute topic name in the file.
        ros_type: message type.
        file: where it was read.
        log_ns: when each message was logged, in order.
        header_ns: stamps in the messages, None for types without header or if never set.
        blocks: the messages' bytes by layout; ``index`` refers to the order of ``log_ns``.
    """

    name: str
    ros_type: str
    file: Path
    log_ns: TimeArray
    header_ns: TimeArray | None
    blocks: list[Block] = field(default_factory=list)

    def column(self, path: str) -> tuple[IndexArray, FloatArray]:
        """A field of all messages in which it was measured: their positions, and the numbers.

        Raises:
            InputError: an orientation without length.
        """
        pieces = [self._of_block(block, path) for block in self.blocks]
        index = np.concatenate([piece[0] for piece in pieces])
        values = np.concatenate([piece[1] for piece in pieces])
        order = np.argsort(index, kind="stable")
        return index[order], values[order]

    def texts(self, path: str) -> Iterator[tuple[int, str]]:
        """A text field of all messages, with their positions."""
        for block in self.blocks:
            for position in block.index:
                yield int(position), block.layout.texts[path]

    def joints(self) -> tuple[str, ...]:
        """Names in all messages of a JointState."""
        found: dict[str, None] = {}
        for block in self.blocks:
            found.update(dict.fromkeys(_joint_names(block)))
        return tuple(found)

    def where(self, position: int) -> str:
        """The place of a message, for an error line."""
        return (
            f"topic {self.name}, message {position + 1}, logged at {self.log_ns[position] / _NS} s"
        )

    def _of_block(self, block: Block, path: str) -> tuple[IndexArray, FloatArray]:
        if path.endswith("]") or (":" not in path and path not in block.layout.numbers):
            values = _entry_column(block, path)
            there = np.isfinite(values)
        else:
            there = measured(block, self.ros_type, path)
            values = self._angle(block, path, there) if ":" in path else block.number(path)
        return block.index[there], values[there]

    def _angle(self, block: Block, path: str, there: NDArray[np.bool_]) -> FloatArray:
        prefix, angle = path.split(":")
        xyzw = np.stack([block.number(f"{prefix}.{c}") for c in "xyzw"], axis=-1)
        bad = ~(np.linalg.norm(xyzw, axis=-1) > 0) & there
        if bad.any():
            position = int(block.index[np.flatnonzero(bad)[0]])
            raise InputError(
                f"orientation {quoted([float(v) for v in xyzw[bad][0]])}",
                file=self.file,
                where=self.where(position),
                expected="a unit quaternion (covariance -1 where there is no orientation)",
            )
        safe = np.where(there[:, None], xyzw, (0.0, 0.0, 0.0, 1.0))
        return angles(safe)[angle]


def read_topic(topic: Topic, file: Path, store: Typestore | None = None) -> TopicSeries:
    """Take a topic's messages apart; ``store``: field lists other than the standard ones.

    Raises:
        InputError: a message is not what its type says.
    """
    log = np.array(topic.log_times_ns, dtype=np.uint64)
    if (log > _LATEST_NS).any():
        raise InputError(
            f"log time {np.max(log)} ns", file=file, where=f"topic {topic.name}", expected="a time"
        )
    log_ns = log.astype(np.int64)
    order = np.argsort(log_ns, kind="stable")
    try:
        parts = list(blocks([topic.data[i] for i in order], topic.ros_type, store))
    except MalformedMessageError as error:
        position = int(error.args[1])
        raise InputError(
            str(error.args[0]),
            file=file,
            where=f"topic {topic.name}, message {position + 1}",
            expected=f"a {topic.ros_type}",
        ) from None
    series = TopicSeries(topic.name, topic.ros_type, file, log_ns[order], None, parts)
    series.header_ns = _header_stamps(series)
    return series


def _header_stamps(series: TopicSeries) -> TimeArray | None:
    stamps = np.zeros(len(series.log_ns), dtype=np.int64)
    for block in series.blocks:
        prefix = "header.stamp" if "header.stamp.sec" in block.layout.numbers else "clock"
        if f"{prefix}.sec" not in block.layout.numbers:
            return None
        sec = block.raw(f"{prefix}.sec").astype(np.int64)
        stamps[block.index] = sec * _NS + block.raw(f"{prefix}.nanosec").astype(np.int64)
    return stamps if stamps.any() else None


def _joint_names(block: Block) -> list[str]:
    return [block.layout.texts[f"name[{i}]"] for i in range(block.layout.lengths["name"])]


def _entry_column(block: Block, path: str) -> FloatArray:
    """An entry of an array, by number or by joint name; NaN where these messages lack it."""
    if path in block.layout.numbers:
        return block.number(path)
    array, _, joint = path.rstrip("]").partition("[")
    names = _joint_names(block) if "name" in block.layout.lengths else []
    if joint in names and names.index(joint) < block.layout.lengths.get(array, 0):
        return block.number(f"{array}[{names.index(joint)}]")
    return np.full(len(block.index), np.nan)
