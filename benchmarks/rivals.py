"""What the rivals reach on cases that are diagnosed already.

    python -m benchmarks.rivals CASES RUN [WORKERS] [--most 60]

RUN is what `truck-blowout prove --cases CASES -o RUN --no-baselines` wrote. Each case with physics
missing that was not compared yet gets another line there, with the errors of the rivals beside that
of the answer; the same command goes on after an interruption. Lines of other recordings are left.
`--most`: so many such cases of the whole set, evenly spread.

Validated with: test/benchmarks/test_rivals.py.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from multiprocessing import get_context
from pathlib import Path
from typing import Annotated, Any

import typer

from benchmarks.page import start
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.proof.baselines.compare import baseline_errors
from truck_blowout_sim.proof.cases import ROLES, Case, find_cases, read_truth, spread
from truck_blowout_sim.proof.run import RESULTS, append, mixed, one_thread, read_lines
from truck_blowout_sim.proof.seal import folder_hash
from truck_blowout_sim.proof.summary import COMPARED
from truck_blowout_sim.recordings import read_recording

app = typer.Typer(no_args_is_help=True, add_completion=False, help=__doc__)


def some(cases: Sequence[Case], most: int) -> list[Case]:
    """At most so many of the cases with physics missing, evenly spread; 0: all."""
    return spread([case for case in cases if read_truth(case.answer).group in COMPARED], most)


def uncompared(cases: Sequence[Case], lines: Mapping[str, Mapping[str, Any]]) -> list[Case]:
    """Cases with physics missing that have an answer about these recordings, and no rivals."""
    return [case for case in some(cases, 0)
            if (line := lines.get(case.id)) and line["answer"] and not line["baselines"]
            and line["recordings_sha256"] == folder_hash(case.folder)]


def with_rivals(work: tuple[Case, Mapping[str, Any]]) -> dict[str, Any]:
    """The line of a case with the errors of the rivals."""
    case, line = work
    train, baseline, holdout = ([read_recording(path) for path in case.recordings(role)]
                                for role in ROLES)
    errors = baseline_errors(train, baseline, holdout, case.vehicle(), line["step_s"],
                             line["answer"]["fit"]["holdout"]["after"])
    return {**line, "baselines": errors, "with_baselines": True}


def compare(cases: Sequence[Case], run: Path, workers: int) -> Iterator[tuple[str, str]]:
    """Compare what is not compared yet; yields each case, and why it failed."""
    lines = read_lines(run / RESULTS)
    with one_thread(), ProcessPoolExecutor(workers, get_context("spawn")) as pool:
        jobs = {pool.submit(with_rivals, (case, lines[case.id])): case.id
                for case in mixed(uncompared(cases, lines))}
        for job in as_completed(jobs):
            try:
                append(run / RESULTS, job.result())
                yield jobs[job], ""
            except (ArithmeticError, ValueError, LookupError, RuntimeError, InputError) as error:
                yield jobs[job], f"{type(error).__name__}: {error}"


@app.command()
def main(cases: Path, run: Path,
         workers: Annotated[int, typer.Argument(help="processes")] = 2,
         most: Annotated[int, typer.Option(help="so many cases, evenly spread; 0: all")] = 0
         ) -> None:
    """Try the rivals."""
    if not (run / RESULTS).is_file():
        raise InputError("no answers", file=run, expected="what `truck-blowout prove -o` wrote")
    for case, error in compare(some(find_cases(cases), most), run, workers):
        print(case, error, flush=True)


if __name__ == "__main__":
    start(app)
