"""Names: listed, completed by the shell, and the nearest one told for a typo."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from truck_blowout_sim.cli.listing import listing, names_of
from truck_blowout_sim.cli.main import VERBS, main


@pytest.mark.parametrize("verb", VERBS)
def test_the_help_of_every_verb_has_an_example(
    verb: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([verb, "--help"]) == 0
    assert f"Example: truck-blowout {verb}" in " ".join(capsys.readouterr().out.split())


@pytest.mark.parametrize(("verb", "shown"), [
    ("sweep", "blowout_in_lane"), ("compare", "test_2013_steer_blowout"),
    ("diagnose", "rebuilt_record"), ("calibrate", "rigid_truck"), ("view", "East Liberty"),
])  # fmt: skip
def test_every_verb_that_takes_shipped_names_lists_them(
    verb: str, shown: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([verb, "--list"]) == 0
    assert shown in capsys.readouterr().out


def test_a_pipe_gets_the_error_line_and_nothing_else(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["compare", "no_such_recording", "-o", str(tmp_path)]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1


def test_a_sweep_in_which_every_run_fails_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    study = ["--vary", "blowouts.failure.tires=steer_lft", "-o", str(tmp_path)]
    assert main(["sweep", "blowout_in_lane", *study]) == 2
    said = capsys.readouterr().out
    assert said.startswith("1 run, 1 failed")
    assert "did you mean 'steer_left'?" in said


@pytest.mark.parametrize("words", [["run", "--list", "--json"], ["run", "--json", "--list"]])
def test_list_is_json_where_json_is_asked_for(
    words: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(words) == 0
    found = json.loads(capsys.readouterr().out)
    assert list(found) == ["scenarios", "vehicles"]
    assert "Ferrari" in found["vehicles"]["ferrari_250lm"]


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
    (["diagnose", "test_2013_steer_blowout", "--settings", "rebuild_record"], "rebuilt_record"),
    (["run", "lane_change"], "double_lane_change"),
    (["run", "coast_down", "--vehicle", "trailmobile_international_9400i"],
     "international_9400i_trailmobile"),
    (["run", "coast_down", "--blow", "left_steer@3"], "steer_left"),
    (["compare", "test_2013_ster_blowout"], "test_2013_steer_blowout"),
])  # fmt: skip
def test_a_typo_is_answered_with_the_nearest_name(
    words: list[str], near: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([*words, *(["-o", str(tmp_path)] if words[0] == "diagnose" else [])]) == 2
    assert f"did you mean '{near}'?" in capsys.readouterr().err


def test_a_path_is_not_answered_with_a_shipped_name(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", "coast_down", "--vehicle", "my_truck.yaml"]) == 2
    assert "did you mean" not in capsys.readouterr().err


@pytest.mark.parametrize("words", [["run"], ["vehicle"], ["run", "coast_down", "--vehicle"]])
def test_a_folder_in_place_of_a_file_is_told(
    words: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([*words, str(tmp_path)]) == 2
    assert f"{tmp_path}: is a folder; expected a YAML file" in capsys.readouterr().err


@pytest.mark.parametrize("word", ["steer_lft@3", "steer_left@500"])
def test_a_wrong_blowout_is_told_as_it_was_written(
    word: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["run", "coast_down", "--blow", word]) == 2
    assert f"blowout {word}: " in capsys.readouterr().err


@pytest.mark.parametrize(("line", "word", "completed"), [
    ("truck-blowout va", 1, "validate"),
    ("truck-blowout run steer_a", 2, "steer_axle_blowout"),
    ("truck-blowout compare --impose-s", 2, "--impose-speed"),
    ("truck-blowout compare test_20", 2, "test_2013_steer_blowout"),
    ("truck-blowout sweep fish", 2, "fishhook"),
    ("truck-blowout diagnose log.csv --settings r", 4, "rebuilt_record"),
])  # fmt: skip
def test_the_shell_completes_verbs_names_and_options(line: str, word: int, completed: str) -> None:
    done = subprocess.run(
        [sys.executable, "-c", "from truck_blowout_sim.cli.main import VERBS, main; main(None)"],
        env={**os.environ, "_TRUCK_BLOWOUT_COMPLETE": "complete_bash", "COMP_WORDS": line,
             "COMP_CWORD": str(word)},
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert completed in done.stdout.split()


def test_completion_offers_names_that_begin_so() -> None:
    assert names_of("vehicles")("rigid") == ["rigid_truck"]
