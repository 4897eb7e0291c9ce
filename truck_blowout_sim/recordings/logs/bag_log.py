"""Bags of any stack: every number of every message, named ``TOPIC:FIELD.PATH``.

The types are those that the bag defines, else those of the ROS distribution that `rosbags` ships.
Angles of a quaternion are ``…orientation:yaw`` (or ``.yaw``), joints ``velocity[NAME]``.

Known limits: messages above 100 kB (images, point clouds) are named, not read.
Validated with: test/recordings/test_logs_bags.py.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from rosbags.typesys.store import Typestore

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings.bag_files import open_bag
from truck_blowout_sim.recordings.bag_topics import TopicSeries, read_topic
from truck_blowout_sim.recordings.cdr import Layout, MalformedMessageError, walk
from truck_blowout_sim.recordings.logs.log import Column, FloatArray, find_name
from truck_blowout_sim.recordings.mcap_scan import Topic

HEADER, RECEIVE = "header stamp", "receive stamp"
_NS = 1_000_000_000
_LARGEST_MESSAGE = 100_000
_LONGEST_ARRAY = 32
_LEFT_OUT = ("header.", "covariance")
_ANGLES = ("roll", "pitch", "yaw")
# unit by the end of a field's path in the standard messages (REP-103, sensor_msgs)
_STANDARD_PACKAGES = ("sensor_msgs/", "nav_msgs/", "geometry_msgs/")
_UNITS = (
    ("latitude", "deg"), ("longitude", "deg"), ("altitude", "m"),
    ("fluid_pressure", "Pa absolute"), ("angular_velocity.", "rad/s"), ("angular.", "rad/s"),
    ("linear_acceleration.", "m/s2"), ("accel.linear.", "m/s2"), ("linear.", "m/s"),
    ("position.", "m"), ("orientation:", "rad"), ("position[", "rad"), ("velocity[", "rad/s"),
)  # fmt: skip


@dataclass
class BagLog:
    """A bag whose topics are taken apart when they are asked for."""

    path: Path
    kind: str
    topics: dict[str, Topic]
    store: Typestore
    notes: list[str] = field(default_factory=list)
    metadata: dict[str, str] = field(default_factory=dict)
    _series: dict[str, TopicSeries] = field(default_factory=dict)
    _names: list[str] | None = None

    @property
    def names(self) -> Sequence[str]:
        """Every number of the first message of each topic."""
        if self._names is None:
            self._names = [
                f"{name}:{path}"
                for name, topic in self.topics.items()
                for path in self._paths(name, topic)
            ]
        return self._names

    def find(self, name: str) -> str | None:
        """The field itself; a leading slash and the dot before an angle are forgiven."""
        topic, mark, path = name.partition(":")
        known = find_name("/" + topic.strip().strip("/"), self.topics)
        if not mark or known is None:
            return None
        prefix, _, last = path.rpartition(".")
        wanted = f"{prefix}:{last}" if last in _ANGLES and prefix.endswith("orientation") else path
        full = f"{known}:{wanted}"
        return full if full in self.names else find_name(full, self.names)

    def column(self, name: str) -> Column:
        """A field of all messages of its topic, with both stamps.

        Raises:
            InputError: a message is not what its type says.
        """
        topic, _, path = name.partition(":")
        series = self._taken_apart(topic)
        index, values = series.column(path)
        times: dict[str, FloatArray] = {}
        if series.header_ns is not None:
            times[HEADER] = series.header_ns[index] / _NS
        times[RECEIVE] = series.log_ns[index] / _NS
        return Column(values, _unit(series.ros_type, path), times)

    def texts(self, topic: str) -> list[tuple[float, str]]:
        """Receive stamps and texts of a topic of std_msgs/String."""
        series = self._taken_apart(topic)
        return [(series.log_ns[i] / _NS, text) for i, text in sorted(series.texts("data"))]

    def _taken_apart(self, topic: str) -> TopicSeries:
        if topic not in self._series:
            self._series[topic] = read_topic(self.topics[topic], self.path, self.store)
        return self._series[topic]

    def _paths(self, name: str, topic: Topic) -> Iterator[str]:
        words = f"topic {name} ({topic.ros_type}): "
        if topic.ros_type not in self.store.fielddefs:
            self.notes.append(words + "its type is not defined in the bag: not read")
        elif len(topic.data[0]) > _LARGEST_MESSAGE:
            self.notes.append(words + f"messages of {len(topic.data[0])} bytes: not read")
        else:
            try:
                yield from _numbers(walk(topic.data[0], topic.ros_type, self.store))
            except MalformedMessageError as error:
                self.notes.append(f"{words}{error}: not read")


def open_bag_log(path: Path) -> BagLog:
    """Open a bag of any storage.

    Raises:
        InputError: no bag, damaged, or with a message definition that is none.
    """
    bag = open_bag(path)
    try:
        store = bag.store()
    except ValueError as error:
        raise InputError(str(error), file=path, expected="a message definition") from None
    topics = {name: topic for name, topic in bag.topics.items() if topic.data}
    return BagLog(path, f"bag ({bag.kind})", topics, store, list(bag.notes), dict(bag.metadata))


def _numbers(layout: Layout) -> Iterator[str]:
    for path in layout.numbers:
        array, _, entry = path.partition("[")
        stamp = path.endswith((".sec", ".nanosec")) and "stamp" in path
        if stamp or any(word in path for word in _LEFT_OUT):
            continue
        if layout.lengths.get(array, 0) > _LONGEST_ARRAY:
            continue
        joint = layout.texts.get(f"name[{entry}") if array in ("position", "velocity") else None
        yield f"{array}[{joint}]" if joint else path
        if path.endswith("orientation.w"):
            yield from (f"{path[:-2]}:{angle}" for angle in _ANGLES)


def _unit(ros_type: str, path: str) -> str:
    """The unit that the standard messages define; empty for all others."""
    if not ros_type.startswith(_STANDARD_PACKAGES):
        return ""
    return next((unit for part, unit in _UNITS if part in path), "")


def lateness_s(column: Column) -> tuple[float, float] | None:
    """Median and spread of reception after the header stamp, s; None without a header."""
    if HEADER not in column.times or not len(column.values):
        return None
    late = column.times[RECEIVE] - column.times[HEADER]
    return float(np.median(late)), float(np.percentile(late, 95) - np.percentile(late, 5))
