"""The one door to recordings: any log of any logger, with a mapping where it needs one.

Validated with: test/recordings/test_mapping.py, test/recordings/test_bring_your_own_log.py.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings.checks import EARLIEST_S, STAMPS_END_S
from truck_blowout_sim.recordings.formats import BEGIN_MAPPING, read_native
from truck_blowout_sim.recordings.mapping import Opened, Rules, combine, load_mapping, open_test
from truck_blowout_sim.recordings.mapping.consistency import contradictions
from truck_blowout_sim.recordings.mapping.finish import (
    at_base_link,
    with_blowouts,
    with_local_origin,
    without_excluded,
    without_planar_zeros,
)
from truck_blowout_sim.recordings.mapping.odd_sizes import odd_sizes
from truck_blowout_sim.recordings.recording import Blowout, Recording
from truck_blowout_sim.recordings.stray_time import stray_times
from truck_blowout_sim.recordings.topic_names import channels_on

_TABLES = (".csv", ".txt")


def read_recording(
    path: str | os.PathLike[str],
    *,
    mapping: Rules | str | os.PathLike[str] | None = None,
    blow: Iterable[Blowout] = (),
    also: Iterable[str | os.PathLike[str]] = (),
    tires: Iterable[str] = (),
    hubs: Iterable[str] = (),
    namespace: str | None = None,
    remap: Mapping[str, str] | None = None,
    source: str = "experiment",
) -> Recording:
    """Read a recording of any format.

    Args:
        path: rosbag2 folder (or its metadata.yaml), ``.mcap``, ``.db3``, ``.bag``, ``.csv``,
            ``.txt``, ``.vbo``, ``.mat``, or MDF.
        mapping: what in the log becomes which channel: a mapping file, or rules. A file whose
            columns or topics are named as in the table of channels needs none.
        blow: blowouts that the log itself does not mark.
        also: further files of the same test, besides those that the mapping names.
        tires: tire names of the vehicle, if it is not the default truck.
        hubs: hub names, likewise.
        namespace: prefix of the truck's topics in a bag; found by itself if not given.
        remap: foreign topic names of a bag to those of the table.
        source: which of the thesis's variables of a ``.mat``: ``experiment`` or ``hve``.

    Returns:
        SI units, pressures gauge, ISO axes; what had to be assumed stands in its notes.

    Raises:
        InputError: one line: file, place, value, expectation.
    """
    path = Path(path)
    blow, also = tuple(blow), tuple(also)
    if mapping is None and not also:
        read = read_native(path, tires=tires, hubs=hubs, namespace=namespace, remap=remap,
                           source=source)  # fmt: skip
        if not read.channels:
            raise InputError("holds no numbers", file=path, expected="samples of a channel")
        _check_stamps(read, path)
        foreign = channels_on((remap or {}).values(), read.channels)
        read = with_local_origin(without_planar_zeros(read, foreign))
        read = replace(read, notes=(*read.notes, *(stray_times(read) or _doubts(read, path))))
        return with_blowouts(read, blow, tires=tires, hubs=hubs) if blow else read
    rules = mapping if isinstance(mapping, Rules) else load_mapping(mapping) if mapping else Rules()
    files = open_test(path, rules, also=map(Path, also), namespace=namespace, source=source)
    read = combine(files, rules, tires=tires, hubs=hubs)
    if not read.channels:
        raise InputError("no column becomes a channel", file=path,
                         expected=f"a mapping with channels ({BEGIN_MAPPING})")  # fmt: skip
    _check_stamps(read, path)
    read = without_planar_zeros(without_excluded(read, rules), _foreign(files, rules, read))
    read = with_local_origin(at_base_link(read, rules.sensors))
    read = replace(read, notes=(*read.notes, *contradictions(read), *odd_sizes(read),
                                *stray_times(read)))
    stated = with_blowouts(read, rules.blowouts, tires=tires, hubs=hubs, file=rules.file or path)
    return with_blowouts(stated, blow, tires=tires, hubs=hubs)


def _check_stamps(read: Recording, path: Path) -> None:
    """Refuse a span that a bag's stamps, which begin at zero, cannot hold.

    Raises:
        InputError: its first and last instant.
    """
    start_s, end_s = read.start_s, read.end_s
    if not (start_s >= EARLIEST_S and end_s - min(0.0, start_s) < STAMPS_END_S):
        raise InputError(f"time from {start_s:.10g} s to {end_s:.10g} s", file=path,
                         expected=f"seconds, {EARLIEST_S:.0f} to {STAMPS_END_S:.0f}")  # fmt: skip


def _doubts(read: Recording, path: Path) -> tuple[str, ...]:
    """Notes on units of a table, which a person may have written; a bag's are those of its type."""
    if path.suffix.lower() not in _TABLES:
        return ()
    return (*contradictions(read), *odd_sizes(read))


def _foreign(files: Iterable[Opened], rules: Rules, read: Recording) -> set[str]:
    """Channels that came through the mapping, not under their own names."""
    own = {name for opened in files if opened.native for name in opened.native.channels}
    mapped = {*rules.channels, *channels_on(rules.topics, read.channels)}
    return (set(read.channels) - own) | mapped
