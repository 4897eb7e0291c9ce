"""Diagnose one case in a process of its own, with one thread, and say it in one line of JSON."""

from __future__ import annotations

import time
from dataclasses import replace
from typing import Any

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.proof.blindfold import blindfolded
from truck_blowout_sim.proof.cases import ROLES, Case


def diagnose_case(case: Case, *, step_s: float, with_baselines: bool) -> dict[str, Any]:
    """The line of a case; never reads the answer.

    A case on which the diagnosis fails is a result too: ``error`` says how, and it is not
    solved.
    """
    from truck_blowout_sim.diagnosis import USUAL, diagnose
    from truck_blowout_sim.proof.baselines.compare import baseline_errors
    from truck_blowout_sim.proof.memory import Memory
    from truck_blowout_sim.proof.seal import folder_hash
    from truck_blowout_sim.recordings import read_recording

    started, cpu = time.perf_counter(), time.process_time()
    line: dict[str, Any] = {"case": case.id, "recordings_sha256": folder_hash(case.folder),
                            "answer": None, "baselines": None, "error": None}
    memory = Memory()
    try:
        train, baseline, holdout = ([read_recording(path) for path in case.recordings(role)]
                                    for role in ROLES)
        answer, _ = diagnose(train, baseline=baseline, holdout=holdout, workers=1,
                             effort=replace(USUAL, step_s=step_s, next_run=False),  # not scored
                             without=case.without(), kept=memory, vehicle=case.vehicle())
        line["answer"] = answer.as_json()
        line["cpu_s"] = round(time.process_time() - cpu, 1)
        if with_baselines:
            line["baselines"] = baseline_errors(train, baseline, holdout, case.vehicle(), step_s,
                                                answer.holdout.after, memory)
    except (ArithmeticError, ValueError, LookupError, AssertionError, RuntimeError,
            InputError) as error:
        line["error"] = f"{type(error).__name__}: {error}"
    line.setdefault("cpu_s", round(time.process_time() - cpu, 1))
    line["wall_s"] = round(time.perf_counter() - started, 1)
    return line


def attempt(work: tuple[Case, float, bool]) -> dict[str, Any]:
    """:func:`diagnose_case` of one tuple, as a pool of processes wants it."""
    case, step_s, with_baselines = work
    line = diagnose_case(case, step_s=step_s, with_baselines=with_baselines)
    return {**line, "blindfolded": blindfolded()}
