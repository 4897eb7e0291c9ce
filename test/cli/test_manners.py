"""Names: listed, completed by the shell, and the nearest one told for a typo."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from truck_blowout_sim.cli.listing import listing, names_of
from truck_blowout_sim.cli.main import main


def test_list_shows_shipped_files_with_titles(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", "--list"]) == 0
    said = capsys.readouterr().out
    assert "steer_axle_blowout" in said
    assert "rigid two-axle truck" in said
    assert said.splitlines() == list(listing("scenarios", "vehicles"))


@pytest.mark.parametrize(("words", "near"), [
    (["run", "ster_axle_blowout"], "steer_axle_blowout"),
    (["vehicle", "rigid_trck"], "rigid_truck"),
    (["run", "coast_down", "--vehicle", "ferari"], "ferrari_250lm"),
])  # fmt: skip
def test_a_typo_is_answered_with_the_nearest_name(
    words: list[str], near: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(words) == 2
    assert f"did you mean '{near}'?" in capsys.readouterr().err


@pytest.mark.parametrize(("line", "word", "completed"), [
    ("truck-blowout va", 1, "validate"),
    ("truck-blowout run steer_a", 2, "steer_axle_blowout"),
    ("truck-blowout compare --impose-s", 2, "--impose-speed"),
])  # fmt: skip
def test_the_shell_completes_verbs_names_and_options(line: str, word: int, completed: str) -> None:
    done = subprocess.run(
        [sys.executable, "-c", "from truck_blowout_sim.cli.main import main; main(None)"],
        env={**os.environ, "_TRUCK_BLOWOUT_COMPLETE": "complete_bash", "COMP_WORDS": line,
             "COMP_CWORD": str(word)},
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert completed in done.stdout.split()


def test_completion_offers_names_that_begin_so() -> None:
    assert names_of("vehicles")("rigid") == ["rigid_truck"]
