"""Recordings as MATLAB files (version 7): every channel a column vector under its own name.

    time_s                   instants, s
    tractor_vx_mps           one vector a channel, in the unit its name ends in
    tire_..._pa_time_s       instants of a channel that was not sampled at time_s
    units                    structure: the unit of each channel
    blowout_time_s, blowout_tires, metadata

References: MathWorks, MAT-File Format (level 5).
Known limits: a name has 63 characters at most, as MATLAB has it.
Validated with: test/recordings/test_mat_format.py (scipy reads it; there and back).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from truck_blowout_sim.errors import InputError, quoted
from truck_blowout_sim.recordings.atomic import replacing
from truck_blowout_sim.recordings.channels import Channel, by_name
from truck_blowout_sim.recordings.checks import check_times, check_values, without_glitches
from truck_blowout_sim.recordings.mat_file import Variable, read_variables
from truck_blowout_sim.recordings.mat_thesis import has_thesis_variables, read_thesis_mat
from truck_blowout_sim.recordings.names import Parts, parts_of
from truck_blowout_sim.recordings.recording import Blowout, Recording, Series

TIME, OWN_TIME = "time_s", "_time_s"
BLOWOUT_TIME, BLOWOUT_TIRES = "blowout_time_s", "blowout_tires"
_METADATA = "metadata"
_LONGEST_NAME = 63


def read_mat(
    path: Path,
    *,
    source: str = "experiment",
    tires: Iterable[str] = (),
    hubs: Iterable[str] = (),
    held: dict[str, Variable] | None = None,
) -> Recording:
    """Read a file that :func:`write_mat` wrote, or one with the thesis's variables.

    Args:
        path: the file.
        source: of the thesis's variables: ``experiment`` or ``hve``.
        tires: names of the vehicle, besides the default truck's.
        hubs: likewise.
        held: the file's variables, where they are read already.

    Raises:
        InputError: neither of these, damaged, or with values that cannot be.
    """
    held = read_variables(path) if held is None else held
    thesis = has_thesis_variables(held)
    if TIME not in held and thesis:
        return read_thesis_mat(path, source=source, held=held)
    parts = parts_of(held, hubs, tires)
    notes: list[str] = []
    channels = {
        channel.name: _series(path, held, channel, notes)
        for channel in parts.table()
        if channel.name in held and TIME in held
    }
    if not channels and thesis:
        return read_thesis_mat(path, source=source, held=held)
    if not channels:
        raise InputError(
            f"no channel among its variables ({', '.join(list(held)[:5])} …)",
            file=path, expected="variables named as the CSV columns, or a mapping: --map FILE"
            " (truck-blowout inspect LOG --write-map FILE begins one)",
        )  # fmt: skip
    name = _METADATA
    metadata = {part.name: part.text for part in held[name].inside} if name in held else {}
    return Recording(path.stem, channels, _blowouts(path, held, parts), metadata, tuple(notes))


def write_mat(recording: Recording, path: Path) -> None:
    """Write every channel with its unit, the events and the metadata.

    Raises:
        KeyError: a channel that is not in the table.
        StorageError: it cannot be written; an older file of that name is then untouched.
    """
    from scipy.io import savemat  # slow to load, and few need it

    variables = _variables(recording)
    # opened here: scipy hides why a file cannot be
    with replacing(path) as temporary, temporary.open("wb") as file:
        savemat(file, variables, do_compression=True, oned_as="column", long_field_names=True)


def _variables(recording: Recording) -> dict[str, Any]:
    table = by_name(parts_of(recording.channels).table())
    unknown = set(recording.channels) - set(table)
    if unknown:
        raise KeyError(f"not in the table of channels: {', '.join(sorted(unknown))}")
    bases = Counter(series.time_s.tobytes() for series in recording.channels.values())
    common = bases.most_common(1)[0][0] if bases else b""
    variables: dict[str, Any] = {TIME: np.frombuffer(common, dtype=np.float64)}
    for name, series in recording.channels.items():
        variables[name] = series.value
        if series.time_s.tobytes() != common:
            variables[name + OWN_TIME] = series.time_s
    variables["units"] = {name: table[name].unit for name in recording.channels}
    if recording.blowouts:
        variables[BLOWOUT_TIME] = np.array([b.time_s for b in recording.blowouts])
        tires = ["+".join(b.tires) for b in recording.blowouts]
        variables[BLOWOUT_TIRES] = np.array(tires, dtype=object)
    metadata = {_field_name(key): text for key, text in recording.metadata.items() if text}
    if metadata:
        variables[_METADATA] = metadata
    return variables


def _field_name(key: str) -> str:
    """The key as a MATLAB identifier."""
    name = "".join(c if c.isascii() and c.isalnum() else "_" for c in key).strip("_")
    return (name if name[:1].isalpha() else f"key_{name}")[:_LONGEST_NAME]


def _series(
    path: Path, held: Mapping[str, Variable], channel: Channel, notes: list[str]
) -> Series:
    own = channel.name + OWN_TIME
    time_name = own if own in held else TIME
    time_s, values = (_vector(path, held[name]) for name in (time_name, channel.name))
    if time_s.size != values.size:
        raise InputError(
            f"{values.size} samples", file=path, where=f"variable {channel.name}",
            expected=f"{time_s.size}, as {time_name} has",
        )  # fmt: skip
    there = ~np.isnan(values)  # a MATLAB user's own way to say "not measured"
    time_s, values = time_s[there], values[there]
    if not np.isfinite(time_s).all():
        raise InputError("is not finite", file=path, where=f"variable {time_name}",
                         expected="times in seconds")  # fmt: skip
    check_times(time_s, file=path, where=partial(_where, time_name))
    check_values(channel, values, file=path, where=partial(_where, channel.name))
    return Series(*without_glitches(channel, time_s, values, notes))


def _vector(path: Path, variable: Variable) -> np.ndarray[Any, np.dtype[np.float64]]:
    values = variable.values
    if values is None or values.size != max(values.shape, default=0):
        raise InputError(
            f"is {variable.kind}", file=path, where=f"variable {variable.name}",
            expected="a vector of real numbers",
        )  # fmt: skip
    return values.ravel()


def _blowouts(path: Path, held: Mapping[str, Variable], parts: Parts) -> tuple[Blowout, ...]:
    if BLOWOUT_TIME not in held or BLOWOUT_TIRES not in held:
        return ()
    times = _vector(path, held[BLOWOUT_TIME])
    named = held[BLOWOUT_TIRES]
    texts = [part.text for part in named.inside] or [named.text]
    if times.size != len(texts) or not np.isfinite(times).all():
        raise InputError(
            f"{times.size} times and {len(texts)} names", file=path,
            where=f"variable {BLOWOUT_TIRES}", expected="a finite time and a tire for each blowout",
        )  # fmt: skip
    for tire in "+".join(texts).split("+"):
        if not parts.knows_tire(tire):
            raise InputError(f"unknown tire {quoted(tire)}", file=path,
                             where=f"variable {BLOWOUT_TIRES}", expected="a tire of the vehicle")
    pairs = zip(times.tolist(), texts, strict=True)
    return tuple(Blowout(time_s, tuple(text.split("+"))) for time_s, text in pairs)


def _where(name: str, i: int) -> str:
    return f"variable {name}, sample {i + 1}"
