"""Channels of one instant to serialised ROS messages, by filling numbers into prepared bytes.

The messages of one instant stand one behind the other in a row of bytes, each as an MCAP message
record. Everything that never changes (names, frames, lengths, covariances) is prepared once; an
instant, or ten thousand at a time, costs a few array operations.

What was not measured says so: see `covariance`; NaN in a JointState, and no message at all where
nothing in it was measured.

References: MCAP specification, message record; sensor_msgs/Imu, nav_msgs/Odometry.
Known limits: MCAP sequence numbers stay 0, as in rosbag2.
Validated with: test/recordings/test_bag_writer.py, against `rosbags` and `mcap-ros2-support`.
"""

from __future__ import annotations

import struct
from collections.abc import Collection, Mapping, Sequence
from copy import copy
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.recordings.angles import quaternion_of
from truck_blowout_sim.recordings.cdr import template, walk
from truck_blowout_sim.recordings.channel import JOINT_STATE, Channel, Place
from truck_blowout_sim.recordings.covariance import covariance_entries

FloatArray = NDArray[np.float64]
ByteArray = NDArray[np.uint8]

RECORD_HEADER = struct.Struct("<BQHIQQ")
_MESSAGE_OPCODE = 5
_CHANNEL_ID_AT, _LOG_TIME_AT, _PUBLISH_TIME_AT = 9, 15, 23


@dataclass(frozen=True)
class TopicSlot:
    """One topic's message in the row: its record starts at byte ``start`` and has ``size``."""

    topic: str
    ros_type: str
    start: int
    size: int


@dataclass
class _Sources:
    """Which number goes to which byte: ``row[at:at+8] = sign * extended[index] + offset``."""

    at: list[int] = field(default_factory=list)
    index: list[int] = field(default_factory=list)
    sign: list[float] = field(default_factory=list)
    offset: list[float] = field(default_factory=list)

    def add(self, at: int, index: int, sign: float = 1.0, offset: float = 0.0) -> None:
        self.at.append(at)
        self.index.append(index)
        self.sign.append(sign)
        self.offset.append(offset)


