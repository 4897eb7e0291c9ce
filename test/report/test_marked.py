from __future__ import annotations

from pathlib import Path

import pytest

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.report.marked import marks, put_between, put_on_page

ROOT = Path(__file__).resolve().parents[2]
BEGIN, END = marks("core")
TEXT = f"above\n{BEGIN}\nold\n{END}\nbelow\n"


def test_only_what_stands_between_the_marks_is_replaced() -> None:
    other = "".join(marks("peer"))
    assert put_between(other + TEXT, "core", "new") == other + TEXT.replace("old", "new")


@pytest.mark.parametrize(
    "spoiled", ["nothing", f"{END}{BEGIN}", TEXT + TEXT, f"{BEGIN}{TEXT}", TEXT + END]
)
def test_marks_that_are_missing_or_double_are_refused(spoiled: str, tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text(spoiled, encoding="utf-8")
    with pytest.raises(InputError) as caught:
        put_on_page(page, "core", "new")
    assert str(caught.value) == (
        f"{page}: no place for the table; expected {BEGIN} and {END}, once each")  # fmt: skip
    assert page.read_text(encoding="utf-8") == spoiled


def test_a_page_that_is_not_there_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no such page"):
        put_on_page(tmp_path / "page.md", "core", "new")


@pytest.mark.parametrize("page", ["README.md", "docs/proof.md"])
def test_the_shipped_pages_have_a_place_for_the_proof(page: str) -> None:
    text = (ROOT / page).read_text(encoding="utf-8")
    assert put_between(text, "proof", "new") != text
