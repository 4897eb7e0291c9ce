"""A recording as messages in order of time, made when they are due. Knows nothing of ROS."""

from __future__ import annotations

from bisect import bisect_left
from collections import defaultdict
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.recordings.channels import Channel
from truck_blowout_sim.recordings.encoder import RowEncoder
from truck_blowout_sim.recordings.names import parts_of
from truck_blowout_sim.recordings.recording import Recording

FloatArray = NDArray[np.float64]
_NOWHERE = 1e-9
_ANY = (-np.inf, np.inf)
_PEDALS = {"1": (0.0, 1.0), "Pa": (0.0, np.inf)}


@dataclass(frozen=True)
class Track:
    """Channels whose messages are due at the same instants.

    Attributes:
        encoder: makes the messages.
        time_s: instants, shape (n,).
        values: shape (n, channels).
    """

    encoder: RowEncoder
    time_s: FloatArray
    values: FloatArray


@dataclass(frozen=True)
class Due:
    """What is due at one instant of the recording.

    Attributes:
        time_s: on the recording's clock.
        tires: blown at this instant.
        track, row: which messages; track -1: none.
    """

    time_s: float
    tires: tuple[str, ...]
    track: int
    row: int


class Playlist:
    """All messages of a recording; `position` is the next one."""

    def __init__(self, recording: Recording) -> None:
        self.recording = recording
        self.tracks = tuple(_tracks(recording))
        events = [(b.time_s, -1, i) for i, b in enumerate(recording.blowouts)]
        rows = [
            (float(t), k, i) for k, track in enumerate(self.tracks)
            for i, t in enumerate(track.time_s.tolist())
        ]  # fmt: skip
        self._entries = sorted(events + rows)
        self.position = 0

    @property
    def topics(self) -> Mapping[str, tuple[str, int]]:
        """Message type and number of messages by relative topic."""
        found: dict[str, tuple[str, int]] = {}
        for track in self.tracks:
            for slot in track.encoder.slots:
                before = found.get(slot.topic, ("", 0))[1]
                found[slot.topic] = (slot.ros_type, before + len(track.time_s))
        return found

    @property
    def next_s(self) -> float | None:
        """Instant of the next entry; None at the end."""
        return self._entries[self.position][0] if self.position < len(self._entries) else None

    def seek(self, time_s: float) -> None:
        """Continue with the first entry at or after an instant."""
        self.position = bisect_left(self._entries, (time_s - _NOWHERE, -1, -1))

    def due(self, until_s: float) -> Iterator[Due]:
        """Entries up to an instant; each is counted as played."""
        while self.position < len(self._entries):
            time_s, track, row = self._entries[self.position]
            if time_s > until_s + _NOWHERE:
                return
            self.position += 1
            tires = self.recording.blowouts[row].tires if track < 0 else ()
            yield Due(time_s, tires, track, row)

    def blown_before(self, time_s: float) -> Iterator[Due]:
        """Blowouts that lie behind an instant, in order of time."""
        for row, blowout in enumerate(self.recording.blowouts):
            if blowout.time_s < time_s - _NOWHERE:
                yield Due(blowout.time_s, blowout.tires, -1, row)

    def held(self, time_s: float) -> dict[str, bytes]:
        """Last message of each topic that has none at an instant, unstamped, by relative topic."""
        last: dict[str, tuple[float, bytes]] = {}
        for track in self.tracks:
            row = int(np.searchsorted(track.time_s, time_s + _NOWHERE, side="right")) - 1
            if row >= 0:
                at_s = float(track.time_s[row])
                for topic, data in track.encoder.messages(0, track.values[row]).items():
                    if topic not in last or at_s > last[topic][0]:
                        last[topic] = at_s, data
        return {topic: data for topic, (at_s, data) in last.items() if at_s < time_s - _NOWHERE}

    def messages(self, due: Due, stamp_ns: int) -> dict[str, bytes]:
        """Serialised messages of an entry by relative topic, stamped as told."""
        if due.track < 0:
            return {}
        track = self.tracks[due.track]
        return track.encoder.messages(stamp_ns, track.values[due.row])


def _tracks(recording: Recording) -> Iterator[Track]:
    table = parts_of(recording.channels).table()
    topics: dict[str, list[Channel]] = defaultdict(list)
    for channel in table:
        if (channel.place and channel.group != "tire_contact"
                and channel.name in recording):
            topics[channel.topic].append(channel)
    shared: dict[bytes, tuple[FloatArray, list[Channel]]] = {}
    for rows in topics.values():
        for instants, members in _patterns(recording, rows):
            shared.setdefault(instants.tobytes(), (instants, []))[1].extend(members)
    for instants, members in shared.values():
        columns = [_at(recording, channel, instants) for channel in members]
        yield Track(RowEncoder(members), instants, np.stack(columns, axis=1))


def _patterns(
    recording: Recording, rows: list[Channel]
) -> Iterator[tuple[FloatArray, list[Channel]]]:
    """Split a topic's instants by which of its channels have a sample there."""
    times = [recording[row.name].time_s for row in rows]
    instants = np.unique(np.concatenate(times))
    present = np.stack([np.isin(instants, one) for one in times], axis=1)
    for pattern in np.unique(present, axis=0):
        members = [row for row, there in zip(rows, pattern, strict=True) if there]
        yield instants[(present == pattern).all(axis=1)], members


def _at(recording: Recording, channel: Channel, instants: FloatArray) -> FloatArray:
    series = recording[channel.name]
    values = series.value[np.searchsorted(series.time_s, instants)]
    # the simulator refuses what a pedal cannot do, and a gauge at rest reads a little below zero
    return np.clip(values, *_PEDALS.get(channel.unit, _ANY)) if channel.group == "input" else values
