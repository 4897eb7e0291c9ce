"""One clock for a bag: header stamps, log times, `/clock`, and the recording's origin.

A recorder that runs on wall time logs commands (which have no stamp of their own) on another
clock than the simulation stamps in odometry. Where the two differ, log times are translated by
`/clock`, or by the stamped messages themselves.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from truck_blowout_sim.recordings.bag_topics import TimeArray, TopicSeries

_NS = 1_000_000_000
_SAME_CLOCK_NS = _NS // 2
_TOLD_S = 0.002
_EPOCH_NS = 100_000_000 * _NS
CLOCK_TOPIC = "/clock"
CLOCK_TYPE = "rosgraph_msgs/msg/Clock"


@dataclass(frozen=True)
class Clock:
    """From log times to stamps; the identity if there are no pairs."""

    log_ns: TimeArray
    stamp_ns: TimeArray

    @property
    def translates(self) -> bool:
        """Whether log times are on a clock of their own."""
        return self.log_ns.size > 0

    def stamps(self, series: TopicSeries) -> TimeArray:
        """Instants of a topic's messages on the bag's clock, before its origin is taken off."""
        if series.header_ns is not None:
            return series.header_ns
        if not self.translates:
            return series.log_ns
        first_log, first_stamp = self.log_ns[0], self.stamp_ns[0]
        moved = np.interp(
            (series.log_ns - first_log).astype(np.float64),
            (self.log_ns - first_log).astype(np.float64),
            (self.stamp_ns - first_stamp).astype(np.float64),
        )
        return np.asarray(first_stamp + np.rint(moved).astype(np.int64))


def find_clock(series: Iterable[TopicSeries]) -> Clock:
    """Compare log times with stamps; translate only if they are half a second apart or more."""
    stamped = [s for s in series if s.header_ns is not None and len(s.log_ns)]
    stamped.sort(key=lambda s: (s.name != CLOCK_TOPIC, -len(s.log_ns)))
    nothing = np.zeros(0, dtype=np.int64)
    if not stamped or stamped[0].header_ns is None:
        return Clock(nothing, nothing)
    best, header_ns = stamped[0], stamped[0].header_ns
    if abs(int(np.median(best.log_ns - header_ns))) < _SAME_CLOCK_NS:
        return Clock(nothing, nothing)
    return Clock(best.log_ns, np.maximum.accumulate(header_ns))


def lateness_note(series: Iterable[TopicSeries]) -> str:
    """Words on how late stamped messages were logged, empty if within two milliseconds.

    Messages without a stamp stay on their log times, which are late by as much.
    """
    late = [np.median(s.log_ns - s.header_ns) / _NS for s in series
            if s.header_ns is not None and len(s.log_ns)]  # fmt: skip
    middle = float(np.median(late)) if late else 0.0
    if not _TOLD_S < abs(middle) < _SAME_CLOCK_NS / _NS:
        return ""
    return (f"stamped messages were logged {middle:.3f} s after their stamps (median): the stamps"
            " are taken; topics without a stamp keep their log times, probably late by as much")


def origin_ns(stated_s: float | None, first_stamps_ns: Sequence[int]) -> int:
    """What to add to stamps to get the recording's own time.

    Args:
        stated_s: time of stamp 0, from the bag's metadata.
        first_stamps_ns: earliest stamp of each topic. If all lie far from zero they count from
            the Unix epoch, and the recording begins at 0.
    """
    if stated_s is not None:
        return round(stated_s * _NS)
    earliest = min(first_stamps_ns, default=0)
    return -earliest if earliest > _EPOCH_NS else 0
