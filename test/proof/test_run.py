from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ProcessPoolExecutor, ThreadPoolExecutor
from dataclasses import replace
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import pytest

from truck_blowout_sim.cli.main import main
from truck_blowout_sim.proof import run
from truck_blowout_sim.proof.blindfold import blindfold, blindfolded
from truck_blowout_sim.proof.cases import find_cases
from truck_blowout_sim.proof.run import RESULTS, Manner, append, mixed, read_lines, unfinished
from truck_blowout_sim.proof.seal import folder_hash

WriteCase = Callable[..., Path]
USUAL = Manner(0.0025, False)


def test_a_cut_off_line_is_made_again(tmp_path: Path) -> None:
    path = tmp_path / RESULTS
    append(path, {"case": "a", "n": 1})
    with path.open("a") as file:
        file.write('{"case": "b", "ans')
    append(path, {"case": "c", "n": 3})
    assert sorted(read_lines(path)) == ["a", "c"]
    append(path, {"case": "a", "n": 2})
    assert read_lines(path)["a"]["n"] == 2


def test_changed_recordings_are_diagnosed_again(tmp_path: Path, write_case: WriteCase) -> None:
    for name in "ab":
        write_case(tmp_path, name)
    cases = find_cases(tmp_path)
    lines: dict[str, dict[str, Any]] = {
        c.id: {"recordings_sha256": folder_hash(c.folder)} for c in cases}
    assert unfinished(cases, lines, USUAL) == []
    (tmp_path / "cases" / "b" / "train_1.csv").write_text("other")
    assert [c.id for c in unfinished(cases, lines, USUAL)] == ["b"]


@pytest.mark.parametrize(("said", "manner", "again"), [
    ({}, USUAL, False),  # a published line says no more than its code
    ({"code": "old"}, USUAL, False),
    ({"code": "old"}, replace(USUAL, code="new"), True),
    ({"code": "new"}, replace(USUAL, code="new"), False),
    ({"step_s": 0.005}, USUAL, True),
    ({"step_s": 0.0025, "with_baselines": True}, USUAL, False),
    ({"with_baselines": False}, replace(USUAL, with_baselines=True), True),
    ({"error": "MemoryError: no room"}, USUAL, True),
])
def test_a_line_of_another_manner_and_a_failed_one_are_made_again(
    tmp_path: Path, write_case: WriteCase, said: dict[str, Any], manner: Manner, again: bool
) -> None:
    write_case(tmp_path, "a")
    cases = find_cases(tmp_path)
    line = {"recordings_sha256": folder_hash(cases[0].folder), **said}
    assert bool(unfinished(cases, {"a": line}, manner)) == again


def test_an_order_of_strides_keeps_every_case(tmp_path: Path, write_case: WriteCase) -> None:
    for k in range(10):
        write_case(tmp_path, str(k))
    cases = find_cases(tmp_path)
    order = mixed(cases)
    assert sorted(order, key=lambda c: c.id) == cases
    assert [c.id for c in order[:4]] == ["0", "3", "6", "9"]


def test_a_finished_run_starts_no_process(
    tmp_path: Path, write_case: WriteCase, monkeypatch: pytest.MonkeyPatch
) -> None:
    write_case(tmp_path, "a")
    case = find_cases(tmp_path)[0]
    append(tmp_path / RESULTS, {"case": "a", "recordings_sha256": folder_hash(case.folder)})

    def refuse(*args: object, **kwargs: object) -> Iterator[object]:
        raise AssertionError("a pool was started")

    monkeypatch.setattr(run, "ProcessPoolExecutor", refuse)
    lines = run.run_cases([case], tmp_path, workers=1, step_s=0.01, with_baselines=False)
    assert list(lines) == []


def test_a_diagnosis_that_breaks_down_is_a_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
                                                write_case: WriteCase) -> None:
    import truck_blowout_sim.diagnosis
    import truck_blowout_sim.recordings
    from truck_blowout_sim.proof.worker import diagnose_case

    def broken(*args: object, **kwargs: object) -> None:
        raise FloatingPointError("state is not finite")

    monkeypatch.setattr(truck_blowout_sim.diagnosis, "diagnose", broken)
    monkeypatch.setattr(truck_blowout_sim.recordings, "read_recording", lambda path: path)
    write_case(tmp_path, "a")
    line = diagnose_case(find_cases(tmp_path)[0], step_s=0.01, with_baselines=False)
    assert line["answer"] is None
    assert line["error"] == "FloatingPointError: state is not finite"
    assert json.dumps(line, allow_nan=False)


def test_a_process_that_diagnoses_is_refused_every_answer(
    tmp_path: Path, write_case: WriteCase
) -> None:
    answer = write_case(tmp_path, "a")
    recording = tmp_path / "cases" / "a" / "train_1.csv"
    with ProcessPoolExecutor(1, get_context("spawn"), initializer=blindfold) as pool:
        assert pool.submit(Path.read_text, recording).result() == "time_s\na\n"
        assert pool.submit(blindfolded).result()
        with pytest.raises(PermissionError, match="sealed answer"):
            pool.submit(Path.read_text, answer).result()
    assert not blindfolded()
    assert answer.read_text()


def test_one_thread_is_asked_for_only_while_processes_run(monkeypatch: pytest.MonkeyPatch) -> None:
    """Numba forgets the folder of its cache once its variables have changed."""
    for name in run.ONE_THREAD:
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("OMP_NUM_THREADS", "3")
    before = dict(os.environ)
    with run.one_thread():
        assert (os.environ["NUMBA_NUM_THREADS"], os.environ["OMP_NUM_THREADS"]) == ("1", "3")
    assert dict(os.environ) == before


def test_old_answers_are_scored_and_told_and_renewed_on_demand(
    tmp_path: Path, write_case: WriteCase, line: Callable[..., dict[str, Any]],
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    write_case(tmp_path, "a")
    case = find_cases(tmp_path)[0]
    old = line("a", "consistent", code="of last month", recordings_sha256=folder_hash(case.folder))
    (tmp_path / "out").mkdir()
    append(tmp_path / "out" / RESULTS, old)
    words = ["prove", "--cases", str(tmp_path), "-o", str(tmp_path / "out"), "--workers", "1"]
    assert main(words) == 0
    assert "answers of another version of the code: 1; --renew" in capsys.readouterr().err
    made = {**old, "code": "now"}
    monkeypatch.setattr(run, "ProcessPoolExecutor", lambda *_, **__: Straightaway(made))
    assert main([*words, "--renew"]) == 0
    assert "another version" not in capsys.readouterr().err
    assert read_lines(tmp_path / "out" / RESULTS)["a"]["step_s"] == 0.0025


class Straightaway(ThreadPoolExecutor):
    """Gives one line for every case, without a diagnosis."""

    def __init__(self, line: dict[str, Any]) -> None:
        super().__init__(1)
        self.line = line

    def submit(self, *_: object, **__: object) -> Future[dict[str, Any]]:  # type: ignore[override]
        return super().submit(dict, self.line)
