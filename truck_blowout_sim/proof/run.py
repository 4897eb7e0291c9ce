"""Diagnose many cases in parallel; every finished one is a line on disk, so a run can resume.

Validated with: test/proof/test_run.py.
"""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from contextlib import contextmanager
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path
from typing import Any

from truck_blowout_sim.proof.blindfold import blindfold
from truck_blowout_sim.proof.cases import Case
from truck_blowout_sim.proof.orphan import end_with_parent
from truck_blowout_sim.proof.seal import folder_hash
from truck_blowout_sim.proof.worker import attempt
from truck_blowout_sim.resources import code_hash

RESULTS = "results.jsonl"
# Each process has one thread: the processes are what runs side by side.
ONE_THREAD = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")


def read_lines(path: Path) -> dict[str, dict[str, Any]]:
    """Lines of results by case, the last of each; a line cut off by an interruption is dropped."""
    found: dict[str, dict[str, Any]] = {}
    if not path.is_file():
        return found
    for text in path.read_text(encoding="utf-8").splitlines():
        try:
            line = json.loads(text)
        except json.JSONDecodeError:
            continue
        found[line["case"]] = line
    return found


@dataclass(frozen=True)
class Manner:
    """How cases are diagnosed.

    Attributes:
        step_s: step of the simulation [s].
        with_baselines: whether rivals are tried too.
        code: digest of the code that must have made a line; empty: any.
    """

    step_s: float
    with_baselines: bool
    code: str = ""

    def made(self, line: Mapping[str, Any]) -> bool:
        """Whether a line was made in this manner; what an old one does not say is taken for so."""
        return (line.get("error") is None
                and line.get("step_s", self.step_s) == self.step_s
                and line.get("with_baselines", True) >= self.with_baselines
                and self.code in ("", line.get("code")))


def unfinished(cases: Sequence[Case], lines: Mapping[str, Mapping[str, Any]], manner: Manner
               ) -> list[Case]:
    """Cases without a line of this manner about these recordings; a failed one is tried again."""
    return [case for case in cases if case.id not in lines or not manner.made(lines[case.id])
            or lines[case.id]["recordings_sha256"] != folder_hash(case.folder)]


def run_cases(cases: Sequence[Case], out: Path, *, workers: int, step_s: float,
              with_baselines: bool, renew: bool = False,
              begin: Callable[[], None] = blindfold) -> Iterator[dict[str, Any]]:
    """Diagnose what has no line yet, append and yield each line as it comes.

    ``renew``: also what other code answered. ``begin``: what each process does first; it must
    leave the process blindfolded.
    """
    path, code = out / RESULTS, code_hash()
    todo = unfinished(cases, read_lines(path),
                      Manner(step_s, with_baselines, code if renew else ""))
    if not todo:
        return
    out.mkdir(parents=True, exist_ok=True)
    with one_thread(), ProcessPoolExecutor(workers, get_context("spawn"),
                                           initializer=end_with_parent, initargs=(begin,)) as pool:
        jobs = [pool.submit(attempt, (case, step_s, with_baselines)) for case in mixed(todo)]
        try:
            for job in as_completed(jobs):
                line = {**job.result(), "code": code, "step_s": step_s,
                        "with_baselines": with_baselines}
                append(path, line)
                yield line
        finally:
            for job in jobs:
                job.cancel()


@contextmanager
def one_thread() -> Iterator[None]:
    """Ask for one thread in processes that start now; as before afterwards.

    Numba reads its settings anew, and forgets where it caches, once such a variable has changed.
    """
    missing = [name for name in ONE_THREAD if name not in os.environ]
    os.environ.update(dict.fromkeys(missing, "1"))
    try:
        yield
    finally:
        for name in missing:
            os.environ.pop(name, None)


def mixed(cases: Sequence[Case]) -> list[Case]:
    """Cases in strides: sets are ordered by group, and so every first part has all groups."""
    stride = max(1, round(len(cases) ** 0.5))
    return [case for first in range(stride) for case in cases[first::stride]]


def append(path: Path, line: dict[str, Any]) -> None:
    """Add one line, on a line of its own even behind one that was cut off."""
    text = json.dumps(line, allow_nan=False) + "\n"
    cut_off = path.is_file() and not path.read_bytes().endswith(b"\n") and path.stat().st_size
    with path.open("a", encoding="utf-8") as file:
        file.write(("\n" if cut_off else "") + text)
        file.flush()
        os.fsync(file.fileno())
