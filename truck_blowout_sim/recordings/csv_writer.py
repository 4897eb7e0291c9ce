"""Recording to CSV: every number exactly, channels of different rates merged on one time column."""

from __future__ import annotations

import io
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from truck_blowout_sim.recordings.atomic import replacing
from truck_blowout_sim.recordings.channels import DEFAULT_HUBS, DEFAULT_TIRES
from truck_blowout_sim.recordings.csv_header import HUB_NAMES_KEY, TIRE_NAMES_KEY
from truck_blowout_sim.recordings.names import parts_of
from truck_blowout_sim.recordings.recording import Recording

_NS = 1_000_000_000


def write_csv(recording: Recording, path: Path, *, plain: bool = False) -> None:
    """Write a recording; instants that agree to the nanosecond share a row.

    Args:
        plain: without the lines of metadata, so that the header is the first line.

    Raises:
        KeyError: a channel that is not in the table.
        StorageError: the file cannot be written; an older file of that name is then untouched.
    """
    with replacing(path) as temporary:
        temporary.write_text(csv_text(recording, plain=plain), encoding="utf-8")


def csv_text(recording: Recording, *, plain: bool = False) -> str:
    """The file's text; `plain`: from the header on."""
    out = io.StringIO()
    parts = parts_of(recording.channels)
    metadata = dict(recording.metadata)
    _declare(metadata, TIRE_NAMES_KEY, parts.tires, DEFAULT_TIRES)
    _declare(metadata, HUB_NAMES_KEY, parts.hubs, DEFAULT_HUBS)
    for key, value in () if plain else metadata.items():
        out.write(f"# {' '.join(key.split())}: {' '.join(value.split())}\n")
    table = [channel.name for channel in parts.table()]
    unknown = set(recording.channels) - set(table)
    if unknown:
        raise KeyError(f"not in the table of channels: {', '.join(sorted(unknown))}")
    inputs = [n for n in table[:5] if n in recording]
    others = [n for n in table[5:] if n in recording]
    events = ["blowout"] if recording.blowouts else []
    out.write(",".join(["time_s", *inputs, *events, *others]) + "\n")
    columns = _columns(recording, [*inputs, *events, *others])
    out.writelines(",".join(row) + "\n" for row in zip(*columns, strict=True))
    return out.getvalue()


def _declare(
    metadata: dict[str, str], key: str, names: tuple[str, ...], usual: tuple[str, ...]
) -> None:
    if set(names) - set(usual):
        metadata[key] = " ".join(names)


def _columns(recording: Recording, names: list[str]) -> Iterator[list[str]]:
    stamps = {n: np.rint(s.time_s * _NS).astype(np.int64) for n, s in recording.channels.items()}
    events = [round(blowout.time_s * _NS) for blowout in recording.blowouts]
    rows = np.unique(np.concatenate([*stamps.values(), np.array(events, dtype=np.int64)]))
    yield [repr(t / _NS) for t in rows.tolist()]
    for name in names:
        cells = [""] * len(rows)
        if name == "blowout":
            for i, blowout in zip(np.searchsorted(rows, events), recording.blowouts, strict=True):
                joined = (cells[i], *blowout.tires) if cells[i] else blowout.tires
                cells[i] = "+".join(joined)
        else:
            values = recording[name].value.tolist()
            for i, value in zip(np.searchsorted(rows, stamps[name]), values, strict=True):
                cells[i] = repr(value)
        yield cells
