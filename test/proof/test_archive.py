"""Published answers: counting them again gives what the run gave, and what the pages say."""

from __future__ import annotations

import hashlib
import json
import lzma
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from proving_ground.worlds import WORLDS
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.proof.archive import (
    answered_again,
    entries_of,
    joined,
    read_entries,
    score_entries,
    write_entries,
)
from truck_blowout_sim.proof.cases import SIGMA_B, find_cases
from truck_blowout_sim.proof.causes import causes_table
from truck_blowout_sim.proof.places import Places
from truck_blowout_sim.proof.prove import score_run
from truck_blowout_sim.proof.seal import folder_hash
from truck_blowout_sim.proof.worlds import Figures, answered_of, sets_table, worlds_table

Maker = Callable[..., dict[str, Any]]
Counted = dict[str, dict[str, Figures]]
ROOT = Path(__file__).parents[2]


@pytest.fixture
def run(tmp_path: Path, write_case: Callable[..., Path], line: Maker, effect: Maker, cause: Maker
        ) -> dict[str, dict[str, Any]]:
    """Lines of a null, a named effect and one that was missed, with sigma_b beside the cases."""
    lines = {"n": line("n", "consistent", p_value=0.3), "s": line("s", effects=(effect(),)),
             "m": line("m", "miscalibrated")}
    write_case(tmp_path, "n")
    for name in ("s", "m"):
        write_case(tmp_path, name, "single", (cause(),))
    (tmp_path / SIGMA_B).write_text(json.dumps(
        {"s": {"sigma_b": [12.0], "individual": [9.0]}, "m": {"sigma_b": [3.0]}}))
    return {name: {**one, "recordings_sha256": folder_hash(tmp_path / "cases" / name)}
            for name, one in lines.items()}


def test_published_answers_give_the_figures_of_the_run(
    tmp_path: Path, run: dict[str, dict[str, Any]], manifest: Callable[[Path], Path]
) -> None:
    cases, sealed, path = find_cases(tmp_path), manifest(tmp_path), tmp_path / "answers.jsonl.xz"
    expected = score_run(cases, run, tmp_path / "run", sealed)
    write_entries(path, entries_of(cases, run))
    found = score_entries(read_entries(path), sealed, tmp_path / "again", path)
    assert found == expected
    assert (tmp_path / "again" / "cases.csv").read_bytes() == (
        tmp_path / "run" / "cases.csv").read_bytes()


def test_a_draw_is_published_in_parts(tmp_path: Path, run: dict[str, dict[str, Any]]) -> None:
    """A later part adds its cases, and replaces a case that was answered again."""
    every = {entry.case: entry for entry in entries_of(find_cases(tmp_path), run)}
    anew = replace(every["m"], line={**every["m"].line, "cpu_s": 9.0})
    found = joined([every["s"], every["m"]], [every["n"], anew])
    assert found == [anew, every["n"], every["s"]]


def test_a_moved_answer_shows(
    tmp_path: Path, run: dict[str, dict[str, Any]], manifest: Callable[[Path], Path]
) -> None:
    sealed, entries = manifest(tmp_path), entries_of(find_cases(tmp_path), run)
    moved = replace(entries[0], truth=entries[0].truth + " ")
    found = score_entries([moved, *entries[1:]], sealed, tmp_path / "out", tmp_path)
    assert list(found["seals"]["broken"]) == [moved.case]


@pytest.mark.parametrize("content", [b"", b"not xz", lzma.compress(b"[1]\n"),
                                     lzma.compress(b'{"case": "a"}\n')])
