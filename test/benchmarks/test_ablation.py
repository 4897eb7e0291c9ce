from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from benchmarks.ablation import app
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.report.marked import marks

ROWS = {
    "false alarms, nothing missing": (1, 62),
    "effects seen by an ideal detector, among the causes named": (0, 0),
    "effects beyond six spreads of fault-free vehicles, among the causes named": (21, 52),
    "a wrong name stated, something missing": (2, 88),
}


def folder(path: Path, cases: tuple[str, ...] = ("w3-1", "w3-2")) -> Path:
    """What `truck-blowout prove -o` wrote, as far as it counts here."""
    rows = [{"row": row, "hits": hits, "trials": trials} for row, (hits, trials) in ROWS.items()]
    figures: dict[str, Any] = {"rows": rows, "each": [{"case": case} for case in cases[:-1]],
                               "failed": {cases[-1]: "broke"}}  # fmt: skip
    path.mkdir()
    (path / "proof.json").write_text(json.dumps(figures), encoding="utf-8")
    return path


def test_runs_stand_side_by_side_on_the_page(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    begin, end = marks("ablation")
    page.write_text(f"{begin}\n{end}\nbelow\n", encoding="utf-8")
    runs = [f"{part}={folder(tmp_path / part)}" for part in ("whole", "laws")]
    done = CliRunner().invoke(app, ["table", *runs, "-o", str(page)], catch_exceptions=False)
    assert done.exit_code == 0
    assert page.read_text(encoding="utf-8") == (
        f"{begin}\n| | false alarms | effects beyond six spreads named | wrong names |\n"
        "|---|---|---|---|\n| whole | 1 of 62 | 21 of 52 | 2 of 88 |\n"
        f"| one law an effect | 1 of 62 | 21 of 52 | 2 of 88 |\n{end}\nbelow\n")  # fmt: skip


def test_runs_of_different_cases_are_refused(tmp_path: Path) -> None:
    runs = [f"whole={folder(tmp_path / 'a')}", f"laws={folder(tmp_path / 'b', ('w3-1', 'w3-3'))}"]
    with pytest.raises(InputError, match="runs of different cases"):
        CliRunner().invoke(app, ["table", *runs], catch_exceptions=False)


@pytest.mark.parametrize(
    ("word", "said"), [("law=x", "'law'; expected one of whole"), ("laws=x", "no such file")]
)
def test_a_word_that_names_no_run_is_refused(word: str, said: str) -> None:
    with pytest.raises(InputError, match=said):
        CliRunner().invoke(app, ["table", word], catch_exceptions=False)
