"""Many runs over the same compiled function, in parallel, into one table.

Compiled code lets go of the interpreter, so threads run side by side. In a study of many runs each
thread drives eight trucks abreast; what comes out is what each gives alone, to rounding.
"""

from __future__ import annotations

import json
import os
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass
from itertools import groupby
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.physics.octet import EIGHT
from truck_blowout_sim.recordings.atomic import replacing
from truck_blowout_sim.simulation.abreast import MANY
from truck_blowout_sim.simulation.studies.cases import Case, Row, Study
from truck_blowout_sim.simulation.studies.design import Value
from truck_blowout_sim.simulation.studies.tables import TIMES, schema_of, table_of, write_rows
from truck_blowout_sim.vehicle.given import AnyVehicle

Floats = NDArray[np.float64]
Progress = Callable[[float], None]
_MOST_IN_MEMORY_BYTES = 1_000_000_000
_AHEAD = 4  # runs a worker, or eights of runs, that may wait to be written


@dataclass(frozen=True, eq=False)
class Batch:
    """The table of a batch.

    Attributes:
        table: a pyarrow table: one row a run, in order.
        time_s: shared time base of the channels.
    """

    table: Any
    time_s: Floats

    def __len__(self) -> int:
        return int(self.table.num_rows)

    def column(self, name: str) -> list[Any]:
        """A column: what was varied, ``status``, ``reason``, or a measure; None where unknown."""
        values: list[Any] = self.table[name].to_pylist()
        return values

    def series(self, channel: str) -> Floats:
        """[n_runs, n_rows] of a channel; NaN after a run ended, and where it failed."""
        out = np.full((len(self), self.time_s.size), np.nan)
        for k, values in enumerate(self.table[channel]):
            if values.is_valid:
                out[k] = values.values.to_numpy(zero_copy_only=False)
        return out


def simulate_batch(vehicle: AnyVehicle, scenario: str | PathLike[str],
                   variants: Sequence[Mapping[str, Value]], *, channels: Sequence[str] = (),
                   rate_hz: float = 100.0, step_s: float = 0.001, workers: int | None = None,
                   output: str | PathLike[str] | None = None, insist: bool = False,
                   progress: Progress | None = None) -> Batch:
    """Run one scenario with many settings.

    Args:
        vehicle: a vehicle, one packed with parameters of its own, a path, or a shipped name.
        scenario: name of a shipped file, or a path.
        variants: for each run, values by key, every run with the same keys; see `studies.keys`:
            ``{"start.speed_mph": 55, "blowouts.failure.time_s": 3.0}``. They are set in the order
            of the first one.
        channels: outputs and inputs to keep; measures are always kept.
        rate_hz: rate of the channels, on one time base for all runs.
        workers: threads; one for each core if not given.
        output: Parquet file to stream to, for batches that outgrow memory.
        insist: also run what no truck does.
        progress: called with the share that is done.

    Returns:
        One row a run, in order; a run that failed is a row with its reason. What `simulate` gives,
        bit for bit; from 256 runs on to rounding, because then eight trucks are stepped at once.
        With ``output``, columns are read from the file.

    Raises:
        InputError: files, keys or channels that cannot be used, or more than memory should hold.
    """
    keys = tuple(variants[0]) if variants else ()
    if any(set(v) != set(keys) for v in variants):
        raise InputError("the variants have different keys", expected="the same keys in each")
    variants = [v if tuple(v) == keys else {key: v[key] for key in keys} for v in variants]
    study = Study(vehicle, scenario, keys, channels, step_s, rate_hz, insist)
    rows = reporting(run_all(study, list(enumerate(variants)), len(variants), workers),
                     len(variants), progress)
    schema = schema_of(variants, channels, study.times_s)
    if output is None:
        size = len(variants) * len(channels) * study.times_s.size * 8
        if size > _MOST_IN_MEMORY_BYTES:
            raise InputError(f"{size / 1e9:.1f} GB of channels",
                             expected="output=, a file to stream to")
        return Batch(table_of(list(rows), schema), study.times_s)
    with replacing(Path(output)) as temporary:
        write_rows(rows, temporary, schema)
    return open_batch(output)


def open_batch(path: str | PathLike[str]) -> Batch:
    """A table that `simulate_batch` or `sweep` has written, mapped into memory."""
    import pyarrow.parquet as pq

    table = pq.read_table(path, memory_map=True)
    times = json.loads(table.schema.metadata[TIMES])
    return Batch(table, np.array(times, dtype=np.float64))


def run_all(study: Study, cases: Iterable[Case], size: int, workers: int | None = None
            ) -> Iterator[Row]:
    """Rows of all cases, in order, worked on by threads; only a few are held at a time.

    Args:
        size: number of runs of the whole study. It decides whether trucks go abreast, and a run's
            number with which others, so that a study gone on with gives the same rows.
    """
    n, together = workers or os.cpu_count() or 1, EIGHT if size >= MANY else 1
    waiting: deque[Future[list[Row]]] = deque()
    with ThreadPoolExecutor(n) as pool:
        try:
            for _, part in groupby(cases, key=lambda case: case[0] // together):
                waiting.append(pool.submit(study.run_several, list(part)))
                if len(waiting) >= _AHEAD * n:
                    yield from waiting.popleft().result()
            while waiting:
                yield from waiting.popleft().result()
        finally:
            for future in waiting:
                future.cancel()


def reporting(rows: Iterable[Row], count: int, progress: Progress | None) -> Iterator[Row]:
    """The same rows, with the share that is done told as they pass."""
    for done, row in enumerate(rows, start=1):
        yield row
        if progress:
            progress(done / count)
