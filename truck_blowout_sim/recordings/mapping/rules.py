"""A mapping file as plain data: what in a log becomes which channel.

Validated with: test/recordings/test_mapping.py.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from truck_blowout_sim.recordings.recording import Blowout


@dataclass(frozen=True)
class Source:
    """Where a channel's numbers come from: value = sign * (number in SI) + offset.

    Attributes:
        column: of the log, or ``TOPIC:FIELD.PATH``.
        unit: as written; empty: as the log states it.
        sign: 1 or -1.
        offset: in the unit of the column, added before the conversion.
        file: of several files, the one it is in; empty: any.
        radius_m: of a wheel speed in km/h and the like, the radius that the logger multiplies by.
        key: where this stands in the mapping file, for an error.
    """

    column: str
    unit: str = ""
    sign: float = 1.0
    offset: float = 0.0
    file: str = ""
    key: str = ""
    radius_m: float = 0.0


@dataclass(frozen=True)
class TimeRule:
    """Which column is time, or which stamp of a bag; empty: the log's own."""

    column: str = ""
    unit: str = ""


@dataclass(frozen=True)
class Also:
    """A further file of the same test."""

    file: str
    time: TimeRule = TimeRule()
    shift_s: float = 0.0


@dataclass(frozen=True)
class Mount:
    """Where a unit's instrument sits, seen from its ``base_link``: forward, left, up."""

    x_m: float = 0.0
    y_m: float = 0.0
    z_m: float = 0.0


@dataclass(frozen=True)
class Rules:
    """All of a mapping file.

    Attributes:
        file: the mapping file, for errors; None for rules made in a program.
        channels: source by channel name.
        topics: a bag's topics that are a topic of the table as a whole, by the table's name.
        shift_s: added to the times of a column, topic or file.
        sensors: by unit, ``tractor`` or ``trailer``.
        metadata: kept in the recording.
    """

    file: Path | None = None
    time: TimeRule = TimeRule()
    channels: Mapping[str, Source] = field(default_factory=dict)
    topics: Mapping[str, str] = field(default_factory=dict)
    shift_s: Mapping[str, float] = field(default_factory=dict)
    also: tuple[Also, ...] = ()
    blowouts: tuple[Blowout, ...] = ()
    exclude: tuple[str, ...] = ()
    sensors: Mapping[str, Mount] = field(default_factory=dict)
    metadata: Mapping[str, str] = field(default_factory=dict)