class RowEncoder:
    """Turns values of a fixed list of channels into rows of MCAP message records.

    Args:
        channels: rows of the table, in the order of the values to come. Those without a place
            in a bag are ignored.
        variances: noise variance (SI, squared) by channel name for the covariance fields; 0 says
            that it is not stated.
    """

    def __init__(
        self,
        channels: Sequence[Channel],
        variances: Mapping[str, float] | None = None,
    ) -> None:
        self.channels = tuple(channels)
        self.slot_ids: tuple[int, ...] = ()
        self._variances = dict(variances or {})
        self._sources = _Sources()
        self._angles: list[tuple[int, int, int]] = []
        self._stamps: list[int] = []
        self._row = bytearray()
        self.slots: tuple[TopicSlot, ...] = tuple(
            self._add_topic(topic, fields) for topic, fields in self._by_topic().items()
        )
        self._freeze()

    def assign(self, channel_ids: Mapping[str, int]) -> None:
        """Put the MCAP channel number of each topic (relative name) into the records.

        After a storage error topics get no number any more; nothing is written then either.
        """
        self.slot_ids = tuple(channel_ids.get(slot.topic, 0) for slot in self.slots)
        for slot, channel_id in zip(self.slots, self.slot_ids, strict=True):
            at = slot.start + _CHANNEL_ID_AT
            self._template[at : at + 2] = list(channel_id.to_bytes(2, "little"))

    @property
    def row_size(self) -> int:
        """Bytes of one row."""
        return int(self._template.size)

    def encode(self, times_ns: NDArray[np.int64], values: FloatArray) -> ByteArray:
        """Rows of bytes for n instants.

        Args:
            times_ns: shape (n,), stamps, not negative.
            values: shape (n, channels), in the channels' own units.
        """
        n = len(times_ns)
        rows = np.repeat(self._template[None, :], n, axis=0)
        numbers = self._extended(values)[:, self._index] * self._sign + self._offset
        rows[:, self._number_bytes] = np.ascontiguousarray(numbers, dtype="<f8").view(np.uint8)
        times8 = np.ascontiguousarray(times_ns, dtype="<i8").view(np.uint8).reshape(n, 1, 8)
        rows[:, self._time_bytes] = times8
        if self._stamps:
            rows[:, self._stamp_bytes] = _stamps(times_ns).reshape(n, 1, 8)
        return rows

    def messages(self, time_ns: int, values: Sequence[float] | FloatArray) -> dict[str, bytes]:
        """Serialised messages of one instant by relative topic, e.g. to publish them."""
        row = self._template.copy()
        extended = self._extended(np.asarray(values, dtype=np.float64)[None, :])[0]
        numbers = extended[self._index] * self._sign + self._offset
        row[self._number_bytes] = numbers.astype("<f8", copy=False).view(np.uint8)
        if self._stamps:
            stamp = np.array(divmod(time_ns, 1_000_000_000), dtype="<u4")
            row[self._stamp_bytes] = stamp.view(np.uint8)
        data = row.tobytes()
        skip = RECORD_HEADER.size
        return {s.topic: data[s.start + skip : s.start + s.size] for s in self.slots}

    def only(self, topics: Collection[str]) -> RowEncoder:
        """An encoder of the same channels that fills some of the topics; made quickly.

        Its `messages` are those of this encoder; its rows are not for a bag.
        """
        out = copy(self)
        out.slots = tuple(slot for slot in self.slots if slot.topic in topics)
        inside = [(slot.start, slot.start + slot.size) for slot in out.slots]
        kept = [at for at in range(len(self._index)) if _within(self._sources.at[at], inside)]
        index = self._index[kept]
        # angles that no quaternion of these topics needs are not turned into one
        first = len(self.channels) + 1
        angles = sorted({(int(i) - first) // 4 for i in index if i >= first})
        moved = {first + 4 * angle + k: first + 4 * new + k
                 for new, angle in enumerate(angles) for k in range(4)}  # fmt: skip
        out._angles = [self._angles[angle] for angle in angles]
        out._angle_index = self._angle_index[angles]
        out._index = np.array([moved.get(int(i), int(i)) for i in index], dtype=np.intp)
        out._sign, out._offset = self._sign[kept], self._offset[kept]
        out._number_bytes = self._number_bytes.reshape(-1, 8)[kept].ravel()
        out._stamps = [at for at in self._stamps if _within(at, inside)]
        out._stamp_bytes = np.array(out._stamps, dtype=np.intp)[:, None] + np.arange(8)
        return out

    def fills_from(self, columns: Collection[int]) -> bool:
        """Whether a number of these columns goes into a message."""
        return not set(columns).isdisjoint(self._index.tolist())

    def _by_topic(self) -> dict[str, dict[str, tuple[int, Place]]]:
        topics: dict[str, dict[str, tuple[int, Place]]] = {}
        for index, channel in enumerate(self.channels):
            if channel.place:
                topics.setdefault(channel.place.topic, {})
            for place in channel.places:
                topics.setdefault(place.topic, {})[place.field] = (index, place)
        # a message that would carry nothing but copies of what another one says is left out
        primary = {channel.topic for channel in self.channels if channel.place}
        return {topic: fields for topic, fields in topics.items() if topic in primary}

    def _add_topic(self, topic: str, fields: dict[str, tuple[int, Place]]) -> TopicSlot:
        place = next(iter(fields.values()))[1]
        joints = _joint_names(fields)
        data = bytearray(self._template_of(place, fields, joints))
        numbers = walk(bytes(data), place.ros_type).numbers
        for path, value in self._covariances(place.ros_type, fields).items():
            struct.pack_into("<d", data, numbers[path][0], value)
        start = len(self._row)
        origin = start + RECORD_HEADER.size
        for path, (index, where) in fields.items():
            if ":" not in path:
                at = origin + numbers[_indexed(path, joints)][0]
                self._sources.add(at, index, where.sign, where.offset)
        self._add_quaternions(fields, {path: origin + at for path, (at, _) in numbers.items()})
        if "header.stamp.sec" in numbers:
            self._stamps.append(origin + numbers["header.stamp.sec"][0])
        length = RECORD_HEADER.size - 9 + len(data)
        header = RECORD_HEADER.pack(_MESSAGE_OPCODE, length, 0, 0, 0, 0)
        self._row += header + data
        return TopicSlot(topic, place.ros_type, start, len(header) + len(data))

    @staticmethod
    def _template_of(
        place: Place, fields: dict[str, tuple[int, Place]], joints: tuple[str, ...]
    ) -> bytes:
        values: dict[str, object] = {}
        if place.ros_type == JOINT_STATE:
            values["name"] = list(joints)
            for kind in ("position", "velocity"):
                if any(path.startswith(kind) for path in fields):
                    values[kind] = np.full(len(joints), np.nan)
        elif place.frame:
            values["header__frame_id"] = place.frame
        if place.child_frame:
            values["child_frame_id"] = place.child_frame
        return template(place.ros_type, **values)

    def _covariances(self, ros_type: str, fields: dict[str, tuple[int, Place]]) -> dict[str, float]:
        def variance(path: str) -> float | None:
            if path not in fields:
                return None
            return self._variances.get(self.channels[fields[path][0]].name, 0.0)

        return covariance_entries(ros_type, variance)

    def _add_quaternions(self, fields: dict[str, tuple[int, Place]], at: Mapping[str, int]) -> None:
        for prefix in dict.fromkeys(path.split(":")[0] for path in fields if ":" in path):
            names = (f"{prefix}:{angle}" for angle in ("roll", "pitch", "yaw"))
            # index -1 is the zero that `_extended` appends: an angle that was not measured
            roll, pitch, yaw = (fields[n][0] if n in fields else -1 for n in names)
            triple = (roll, pitch, yaw)
            if triple not in self._angles:
                self._angles.append(triple)
            first = len(self.channels) + 1 + 4 * self._angles.index(triple)
            for component, letter in enumerate("xyzw"):
                self._sources.add(at[f"{prefix}.{letter}"], first + component)

    def _extended(self, values: FloatArray) -> FloatArray:
        n, k = values.shape
        out = np.zeros((n, k + 1 + 4 * len(self._angles)))
        out[:, :k] = values
        if self._angles:
            out[:, k + 1 :] = quaternion_of(out[:, self._angle_index]).reshape(n, -1)
        return out

    def _freeze(self) -> None:
        self._template = np.frombuffer(bytes(self._row), dtype=np.uint8).copy()
        self._index = np.array(self._sources.index, dtype=np.intp)
        self._sign = np.array(self._sources.sign)
        self._offset = np.array(self._sources.offset)
        eight = np.arange(8)
        self._number_bytes = (np.array(self._sources.at, dtype=np.intp)[:, None] + eight).ravel()
        starts = [slot.start + at for slot in self.slots for at in (_LOG_TIME_AT, _PUBLISH_TIME_AT)]
        self._time_bytes = np.array(starts, dtype=np.intp)[:, None] + eight
        self._stamp_bytes = np.array(self._stamps, dtype=np.intp)[:, None] + eight
        angle_index = np.array(self._angles, dtype=np.intp).reshape(-1, 3)
        self._angle_index = np.where(angle_index < 0, len(self.channels), angle_index)


def _within(at: int, places: Sequence[tuple[int, int]]) -> bool:
    return any(start <= at < end for start, end in places)


def _joint_names(fields: Mapping[str, object]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(p[p.index("[") + 1 : -1] for p in fields if p.endswith("]")))


def _indexed(path: str, joints: tuple[str, ...]) -> str:
    if not path.endswith("]"):
        return path
    array, joint = path[:-1].split("[")
    return f"{array}[{joints.index(joint)}]"


def _stamps(times_ns: NDArray[np.int64]) -> ByteArray:
    stamp = np.empty((len(times_ns), 2), dtype="<u4")
    stamp[:, 0] = times_ns // 1_000_000_000
    stamp[:, 1] = times_ns % 1_000_000_000
    return stamp.view(np.uint8)
