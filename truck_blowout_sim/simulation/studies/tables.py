"""Runs as rows of a Parquet table: what was varied, how it ended, measures, channels.

A channel is a column of lists, one value for each instant of the shared time base, which stands in
the table's metadata. Files are written in groups of rows, so that memory stays flat.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.simulation.measures import Measures
from truck_blowout_sim.simulation.studies.cases import Row
from truck_blowout_sim.simulation.studies.design import Value

Floats = NDArray[np.float64]
TIMES = b"time_s"
MEASURES = tuple(f.name for f in fields(Measures))
_GROUP_BYTES = 16_000_000


def schema_of(values: Sequence[Mapping[str, Value]], channels: Sequence[str], times_s: Floats
              ) -> Any:  # noqa: ANN401 -- pyarrow ships no types
    """The table's columns.

    Args:
        values: of all runs: a key is a column of numbers where every value is one.

    Raises:
        InputError: pyarrow is not installed, as no ROS distribution has it.
    """
    try:
        import pyarrow as pa
    except ImportError:
        raise InputError("a study is written with pyarrow, which is not installed",
                         expected="pip install pyarrow") from None  # fmt: skip

    columns = [pa.field("run", pa.int64())]
    for key in (values[0] if values else {}):
        words = any(isinstance(row[key], str) for row in values)
        columns.append(pa.field(key, pa.string() if words else pa.float64()))
    columns += [pa.field("status", pa.string()), pa.field("reason", pa.string())]
    kinds = {"bool": pa.bool_(), "str | None": pa.string()}
    columns += [pa.field(f.name, kinds.get(str(f.type), pa.float64())) for f in fields(Measures)]
    columns += [pa.field(channel, pa.list_(pa.float64())) for channel in channels]
    return pa.schema(columns, metadata={TIMES: json.dumps(times_s.tolist()).encode()})


def table_of(rows: Sequence[Row], schema: Any) -> Any:  # noqa: ANN401
    """Rows as a table."""
    import pyarrow as pa

    keys = tuple(rows[0].values) if rows else ()
    columns: dict[str, Any] = {"run": [row.number for row in rows]}
    for key in keys:
        text = schema.field(key).type == pa.string()
        columns[key] = [_text(row.values[key]) if text else row.values[key] for row in rows]
    columns["status"] = [row.status for row in rows]
    columns["reason"] = [row.reason or None for row in rows]
    for name in MEASURES:
        columns[name] = [getattr(row.measures, name) if row.measures else None for row in rows]
    k = len(columns)
    for column, channel in enumerate(schema.names[k:]):
        columns[channel] = _lists([row.series[:, column] for row in rows],
                                  [row.measures is not None for row in rows])
    return pa.table(columns, schema=schema)


def write_rows(rows: Iterable[Row], path: Path, schema: Any) -> int:  # noqa: ANN401
    """Write rows as they come, a group at a time; returns how many there were."""
    import pyarrow.parquet as pq

    count, held, size = 0, [], 0
    with pq.ParquetWriter(path, schema, compression="zstd") as writer:
        for row in rows:
            held.append(row)
            count, size = count + 1, size + row.series.nbytes + 512
            if size > _GROUP_BYTES:
                writer.write_table(table_of(held, schema))
                held, size = [], 0
        if held:
            writer.write_table(table_of(held, schema))
    return count


def _lists(series: Sequence[Floats], there: Sequence[bool]) -> Any:  # noqa: ANN401
    """A column of lists, null where a run failed."""
    import pyarrow as pa

    lengths = [len(s) if ok else 0 for s, ok in zip(series, there, strict=True)]
    offsets = np.concatenate([[0], np.cumsum(lengths)]).astype(np.int32)
    flat = [s for s, ok in zip(series, there, strict=True) if ok]
    values = pa.array(np.concatenate(flat) if flat else np.zeros(0))
    mask = pa.array([not ok for ok in there])
    return pa.ListArray.from_arrays(pa.array(offsets), values, mask=mask)


def _text(value: Value) -> str:
    return value if isinstance(value, str) else f"{value:g}"