def test_a_damaged_file_is_refused_in_one_line(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "answers.jsonl.xz"
    path.write_bytes(content)
    with pytest.raises(InputError, match="no published answers") as error:
        read_entries(path)
    assert "\n" not in str(error.value)


@pytest.fixture(scope="module")
def counted(tmp_path_factory: pytest.TempPathFactory) -> Counted:
    """Figures by world of the published answers, of later code to the same, of the later draw."""
    found: Counted = {"answers": {}, "again": {}, "later": {}}
    for world in WORLDS:
        places = Places(ROOT, world)
        manifests = {"later": places.later_manifest}
        for name, figures in found.items():
            path, out = getattr(places, name), tmp_path_factory.mktemp(name)
            figures[world] = score_entries(
                read_entries(path), manifests.get(name, places.manifest), out, path)
            if name == "answers":
                assert (out / "cases.csv").read_text() == places.cases.read_text()
    return found


def page(name: str) -> str:
    """The text of a page."""
    return (ROOT / name).read_text(encoding="utf-8")


def test_no_seal_is_broken(counted: Counted) -> None:
    for name, every in counted.items():
        assert not any(figures["seals"]["broken"] for figures in every.values()), name
    assert not any(figures["seals"]["remade"] for figures in counted["answers"].values())


def test_the_pages_say_what_the_published_answers_say(counted: Counted) -> None:
    figures = counted["answers"]
    assert worlds_table(figures) in page("docs/proof.md")
    assert causes_table(figures) in page("docs/proof.md")
    assert worlds_table(figures, short=True) in page("README.md")


def test_the_page_begins_with_all_sets_side_by_side(counted: Counted) -> None:
    rows = sets_table(counted).splitlines()[2:]
    assert "\n".join(rows) in page("docs/proof.md")
    assert all(row.count("|") == 5 for row in rows)


def test_the_page_says_what_later_code_answers_to_the_published_cases(counted: Counted) -> None:
    for world in WORLDS:
        places = Places(ROOT, world)
        every = {entry.case: entry for entry in read_entries(places.answers)}
        assert all(entry.truth == every[entry.case].truth for entry in read_entries(places.again))
    figures = counted["again"]
    assert worlds_table(figures, short=True) in page("docs/proof.md")
    assert answered_of(figures) in page("docs/proof.md")
    for words in ("effects beyond six spreads", "a wrong name stated"):
        cells = [f"{row['hits']} of {row['trials']}" for one in figures.values()
                 for row in one["rows"] if row["row"].startswith(words)]
        assert " | ".join(cells) in page("README.md")


def test_the_page_says_what_was_answered_to_the_later_draw(counted: Counted) -> None:
    """Every case of it is counted, and none is of the draw before."""
    for world in WORLDS:
        places = Places(ROOT, world)
        cases = {one.case for one in read_entries(places.later)}
        assert cases == set(json.loads(places.later_manifest.read_text())["cases"])
        assert not cases & {one.case for one in read_entries(places.again)}
    table = worlds_table(counted["later"], short=True)
    assert f"Cases: {answered_of(counted['later'])}.\n\n{table}" in page("docs/proof.md")


def test_later_answers_take_the_place_of_published_ones(
    tmp_path: Path, run: dict[str, dict[str, Any]]
) -> None:
    published = entries_of(find_cases(tmp_path), run)
    later = {"s": {**run["s"], "cpu_s": 3.0}, "of another draw": run["s"]}
    (found,) = answered_again(published, later)
    assert (found.case, found.line["cpu_s"]) == ("s", 3.0)
    assert found.truth == next(one.truth for one in published if one.case == "s")


def test_a_case_that_ends_in_an_error_counts_as_a_miss_and_names_no_folder(
    tmp_path: Path, run: dict[str, dict[str, Any]], manifest: Callable[[Path], Path]
) -> None:
    cases, sealed = find_cases(tmp_path), manifest(tmp_path)
    why = f"{tmp_path / 'cases' / 's'}/train_1.csv, line 9: no number"
    broken = {**run, "s": {**run["s"], "answer": None, "error": why}}
    entries = entries_of(cases, broken)
    figures = score_entries(entries, sealed, tmp_path / "out", tmp_path)
    named = next(row for row in figures["rows"] if "beyond six spreads" in row["row"])
    assert (named["hits"], named["trials"]) == (0, 1)
    assert [one["found"] for one in figures["causes"]] == [False]
    assert figures["failed"] == {"s": "train_1.csv, line 9: no number"}
    assert str(tmp_path) not in repr(entries)
    assert ",error," in (tmp_path / "out" / "cases.csv").read_text()


def test_the_sealed_text_is_kept_to_the_byte(tmp_path: Path, run: dict[str, dict[str, Any]]
                                             ) -> None:
    for case, entry in zip(find_cases(tmp_path), entries_of(find_cases(tmp_path), run),
                           strict=True):
        assert hashlib.sha256(entry.truth.encode()).digest() == hashlib.sha256(
            case.answer.read_bytes()).digest()
