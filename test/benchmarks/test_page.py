from __future__ import annotations

import re
import sys
from pathlib import Path

import pytest

from benchmarks.page import Place, Table, machine, number, start_function
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.report.marked import marks, put_between

ROOT = Path(__file__).resolve().parents[2]
BEGIN, END = marks("core")
TEXT = f"above\n{BEGIN}\nold\n{END}\nbelow\n"
PLACES = (
    ("performance", "core"), ("performance", "peer"), ("many_runs", "studies"),
    ("proof_studies", "ablation"), ("ros", "step"), ("ros", "fast"), ("ros", "pace"),
    ("ros", "soak"), ("ros", "losses"),
)  # fmt: skip


@pytest.fixture
def page(tmp_path: Path) -> Path:
    path = tmp_path / "page.md"
    path.write_text(TEXT, encoding="utf-8")
    return path


def table() -> Table:
    made = Table("", "a step")
    made.row("sound", "1.5 µs")
    return made


def test_a_table_is_printed_as_it_grows(capsys: pytest.CaptureFixture[str]) -> None:
    assert capsys.readouterr().out == "" != str(table())
    assert capsys.readouterr().out == "| | a step |\n|---|---|\n| sound | 1.5 µs |\n"


def test_the_page_gets_the_table_and_on_what_it_was_measured(page: Path) -> None:
    Place(page, "core").put("one", table())
    said, one, rows = page.read_text(encoding="utf-8").split("\n\n")
    assert said.startswith(f"above\n{BEGIN}\nMeasured 2")
    assert machine() in said
    assert re.search(r"load average \d+\.\d( to \d+\.\d)?\.$", said)
    assert (one, rows) == ("one", f"{table()}\n{END}\nbelow\n")


def test_without_a_page_nothing_is_written(page: Path) -> None:
    Place(None, "core").put(table())
    assert page.read_text(encoding="utf-8") == TEXT


def test_a_page_without_the_place_is_refused_before_anything_is_measured(
    page: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    with pytest.raises(InputError, match="no such page"):
        Place(page.with_name("other.md"), "core")

    def measure() -> None:
        Place(page, "peer")

    monkeypatch.setattr(sys, "argv", ["benchmark"])
    with pytest.raises(SystemExit) as left:
        start_function(measure)
    assert left.value.code == 2
    assert capsys.readouterr().err == (
        f"{page}: no place for the table; expected <!-- peer: begin --> and <!-- peer: end -->, "
        "once each\n")  # fmt: skip


def test_figures_have_three_digits() -> None:
    assert [number(v) for v in (0.00512, 7.294, 18.0, 437.3, 359828.4)] == [
        "0.00512", "7.29", "18", "437", "359,828"]  # fmt: skip


@pytest.mark.parametrize(("page_name", "name"), PLACES)
def test_the_shipped_pages_have_a_place_for_each_table(page_name: str, name: str) -> None:
    text = (ROOT / "docs" / f"{page_name}.md").read_text(encoding="utf-8")
    begin, end = marks(name)
    inside = text.split(begin)[1].split(end)[0].strip("\n")
    assert inside
    assert put_between(text, name, inside) == text
