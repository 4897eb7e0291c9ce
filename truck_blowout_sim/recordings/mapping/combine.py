"""A log and a mapping become a recording.

    value = sign * (number + offset), converted from the column's unit to SI

Validated with: test/recordings/test_mapping.py.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.errors import InputError, nearest, quoted
from truck_blowout_sim.recordings.bag_reader import NOT_MEASURED_WORDS
from truck_blowout_sim.recordings.channels import DEFAULT_HUBS, DEFAULT_TIRES, Channel, by_name
from truck_blowout_sim.recordings.checks import check_values, leave_out, without_glitches
from truck_blowout_sim.recordings.logs.bag_log import BagLog
from truck_blowout_sim.recordings.logs.log import Column, no_column
from truck_blowout_sim.recordings.mapping.opened import Opened, other_unit
from truck_blowout_sim.recordings.mapping.plausible import beyond, hydraulic, lone, reads_like
from truck_blowout_sim.recordings.mapping.rules import Rules, Source
from truck_blowout_sim.recordings.mapping.stamps import times_on_one_clock
from truck_blowout_sim.recordings.mapping.stand_ins import StandInError, resolved, stand_ins
from truck_blowout_sim.recordings.names import Parts, parts_of
from truck_blowout_sim.recordings.recording import Recording, Series
from truck_blowout_sim.recordings.units import (
    SI_QUANTITIES,
    Unit,
    find_unit,
    not_known,
    unit_for,
)

FloatArray = NDArray[np.float64]
_MOST_UNUSED = 40


@dataclass
class Mapped:
    """Channels made so far, and what a person should know."""

    channels: dict[str, Series] = field(default_factory=dict)
    used: dict[str, set[str]] = field(default_factory=dict)
    not_measured: list[str] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)


def combine(
    files: list[Opened], rules: Rules, *, tires: Iterable[str] = (), hubs: Iterable[str] = ()
) -> Recording:
    """Channels of all files of one test, as the rules say; native ones by their own names.

    Args:
        files: the log itself first, then further files.
        rules: of the mapping file.
        tires: names of the vehicle, besides the default truck's.
        hubs: likewise.

    Raises:
        InputError: a channel or column that is not there, a unit that does not fit, a value that
            no truck has.
    """
    parts = _parts(files, rules, tires, hubs)
    table = by_name((*parts.table(), *stand_ins()))
    made = Mapped()
    for opened in files:
        _take_native(opened, made)
    for name, source in rules.channels.items():
        if name not in table:
            raise _error(rules, source.key, f"no channel {quoted(name)}",
                         nearest(name, table, "a channel of docs/recordings.md"))  # fmt: skip
        series = _mapped(files, rules, source, table[name], made)
        if series is not None:
            made.channels[name] = series
    if made.not_measured:
        made.notes.append(f"{NOT_MEASURED_WORDS}: {', '.join(made.not_measured)}")
    _check_shifts(files, rules, made)
    _tell_unused(files, made)
    channels, origin, notes = _resolved(made, rules)
    main = files[0]
    blowouts = tuple(b for opened in files if opened.native for b in opened.native.blowouts)
    metadata = {**main.metadata, **origin, **rules.metadata}
    return Recording(main.name, channels, blowouts, metadata,
                     (*(n for f in files for n in f.notes), *made.notes, *notes))  # fmt: skip


def _check_shifts(files: list[Opened], rules: Rules, made: Mapped) -> None:
    """Refuse a shift of what is neither a file nor a column or topic that became a channel."""
    names = [name for used in made.used.values() for name in sorted(used)]
    known = dict.fromkeys([*names, *(name.partition(":")[0] for name in names),
                           *(f.path.name for f in files), *(f.stated for f in files if f.stated)])
    for key in rules.shift_s:
        if key not in known:
            raise _error(rules, f"shift_s.{key}", "no file, and no column or topic that the"
                         " mapping takes", nearest(key, known))  # fmt: skip


def _resolved(
    made: Mapped, rules: Rules
) -> tuple[dict[str, Series], dict[str, str], tuple[str, ...]]:
    try:
        return resolved(made.channels)
    except StandInError as error:
        key = rules.channels[error.name].key if error.name in rules.channels else ""
        raise _error(rules, key, str(error), error.expected) from None


def _parts(files: list[Opened], rules: Rules, tires: Iterable[str], hubs: Iterable[str]) -> Parts:
    """Hubs and tires that the rules speak of; one that no vehicle here has is an error."""
    declared_tires = (*tires, *rules.metadata.get("tire_names", "").split())
    declared_hubs = (*hubs, *rules.metadata.get("hub_names", "").split())
    native = [name for opened in files if opened.native for name in opened.native.channels]
    ours = parts_of(rules.channels)
    known = parts_of(native, declared_hubs, declared_tires)
    for kind, found, usual in (("tire", ours.tires, (*DEFAULT_TIRES, *known.tires)),
                               ("hub", ours.hubs, (*DEFAULT_HUBS, *known.hubs))):  # fmt: skip
        for name in found:
            if name not in usual:
                raise _error(rules, "channels", f"unknown {kind} {quoted(name)}",
                             nearest(name, usual))  # fmt: skip
    return parts_of([*native, *rules.channels], declared_hubs, declared_tires)


def _take_native(opened: Opened, made: Mapped) -> None:
    for name, series in (opened.native.channels if opened.native else {}).items():
        if name in made.channels:
            made.notes.append(f"{name} is in several files: that of {opened.path.name} is left out")
        else:
            made.channels[name] = series


def _mapped(
    files: list[Opened], rules: Rules, source: Source, channel: Channel, made: Mapped
) -> Series | None:
    opened, name = _find(files, rules, source)
    made.used.setdefault(opened.path.name, set()).add(name)
    column = opened.log.column(name)
    if isinstance(opened.log, BagLog) and not column.values.size:
        made.not_measured.append(channel.name)
        return None
    where = f"{name}, for {channel.name}"
    if column.bad:
        raise InputError(f"column {quoted(name)}, {column.bad}", file=opened.path,
                         where=source.key, expected="a number, or nothing")  # fmt: skip
    unit = _unit(rules, source, column, channel, name)
    if note := other_unit(name, column.unit, unit if source.unit else None):
        made.notes.append(note)
    values = source.sign * ((column.values + source.offset) * unit.factor + unit.offset)
    times = times_on_one_clock(opened, rules, name, column, made.notes)
    there = np.isfinite(values) & np.isfinite(times)
    if not there.any():
        raise InputError("holds no number", file=opened.path, where=where, expected="samples")
    numbers, values, times = column.values[there], values[there], times[there]
    if channel.group != "input":
        odd = lone(channel, values)
        times, values = leave_out(odd, channel, times, values, made.notes)
        numbers = numbers[~odd]
    _check_size(opened.path, where, channel, (numbers, unit), values, times)
    if note := hydraulic(channel, values):
        made.notes.append(note)
    times, values = _in_order(opened.path, where, times, values, made)
    check_values(channel, values, file=opened.path, where=lambda i: f"{where}, at {times[i]:g} s")
    times, values = without_glitches(channel, times, values, made.notes)
    if channel.name.endswith("_yaw_rad"):
        values = np.asarray(np.unwrap(values), dtype=np.float64)
    return Series(times, values)


def _find(files: list[Opened], rules: Rules, source: Source) -> tuple[Opened, str]:
    """The one file and column that a rule means."""
    wanted = [f for f in files if source.file in ("", f.path.name, str(f.path), f.stated)]
    if not wanted:
        raise _error(rules, source.key, f"no file {quoted(source.file)}",
                     nearest(source.file, [f.path.name for f in files]))  # fmt: skip
    found = [(f, name) for f in wanted for name in [f.log.find(source.column)] if name]
    if not found:
        names = [name for f in wanted for name in f.log.names]
        problems = [no_column(f.log, source.column) for f in wanted]
        unread = [one for one in problems if not one.startswith("no column")]
        raise _error(rules, source.key, f"{(unread or problems)[0]} in the log",
                     "numbers" if unread else nearest(source.column, names))  # fmt: skip
    if len(found) > 1:
        raise _error(rules, source.key, f"column {quoted(source.column)} is in several files",
                     f"file: {found[0][0].path.name} beside it")  # fmt: skip
    return found[0]


def _unit(rules: Rules, source: Source, column: Column, channel: Channel, name: str) -> Unit:
    quantity = SI_QUANTITIES[channel.unit]
    text = source.unit or column.unit
    if not text:
        if quantity == "ratio":
            return unit_for("1", quantity, file="", where="")
        raise _error(rules, source.key, f"no unit is stated for column {quoted(name)}",
                     f"unit: {channel.unit} (or whatever the column is in)")  # fmt: skip
    if not source.unit and find_unit(text) is None:
        raise _error(rules, source.key, not_known(text, f"column {quoted(name)}"),
                     f"unit: … beside it, of {quantity}")  # fmt: skip
    if channel.group == "hub_speed" and (unit := find_unit(text)) and unit.quantity == "speed":
        return _of_a_wheel(rules, source, unit)
    if source.radius_m:
        raise _error(rules, f"{source.key}.radius_m", f"{channel.name} is in {text}",
                     "a radius only for wheel speeds in km/h and the like")  # fmt: skip
    return unit_for(text, quantity, file=rules.file or "mapping", where=f"key {source.key}")


def _of_a_wheel(rules: Rules, source: Source, unit: Unit) -> Unit:
    """Spin speed of a wheel whose logger multiplies it by a radius."""
    if not source.radius_m:
        raise _error(rules, source.key, f"a wheel speed in {unit.name}",
                     "radius_m: beside it, the wheel radius that the logger multiplies by")
    return Unit(unit.name, "angular rate", unit.factor / source.radius_m)


def _check_size(
    file: Path, where: str, channel: Channel, taken: tuple[FloatArray, Unit], values: FloatArray,
    times: FloatArray,
) -> None:
    at = beyond(channel, values)
    if at is None:
        return
    numbers, unit = taken
    problem = f"{numbers[at]:g} {unit.name} at {times[at]:g} s is beyond what a truck can do"
    if lone(channel, values).any():
        raise InputError(f"{problem}, unlike the other values", file=file, where=where,
                         expected="nothing in a cell where nothing was measured")  # fmt: skip
    like = reads_like(numbers, unit.quantity, channel.name, unit)
    raise InputError(
        problem + (f": reads like {like}" if like else ""), file=file, where=where,
        expected=f"unit: {like}" if like else f"{channel.quantity} of a truck",
    )  # fmt: skip


def _in_order(
    file: Path, where: str, times: FloatArray, values: FloatArray, made: Mapped
) -> tuple[FloatArray, FloatArray]:
    back = np.flatnonzero(times[1:] < times[:-1])
    if back.size:
        i = int(back[0])
        raise InputError(
            f"time {times[i + 1]:.6g} s after {times[i]:.6g} s", file=file, where=where,
            expected="times that do not run backwards (a reset begins another recording)",
        )  # fmt: skip
    last = np.append(times[1:] > times[:-1], True)
    if not last.all():
        made.notes.append(f"{where}: {np.count_nonzero(~last)} samples share their time with a"
                          " later one, which is taken")  # fmt: skip
    return times[last], values[last]


def _tell_unused(files: list[Opened], made: Mapped) -> None:
    for opened in files:
        used = made.used.get(opened.path.name, set())
        own = set() if opened.rows is None else {opened.rows.column}
        left = [n for n in opened.log.names if n not in used | own | opened.native_columns]
        if left:
            shown = ", ".join(left[:_MOST_UNUSED]) + (" …" if len(left) > _MOST_UNUSED else "")
            made.notes.append(f"{opened.path.name}: {len(left)} unused columns: {shown}")


def _error(rules: Rules, key: str, problem: str, expected: str) -> InputError:
    return InputError(problem, file=rules.file or "mapping", where=f"key {key}" if key else "",
                      expected=expected)  # fmt: skip
