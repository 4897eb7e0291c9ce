"""Head of a CSV recording: metadata lines and columns."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from truck_blowout_sim.errors import InputError, closest, quoted
from truck_blowout_sim.recordings.channels import (
    BLOWOUT_EVENT,
    DEFAULT_HUBS,
    DEFAULT_TIRES,
    Channel,
    by_name,
)
from truck_blowout_sim.recordings.names import Parts, parts_of

TIRE_NAMES_KEY = "tire_names"
HUB_NAMES_KEY = "hub_names"
_PREFIXES = ("hub_speed_", "tire_pressure_", "brake_chamber_", "brake_pressure_", "tractor_",
             "trailer_", "steering_", "throttle", "time")  # fmt: skip
_SIMILAR = 0.85


@dataclass(frozen=True)
class Header:
    """Head of a file.

    Attributes:
        line: number of the line with the columns, from 1.
        columns: names as they stand there.
        channels: rows of the table by column position; columns that are none are left out.
        metadata: from ``# key: value`` lines.
        parts: hubs, tires and units that the columns speak of.
        notes: columns that were ignored.
    """

    line: int
    columns: tuple[str, ...]
    channels: Mapping[int, Channel]
    metadata: Mapping[str, str]
    parts: Parts
    notes: tuple[str, ...]


def parse_header(
    path: Path, lines: Sequence[str], *, tires: Iterable[str], hubs: Iterable[str],
    strict: bool = True,
) -> Header:  # fmt: skip
    """Read the lines up to and with the column names.

    Raises:
        InputError: no header, a doubled or misspelt column, an undeclared tire or hub.
    """
    metadata, at = _metadata(path, lines)
    columns = tuple(cell.strip().strip('"') for cell in lines[at].split(","))
    _check_columns(path, at + 1, columns)
    declared_tires = (*tires, *metadata.get(TIRE_NAMES_KEY, "").split())
    declared_hubs = (*hubs, *metadata.get(HUB_NAMES_KEY, "").split())
    parts = parts_of(columns, declared_hubs, declared_tires)
    _check_names(path, at + 1, parts, declared_tires, declared_hubs)
    table = by_name(parts.table())
    channels = {i: table[name] for i, name in enumerate(columns) if name in table}
    unknown = [n for n in columns if n not in table and n not in ("time_s", BLOWOUT_EVENT.name)]
    for name in unknown if strict else ():
        _refuse_near_miss(path, at + 1, name, [*table, "time_s", BLOWOUT_EVENT.name])
    words = "is not a channel of this format: ignored"
    notes = tuple(f"column {quoted(n)} {words}" for n in unknown) if strict else ()
    return Header(at + 1, columns, channels, metadata, parts, notes)


def _metadata(path: Path, lines: Sequence[str]) -> tuple[dict[str, str], int]:
    metadata = {}
    for at, line in enumerate(lines):
        text = line.strip()
        if text.startswith("#"):
            key, colon, value = text[1:].partition(":")
            if colon and key.strip():
                metadata[key.strip()] = value.strip()
        elif text:
            _check_units(path, metadata)
            return metadata, at
    raise InputError(
        "is empty" if not any(lines) else "has no header line",
        file=path,
        where=f"line {max(1, len(lines))}",
        expected="a line of column names that begins with time_s",
    )


def _check_units(path: Path, metadata: Mapping[str, str]) -> None:
    units = metadata.get("units", "SI")
    if units.strip().lower().split(",")[0].split(" ")[0] not in ("si", ""):
        raise InputError(
            f"units {quoted(units)}",
            file=path,
            where="metadata line units",
            expected="SI (each column's unit is the end of its name)",
        )


def _check_columns(path: Path, line: int, columns: tuple[str, ...]) -> None:
    where = f"line {line}"
    if "time_s" not in columns:
        raise InputError(
            f"no column time_s among {quoted(','.join(columns))}",
            file=path,
            where=where,
            expected="comma separated column names, time_s among them; another logger's file wants"
            " a mapping (truck-blowout inspect FILE --write-map MAP)",
        )
    doubled = sorted({name for name in columns if columns.count(name) > 1})
    if doubled:
        raise InputError(
            f"column {quoted(doubled[0])} stands there {columns.count(doubled[0])} times",
            file=path,
            where=where,
            expected="each column once",
        )


def _check_names(
    path: Path, line: int, parts: Parts, tires: Sequence[str], hubs: Sequence[str]
) -> None:
    for kind, found, known, key in (
        ("tire", parts.tires, (*DEFAULT_TIRES, *tires), TIRE_NAMES_KEY),
        ("hub", parts.hubs, (*DEFAULT_HUBS, *hubs), HUB_NAMES_KEY),
    ):
        for name in found:
            if name not in known:
                near = closest(name, known)
                hint = f"{near}, or " if near else ""
                raise InputError(
                    f"unknown {kind} {quoted(name)}",
                    file=path,
                    where=f"line {line}",
                    expected=f"{hint}a {kind} of the vehicle; another vehicle's names are declared"
                    f" by a line '# {key}: {name} …'",
                )


def _refuse_near_miss(path: Path, line: int, name: str, table: Sequence[str]) -> None:
    near = difflib.get_close_matches(name, table, 1, _SIMILAR)
    if near or name.startswith(_PREFIXES):
        meant = [closest(name, table, 0.0)]
        raise InputError(
            f"column {quoted(name)}",
            file=path,
            where=f"line {line}",
            expected=f"{meant[0]} (SI units, the unit in the name)",
        )
