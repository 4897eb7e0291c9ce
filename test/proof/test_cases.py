from __future__ import annotations

import hashlib
import json
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.proof.cases import find_cases, read_truth, spread
from truck_blowout_sim.proof.seal import check_seals, find_manifest, folder_hash

WriteCase = Callable[..., Path]


def test_both_layouts_are_read(tmp_path: Path, write_case: WriteCase) -> None:
    write_case(tmp_path / "set", "b")
    write_case(tmp_path / "set", "a")
    (tmp_path / "set" / "cases" / "unfinished").mkdir()
    assert [c.id for c in find_cases(tmp_path / "set")] == ["a", "b"]
    hand = tmp_path / "hand" / "mine"
    hand.mkdir(parents=True)
    (hand / "answers.json").write_text("{}")
    (hand / "train_1.csv").write_text("")
    assert [c.id for c in find_cases(tmp_path / "hand")] == ["mine"]


def test_a_folder_without_cases_is_refused_in_one_line(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no case"):
        find_cases(tmp_path)


def test_a_limit_takes_evenly(tmp_path: Path, write_case: WriteCase) -> None:
    for k in range(10):
        write_case(tmp_path, f"{k}")
    cases = find_cases(tmp_path)
    assert [c.id for c in spread(cases, 2)] == ["2", "7"]
    assert spread(cases, 0) == spread(cases, 99) == cases


def test_a_null_may_be_called_miscalibrated(tmp_path: Path, write_case: WriteCase) -> None:
    truth = read_truth(write_case(tmp_path, "a"))
    assert truth.verdicts == ("consistent", "miscalibrated")


def test_an_answer_of_another_form_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "answer.json"
    path.write_text(json.dumps({"group": "null"}))
    with pytest.raises(InputError, match="verdict"):
        read_truth(path)


def test_the_cause_is_read_whole(tmp_path: Path, write_case: WriteCase,
                                 cause: Callable[..., dict[str, Any]]) -> None:
    entry = cause(onset_s={"train_1": 2.0})
    found = read_truth(write_case(tmp_path, "a", "single", (entry,))).causes[0]
    assert (found.name, found.sigma, found.strength) == ("brake_lag", 20.0, ("extra lag", 0.4, "s"))
    assert found.onset_s == {"train_1": 2.0}


def test_seals_hold_until_anything_moves(
    tmp_path: Path, write_case: WriteCase, manifest: Callable[[Path], Path]
) -> None:
    answers = [write_case(tmp_path, name) for name in "abc"]
    sealed = manifest(tmp_path)
    cases = find_cases(tmp_path)
    assert check_seals(cases, sealed).holds == ("a", "b", "c")
    answers[0].write_text(answers[0].read_text() + " ")
    (tmp_path / "cases" / "b" / "train_1.csv").write_text("changed")
    write_case(tmp_path, "d")
    check = check_seals(find_cases(tmp_path), sealed)
    assert (check.holds, check.broken, check.remade, check.absent) == (
        ("c",), ("a",), ("b",), ("d",))
    assert "1 broken, 1 with the sealed answer and other recordings" in check.sentence()
    assert "not sealed" in check_seals(cases, None).sentence()


def test_sealed_cases_that_were_left_out_are_told(
    tmp_path: Path, write_case: WriteCase, manifest: Callable[[Path], Path]
) -> None:
    for name in "abc":
        write_case(tmp_path, name)
    sealed, cases = manifest(tmp_path), find_cases(tmp_path)
    assert check_seals(cases, sealed).not_scored == ()
    assert "not scored" not in check_seals(cases, sealed).sentence()
    fewer = check_seals(cases[1:], sealed)  # one has gone
    assert fewer.not_scored == ("a",)
    unanswered = check_seals(cases, sealed, {"b"})  # two have no line
    assert unanswered.not_scored == ("a", "c")
    assert unanswered.sentence().endswith("; 2 of 3 sealed cases are not scored.")


def test_a_manifest_of_another_form_is_refused(tmp_path: Path) -> None:
    (tmp_path / "m.json").write_text("[]")
    with pytest.raises(InputError, match="manifest"):
        check_seals([], tmp_path / "m.json")


def test_a_manifest_that_was_edited_is_refused(
    tmp_path: Path, write_case: WriteCase, manifest: Callable[[Path], Path]
) -> None:
    write_case(tmp_path, "a")
    sealed = manifest(tmp_path)
    tree = json.loads(sealed.read_text())
    answer = tree["cases"]["a"]["answer_sha256"]
    tree["seal"] = hashlib.sha256(f"a {answer}\n".encode()).hexdigest()
    sealed.write_text(json.dumps(tree))
    assert check_seals(find_cases(tmp_path), sealed).holds == ("a",)
    tree["cases"]["a"]["answer_sha256"] = "0" * 64
    sealed.write_text(json.dumps(tree))
    with pytest.raises(InputError, match="seal is not that"):
        check_seals(find_cases(tmp_path), sealed)


def test_published_seals_come_before_those_beside_the_cases(
    tmp_path: Path, write_case: WriteCase, manifest: Callable[[Path], Path],
    monkeypatch: pytest.MonkeyPatch
) -> None:
    assert find_manifest(tmp_path) is None
    write_case(tmp_path, "a")
    beside = manifest(tmp_path)  # of a set called dev
    assert find_manifest(tmp_path) == beside
    package = tmp_path / "elsewhere" / "proving_ground"
    (package / "sealed").mkdir(parents=True)
    (package / "__init__.py").touch()
    published = package / "sealed" / "dev.json"
    published.write_text(beside.read_text())
    monkeypatch.syspath_prepend(str(package.parent))
    monkeypatch.delitem(sys.modules, "proving_ground", raising=False)
    assert find_manifest(tmp_path) == published
    assert find_manifest(tmp_path, "dev") == published
    assert find_manifest(tmp_path, "other") == beside


def test_what_a_case_must_do_without_is_part_of_it(tmp_path: Path, write_case: WriteCase) -> None:
    write_case(tmp_path, "a")
    case, = find_cases(tmp_path)
    whole = folder_hash(case.folder)
    assert case.without() == ()
    (case.folder / "library.json").write_text(json.dumps({"without": ["crosswind"]}))
    assert case.without() == ("crosswind",)
    assert folder_hash(case.folder) != whole
    (case.folder / "library.json").write_text("[]")
    with pytest.raises(InputError, match="not a list of effects"):
        case.without()
