"""Nothing that exists is overwritten unasked, and no output lands on an input."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from truck_blowout_sim.cli.main import main
from truck_blowout_sim.cli.outputs import free_name, say
from truck_blowout_sim.errors import InputError, StorageError
from truck_blowout_sim.recordings.atomic import replacing
from truck_blowout_sim.recordings.claims import claim


def made(path: Path) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("kept")
    return path


def test_a_new_file_and_an_empty_folder_are_free(tmp_path: Path) -> None:
    assert claim(tmp_path / "new.csv") == tmp_path / "new.csv"
    (tmp_path / "empty").mkdir()
    assert claim(tmp_path / "empty") == tmp_path / "empty"


@pytest.mark.parametrize("name", ["old.csv", "bag/bag_0.mcap"])
def test_what_exists_is_replaced_only_with_force(tmp_path: Path, name: str) -> None:
    made(tmp_path / name)
    target = tmp_path / name.split("/")[0]
    with pytest.raises(InputError, match="exists already; expected a new name, or --force"):
        claim(target)
    assert claim(target, force=True) == target


@pytest.mark.parametrize(("words", "problem"), [
    (["view", "-o", "FOLDER"], "expected a name that ends in .html"),
    (["view", "-o", "FOLDER.html"], "is a folder; expected a file to write"),
    (["inspect", "--write-map", "FOLDER"], "is a folder; expected a file to write"),
    (["calibrate", "-o", "FOLDER.yaml"], "is a folder; expected a file to write"),
    (["export", "-o", "FOLDER.csv", "--force"], "is a folder; expected a file to write"),
    (["export", "-o", "."], "is a folder that exists; expected a new name in it"),
    (["plot", "-o", "FOLDER", "--start", "5", "--end", "2"], "expected a start before the end"),
    (["view", "--start", "nan", "-o", "x.html"], "expected a start before the end"),
])  # fmt: skip
def test_an_output_or_span_that_cannot_be_is_refused(
    words: list[str], problem: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    for name in ("FOLDER", "FOLDER.html", "FOLDER.yaml", "FOLDER.csv"):
        (tmp_path / name).mkdir()
    assert main([words[0], "test_2013_steer_blowout", *words[1:]]) == 2
    assert problem in capsys.readouterr().err
    assert not any(path.is_file() for path in tmp_path.rglob("*"))


def test_other_files_in_a_result_folder_do_not_matter(tmp_path: Path) -> None:
    made(tmp_path / "out/notes.txt")
    claim(tmp_path / "out", writes=["report.html"])
    made(tmp_path / "out/report.html")
    with pytest.raises(InputError, match=r"report\.html: exists already"):
        claim(tmp_path / "out", writes=["report.html"])


@pytest.mark.parametrize(("read", "written", "writes"), [
    ("a.csv", "a.csv", ()),
    ("a.csv", "link.csv", ()),
    ("bag", "bag/a.csv", ()),
    ("bag/bag_0.mcap", "bag", ()),
    ("out/vehicle.yaml", "out", ("report.html", "vehicle.yaml")),
])
def test_output_onto_input_is_refused_even_with_force(
    tmp_path: Path, read: str, written: str, writes: tuple[str, ...]
) -> None:
    for name in ("a.csv", "bag/bag_0.mcap", "out/vehicle.yaml"):
        made(tmp_path / name)
    (tmp_path / "link.csv").symlink_to(tmp_path / "a.csv")
    with pytest.raises(InputError, match="onto the input"):
        claim(tmp_path / written, force=True, inputs=[tmp_path / read], writes=writes)


@pytest.mark.parametrize("words", [
    ["diagnose", "-o", "out", "--vehicle", "out/vehicle.yaml"],
    ["calibrate", "-o", "out/vehicle.yaml", "--vehicle", "out/vehicle.yaml"],
])  # fmt: skip
def test_a_vehicle_is_not_written_onto_itself_and_that_is_told_before_any_work(
    words: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    made(tmp_path / "out/vehicle.yaml")
    made(tmp_path / "out/diagnosis.json")
    assert main([words[0], "test_2013_steer_blowout", *words[1:], "--force"]) == 2
    assert "would be written onto the input out/vehicle.yaml" in capsys.readouterr().err
    assert [p.read_text() for p in (tmp_path / "out").iterdir()] == ["kept", "kept"]


def test_a_file_never_replaces_a_folder(tmp_path: Path) -> None:
    made(tmp_path / "results/thesis.txt")
    with pytest.raises(StorageError), replacing(tmp_path / "results") as temporary:
        temporary.write_text("one file")
    assert (tmp_path / "results/thesis.txt").read_text() == "kept"


def test_corrected_recordings_of_one_name_do_not_replace_each_other() -> None:
    taken: set[str] = set()
    for name in ("drive", "drive", "Drive", "drive_2"):
        taken.add(free_name(name, taken).lower())
    assert taken == {"drive", "drive_2", "drive_3", "drive_2_2"}


def test_a_shipped_name_is_no_path_unless_a_file_has_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    target = Path("steer_axle_blowout")
    assert claim(target, inputs=["steer_axle_blowout"]) == target
    made(target)
    with pytest.raises(InputError, match="onto the input steer_axle_blowout"):
        claim(target, force=True, inputs=["steer_axle_blowout"])


def test_a_file_where_a_folder_is_needed_is_refused(tmp_path: Path) -> None:
    made(tmp_path / "out")
    with pytest.raises(InputError, match="is a file; expected a folder"):
        claim(tmp_path / "out", force=True, writes=["report.html"])


def test_json_replaces_the_lines(capsys: pytest.CaptureFixture[str]) -> None:
    say(True, {"a": 1.5}, ["never read"])
    assert json.loads(capsys.readouterr().out) == {"a": 1.5}
    say(False, {}, ["one", "two"])
    assert capsys.readouterr().out == "one\ntwo\n"
