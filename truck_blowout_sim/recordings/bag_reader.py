"""Bags to recordings: rosbag2 folders and bare MCAP files, finished or not, ours or foreign.

References: rosbag2 (MCAP storage); REP-103/105; sensor_msgs conventions for missing values.
Known limits: one message type per topic, as in the table of channels.
Validated with: test/recordings/test_bag_format.py against CSVs of the same runs.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.errors import InputError, quoted
from truck_blowout_sim.recordings import clock as clocks
from truck_blowout_sim.recordings.bag_events import read_blowouts
from truck_blowout_sim.recordings.bag_files import BagFiles, open_bag
from truck_blowout_sim.recordings.bag_topics import TopicSeries, read_topic
from truck_blowout_sim.recordings.bag_writer import ORIGIN_KEY
from truck_blowout_sim.recordings.channel import IMU, ODOMETRY
from truck_blowout_sim.recordings.channels import BLOWOUT_EVENT, Channel, Place
from truck_blowout_sim.recordings.checks import EARLIEST_S, check_values, without_glitches
from truck_blowout_sim.recordings.names import Parts, parts_of
from truck_blowout_sim.recordings.recording import Blowout, Recording, Series
from truck_blowout_sim.recordings.resets import reset_times_s
from truck_blowout_sim.recordings.topic_names import (
    channel_names,
    joint_channel_names,
    relative_names,
    type_of,
)

_NS = 1_000_000_000
NOT_MEASURED_WORDS = "not measured, as the log itself says"


def read_bag(
    path: Path,
    *,
    tires: Iterable[str] = (),
    hubs: Iterable[str] = (),
    namespace: str | None = None,
    remap: Mapping[str, str] | None = None,
) -> Recording:
    """Read a rosbag2 folder or an ``.mcap`` file.

    Args:
        path: folder or file.
        tires: names the vehicle has besides those found in the bag.
        hubs: likewise.
        namespace: prefix of the truck's topics; found by itself if not given.
        remap: foreign topic names to those of the table, e.g.
            ``{"/ins/odometry": "tractor/odometry"}``.

    Raises:
        InputError: not a bag, damaged, or nothing of the table in it.
        FileNotFoundError: no such path.
    """
    bag = open_bag(path)
    try:
        names = relative_names(bag.topics, namespace, remap or {})
    except InputError as error:
        raise InputError(error.problem, file=path, expected=error.expected) from None
    if not names:
        seen = ", ".join(list(bag.topics)[:5]) or "no messages"
        raise InputError(
            f"none of the truck's topics in it (found {seen})",
            file=path,
            expected="topics as /truck/tractor/odometry, or a remapping of foreign ones",
        )
    foreign = frozenset("/" + theirs.strip("/") for theirs in remap or {})
    decoded = {r: _decode(path, bag, r, t) for r, t in names.items()}
    reader = _Reader(path, bag, decoded, foreign)
    return reader.recording(tires, hubs)


def _decode(path: Path, bag: BagFiles, relative: str, absolute: str) -> TopicSeries:
    topic = bag.topics[absolute]
    wanted = type_of(relative)
    if topic.ros_type != wanted or topic.encoding != "cdr":
        raise InputError(
            f"type {quoted(topic.ros_type)} in encoding {quoted(topic.encoding)}",
            file=path,
            where=f"topic {absolute}",
            expected=f"{wanted or 'a topic of the table'} in cdr",
        )
    return read_topic(topic, path)


@dataclass
class _Reader:
    path: Path
    bag: BagFiles
    series: dict[str, TopicSeries]
    foreign: frozenset[str] = frozenset()
    notes: list[str] = field(default_factory=list)

    def recording(self, tires: Iterable[str], hubs: Iterable[str]) -> Recording:
        clock = clocks.find_clock([*self.series.values(), *self._clock_topic()])
        if clock.translates:
            self.notes.append("log times are on another clock than the stamps: translated")
        late = clocks.lateness_note(self.series.values())
        if late:
            self.notes.append(late)
        stamps = {name: clock.stamps(series) for name, series in self.series.items()}
        stated = self._stated_origin()
        first = [int(times[0]) for times in stamps.values() if len(times)]
        origin_ns = clocks.origin_ns(stated, first)
        self._times = {name: times + origin_ns for name, times in stamps.items()}
        parts = self._parts(tires, hubs)
        metadata = {k: v for k, v in self.bag.metadata.items() if k != ORIGIN_KEY}
        if stated is None and origin_ns:
            metadata["clock_start_s"] = repr(-origin_ns / _NS)
        channels = self._channels(parts)
        blowouts = self._blowouts(parts, reset_times_s(channels))
        notes = (*self.bag.notes, *self.notes)
        return Recording(self.bag.name, channels, blowouts, metadata, notes)

    def _blowouts(self, parts: Parts, resets_s: Sequence[float]) -> tuple[Blowout, ...]:
        topic = BLOWOUT_EVENT.topic
        if topic not in self.series:
            return ()
        blowouts, notes = read_blowouts(self.series[topic], self._times[topic] / _NS, parts,
                                        resets_s)  # fmt: skip
        self.notes += notes
        return blowouts

    def _clock_topic(self) -> list[TopicSeries]:
        topic = self.bag.topics.get(clocks.CLOCK_TOPIC)
        if topic is None or topic.ros_type != clocks.CLOCK_TYPE:
            return []
        return [read_topic(topic, self.path)]

    def _stated_origin(self) -> float | None:
        text = self.bag.metadata.get(ORIGIN_KEY)
        if text is None:
            return None
        try:
            value = float(text)
        except ValueError:
            value = np.nan
        if not EARLIEST_S <= value <= -EARLIEST_S:
            raise InputError(
                f"value {quoted(text)}",
                file=self.path,
                where=f"metadata {ORIGIN_KEY}",
                expected="a time in seconds",
            )
        return float(value)

    def _parts(self, tires: Iterable[str], hubs: Iterable[str]) -> Parts:
        names = channel_names(self.series)
        if "joint_states" in self.series:
            names += joint_channel_names(self.series["joint_states"].joints())
        return parts_of(names, hubs, tires)

    def _channels(self, parts: Parts) -> dict[str, Series]:
        channels = {}
        for channel in parts.table():
            for place in channel.places:
                series = self._series_at(channel, place)
                if series is not None:
                    channels[channel.name] = series
                    break
        self._tell_not_measured(parts, channels)
        return channels

    def _tell_not_measured(self, parts: Parts, channels: Mapping[str, Series]) -> None:
        """Name the fields of a foreign topic whose variances say that they mean nothing."""
        left = []
        for channel in parts.table():
            topic = self.series.get(channel.topic)
            if channel.name in channels or topic is None or topic.name not in self.foreign:
                continue
            stated = topic.ros_type in (ODOMETRY, IMU) and bool(topic.blocks)
            if stated and not topic.column(channel.field)[1].size:
                left.append(channel.name)
        if left:
            self.notes.append(f"{NOT_MEASURED_WORDS}: {', '.join(left)}")

    def _series_at(self, channel: Channel, place: Place) -> Series | None:
        topic = self.series.get(place.topic)
        if topic is None or not topic.blocks:
            return None
        index, numbers = topic.column(place.field)
        values = (numbers - place.offset) / place.sign
        if not values.size or _left_at_default(channel, numbers):
            return None
        check_values(channel, values, file=self.path, where=lambda i: topic.where(int(index[i])))
        times_ns = self._times[place.topic][index]
        self._check_order(topic, index, times_ns)
        last = np.append(times_ns[1:] > times_ns[:-1], True)
        if not last.all():
            self.notes.append(
                f"{channel.name}: {np.count_nonzero(~last)} samples share a stamp with a later"
                " one, which is taken"
            )
        if place.field.endswith(":yaw"):
            values = np.asarray(np.unwrap(values), dtype=np.float64)
        return Series(*without_glitches(channel, times_ns[last] / _NS, values[last], self.notes))

    def _check_order(self, topic: TopicSeries, index: NDArray[np.int64],
                     times_ns: NDArray[np.int64]) -> None:
        back = np.flatnonzero(times_ns[1:] < times_ns[:-1])
        if back.size:
            i = int(back[0]) + 1
            raise InputError(
                f"stamp {times_ns[i] / _NS} s after {times_ns[i - 1] / _NS} s",
                file=self.path,
                where=topic.where(int(index[i])),
                expected="stamps that do not run backwards",
            )


def _left_at_default(channel: Channel, numbers: NDArray[np.float64]) -> bool:
    # a recorder that fills a spin angle or a height with plain zeros did not measure it
    return not channel.standard and not numbers.any()
