"""Generate many cases: in parallel, resumable, with progress."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from multiprocessing import get_context
from pathlib import Path

from proving_ground.build import CaseBuilder, save_answer
from proving_ground.cases import GROUPS, CaseSpec


def make_case(spec: CaseSpec, out: Path) -> str:
    """Recordings into `cases/<id>`, answer into `answers/<id>.json`; the answer comes last."""
    unfinished = out / "unfinished" / spec.id
    if unfinished.exists():
        shutil.rmtree(unfinished)
    answer = builder(spec).build(unfinished)
    done = out / "cases" / spec.id
    if done.exists():
        shutil.rmtree(done)
    done.parent.mkdir(parents=True, exist_ok=True)
    unfinished.rename(done)
    save_answer(out / "answers" / f"{spec.id}.json", answer)
    return spec.id


def builder(spec: CaseSpec) -> CaseBuilder:
    """Who builds a case: the truck's builder or the car's."""
    if spec.truth != "w3":
        return CaseBuilder(spec)
    from proving_ground.car.build import CarBuilder

    return CarBuilder(spec)


def pending(specs: list[CaseSpec], out: Path) -> list[CaseSpec]:
    """Cases that have no answer yet."""
    return [spec for spec in specs if not (out / "answers" / f"{spec.id}.json").exists()]


def interleaved(specs: list[CaseSpec]) -> list[CaseSpec]:
    """The same cases, ordered so that any first part holds the groups in their proportions."""
    sizes = {group: sum(spec.group == group for spec in specs) for group in GROUPS}
    met = dict.fromkeys(GROUPS, 0)
    keyed = []
    for number, spec in enumerate(specs):
        met[spec.group] += 1
        keyed.append(((met[spec.group] - 0.5) / sizes[spec.group], number, spec))
    return [spec for _, _, spec in sorted(keyed, key=lambda row: row[:2])]


def generate(specs: list[CaseSpec], out: Path, cores: int) -> Iterator[tuple[str, str]]:
    """Make all pending cases; yields each id and, where its truck went astray, why."""
    work = iter(pending(specs, out))
    if cores <= 1:
        for spec in work:
            yield _attempt(spec, out)
        return
    with ProcessPoolExecutor(cores, mp_context=get_context("spawn")) as pool:
        running: set[Future[tuple[str, str]]] = set()
        for spec in work:
            running.add(pool.submit(_attempt, spec, out))
            if len(running) >= 2 * cores:
                done, running = wait(running, return_when=FIRST_COMPLETED)
                yield from (future.result() for future in done)
        while running:
            done, running = wait(running, return_when=FIRST_COMPLETED)
            yield from (future.result() for future in done)


def _attempt(spec: CaseSpec, out: Path) -> tuple[str, str]:
    """One case; a truck whose state is not finite spoils its own case only."""
    try:
        return make_case(spec, out), ""
    except FloatingPointError as error:
        return spec.id, str(error)
