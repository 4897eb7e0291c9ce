"""`truck-blowout validate -o FILE`: the words above the mark stay, the tables are replaced."""

from __future__ import annotations

from pathlib import Path

import pytest

from truck_blowout_sim.cli import validate as verb
from truck_blowout_sim.errors import InputError


@pytest.mark.parametrize("old", ["", "# Words\n\n", f"# Words\n\n{verb.MARK}\n\nold table\n"])
def test_words_above_the_mark_are_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, old: str
                                       ) -> None:
    monkeypatch.setattr(verb, "validate", lambda say: {})
    monkeypatch.setattr(verb, "as_markdown", lambda table: "new table\n")
    page = tmp_path / "page.md"
    page.write_text(old, encoding="utf-8")
    verb.command(page, force=True, as_json=False)
    words = old.partition(verb.MARK)[0]
    assert page.read_text(encoding="utf-8") == f"{words}{verb.MARK}\n\nnew table\n"


def test_a_page_is_replaced_only_with_force(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text("mine", encoding="utf-8")
    with pytest.raises(InputError, match="--force"):
        verb.command(page, force=False, as_json=False)
    assert page.read_text(encoding="utf-8") == "mine"
