"""A study in a folder: worked on in parts, so that what is done survives an interruption.

`sweep.json` says what is run, `parts/` holds the rows done so far, `runs.parquet` is the result.
"""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.physics.octet import EIGHT
from truck_blowout_sim.recordings.atomic import replacing
from truck_blowout_sim.resources import code_hash
from truck_blowout_sim.simulation.studies.batch import Batch, open_batch, run_all
from truck_blowout_sim.simulation.studies.cases import Case, Row, Study
from truck_blowout_sim.simulation.studies.contents import contents_hash
from truck_blowout_sim.simulation.studies.design import Axis, Value, grid, parse_axis, sample
from truck_blowout_sim.simulation.studies.tables import schema_of, write_rows

PLAN, PARTS, TABLE = "sweep.json", "parts", "runs.parquet"
_PART_RUNS = 6 * EIGHT
_CONNECT_S = 10.0
Progress = Callable[[int, int], None]


@dataclass(frozen=True)
class Plan:
    """What a sweep runs.

    Attributes:
        scenario, vehicle: names of shipped files, or paths.
        vary: words ``KEY=a,b,c`` or ``KEY=lo:hi:n``.
        random: number of runs of a random sample; 0: every combination.
        seed: of the sample.
        channels, step_s, rate_hz, insist: see `Study`.
    """

    scenario: str
    vehicle: str
    vary: tuple[str, ...]
    random: int = 0
    seed: int = 1
    channels: tuple[str, ...] = ()
    step_s: float = 0.001
    rate_hz: float = 100.0
    insist: bool = False

    @property
    def axes(self) -> list[Axis]:
        """What varies."""
        return [parse_axis(word) for word in self.vary]

    def cases(self) -> list[dict[str, Value]]:
        """The values of every run, in order.

        Raises:
            InputError: see `grid` and `sample`.
        """
        return sample(self.axes, self.random, self.seed) if self.random else grid(self.axes)

    def study(self) -> Study:
        """What one run is made with.

        Raises:
            InputError: see `Study`.
        """
        return Study(self.vehicle, self.scenario, [axis.key for axis in self.axes], self.channels,
                     self.step_s, self.rate_hz, self.insist)


def run_sweep(plan: Plan, folder: Path, *, force: bool = False, workers: int | None = None,
              scheduler: str = "", progress: Progress | None = None) -> Batch:
    """Run a sweep, or go on with one that was interrupted.

    Args:
        force: begin anew where the folder holds another sweep, or a finished one.
        workers: threads on this machine; one for each core if not given.
        scheduler: address of a Dask scheduler, whose workers then do the runs.
        progress: called with the number of runs done and of all.

    Raises:
        InputError: keys or files that cannot be used, a folder that holds something else, or no
            scheduler at the address.
    """
    cases, study = plan.cases(), plan.study()
    files = contents_hash(study, plan.axes)
    if _begin(plan, files, folder, force):
        return open_batch(folder / TABLE)
    schema = schema_of(cases, plan.channels, study.times_s)
    numbered: list[Case] = list(enumerate(cases))
    chunks = [numbered[at:at + _PART_RUNS] for at in range(0, len(cases), _PART_RUNS)]
    open_parts = [k for k in range(len(chunks)) if not _part(folder, k).exists()]
    done = len(cases) - sum(len(chunks[k]) for k in open_parts)
    if progress:
        progress(done, len(cases))
    work = (_on_a_cluster(study, chunks, open_parts, scheduler) if scheduler
            else _here(study, chunks, open_parts, workers, lambda n: progress and progress(
                done + n, len(cases))))
    for k, rows in work:
        with replacing(_part(folder, k)) as temporary:
            write_rows(rows, temporary, schema)
        done += len(rows) if scheduler else 0
        if progress and scheduler:
            progress(done, len(cases))
    _finish(folder, len(chunks), schema)
    return open_batch(folder / TABLE)


def _begin(plan: Plan, files: str, folder: Path, force: bool) -> bool:
    """Claim the folder: new, or left by the same sweep of files that say the same.

    Returns:
        Whether every run is done already.

    Raises:
        InputError: it holds another sweep.
    """
    words = json.loads(json.dumps({**asdict(plan), "files": files, "code": code_hash()}))
    found = _read_plan(folder / PLAN)
    unfinished = found == words and not (folder / TABLE).exists()
    if force and not unfinished:
        shutil.rmtree(folder / PARTS, ignore_errors=True)
        (folder / TABLE).unlink(missing_ok=True)
    elif found != words and (found is not None or (folder / TABLE).exists()):
        other = sorted(key for key in words if (found or {}).get(key) != words[key])
        # other words, other files: these are told where nothing else differs
        other = [key for key in other if key != "files"] or other
        raise InputError(f"holds another sweep, of which {', '.join(other)} differ", file=folder,
                         expected="the same command to go on with it, or --force to begin anew")
    elif (folder / TABLE).exists():
        return True
    (folder / PARTS).mkdir(parents=True, exist_ok=True)
    with replacing(folder / PLAN) as temporary:
        temporary.write_text(json.dumps(words, indent=2) + "\n", encoding="utf-8")
    return False


def _read_plan(path: Path) -> dict[str, Any] | None:
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        return None
    except ValueError:
        return {}
    return found if isinstance(found, dict) else {}


def _part(folder: Path, number: int) -> Path:
    return folder / PARTS / f"{number:06d}.parquet"


def _here(study: Study, chunks: Sequence[list[Case]], wanted: Sequence[int], workers: int | None,
          tell: Callable[[int], object]) -> Iterator[tuple[int, list[Row]]]:
    """Parts done by threads on this machine, in order."""
    rows = run_all(study, (case for k in wanted for case in chunks[k]), sum(map(len, chunks)),
                   workers)
    count = 0
    for k in wanted:
        part = []
        for _ in chunks[k]:
            part.append(next(rows))
            count += 1
            tell(count)
        yield k, part


def _on_a_cluster(study: Study, chunks: Sequence[list[Case]], wanted: Sequence[int],
                  address: str) -> Iterator[tuple[int, list[Row]]]:
    """Parts done by the workers of a Dask cluster, as they come."""
    try:
        distributed: Any = import_module("distributed")
    except ImportError:
        raise InputError("--scheduler needs the library distributed",
                         expected="pip install 'truck_blowout_sim[dask]'") from None
    try:
        client = distributed.Client(address, timeout=_CONNECT_S)
    except (OSError, ValueError, TimeoutError) as error:
        raise InputError(f"--scheduler {address}: no scheduler answers ({error})",
                         expected="the address of a Dask scheduler, as tcp://host:8786") from None
    with client:
        futures = {client.submit(run_part, study, chunks[k], pure=False): k for k in wanted}
        for future in distributed.as_completed(futures):
            yield futures[future], future.result()


def run_part(study: Study, cases: Sequence[Case]) -> list[Row]:
    """Rows of some cases, one after the other: what a worker of a cluster does."""
    return [study.run(number, values) for number, values in cases]


def _finish(folder: Path, parts: int, schema: Any) -> None:  # noqa: ANN401
    """One table of all parts, a group of rows at a time."""
    import pyarrow.parquet as pq

    with replacing(folder / TABLE) as temporary, pq.ParquetWriter(
            temporary, schema, compression="zstd") as writer:
        for k in range(parts):
            writer.write_table(pq.read_table(_part(folder, k), schema=schema))
    shutil.rmtree(folder / PARTS)
