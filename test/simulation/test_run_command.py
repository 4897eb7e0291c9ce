"""`truck-blowout run` from a terminal: what it writes, what it says, what it refuses."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from truck_blowout_sim.cli.main import main
from truck_blowout_sim.recordings import read_recording


def run(*words: str, cwd: Path, page: bool = False) -> subprocess.CompletedProcess[str]:
    words = words if page else (*words, "--no-page")
    return subprocess.run([sys.executable, "-m", "truck_blowout_sim", "run", *words], cwd=cwd,
                          capture_output=True, text=True, check=False)


def test_it_writes_a_bag_that_reads_back(tmp_path: Path) -> None:
    done = run("fishhook", cwd=tmp_path, page=True)
    assert done.returncode == 0, done.stderr
    assert "burst" in (tmp_path / "fishhook.html").read_text()
    assert "trailer_1_left_outer+trailer_1_left_inner blown at 3.5 s" in done.stdout
    assert "times faster than real time" in done.stdout
    assert done.stderr == ""
    bag = read_recording(tmp_path / "fishhook")
    assert bag.blowouts[0].time_s == pytest.approx(3.5)
    assert bag.metadata["scenario"] == "fishhook"


def test_the_same_run_gives_the_same_bytes(tmp_path: Path) -> None:
    for name in ("a", "b"):
        assert run("brake_stop", "-o", f"{name}/bag", cwd=tmp_path).returncode == 0
    first, second = (next((tmp_path / n / "bag").glob("*.mcap")) for n in "ab")
    assert first.read_bytes() == second.read_bytes()


def test_csv_values_and_blowouts_of_ones_own(tmp_path: Path) -> None:
    done = run("fishhook", "--format", "csv", "-o", "mine", "--set", "steering.ratio=25", "--blow",
               "drive_2_left@2", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    csv = read_recording(tmp_path / "mine.csv")
    assert [(b.time_s, b.tires) for b in csv.blowouts] == [
        (2.0, ("drive_2_left_outer", "drive_2_left_inner"))]


@pytest.mark.parametrize(("words", "line"), [
    (("fishok",), "no scenario of the name 'fishok'"),
    (("fishhook", "--vehicle", "lorry"), "no vehicle of the name 'lorry'"),
    (("fishhook", "--set", "steering.ration=2"), "no parameter 'steering.ration', "
     "did you mean 'steering.ratio'?"),
    (("fishhook", "--set", "trailer_2_left.brake_gain=2"),
     "did you mean 'hub.trailer_2_left.brake_gain'?"),
    (("fishhook", "--set", "mass_kg=1"), "expected one of: unit.tractor.mass_kg, "),
    (("fishhook", "--set", "wrong.key=1"), "expected a name that begins with one of: world, "),
    (("fishhook", "--set", "abs.x=1"), "; expected one of: abs."),
    (("fishhook", "--set", "steering.ratio"), "expected NAME=VALUE"),
    (("fishhook", "--set", "steering.ratio=x"), "'x' is not a number"),
    (("fishhook", "--set", "steering.ratio=nan"), "is out of bounds"),
    (("fishhook", "--set", "steering.ratio=-3"), "--set 'steering.ratio=-3': -3 is out of bounds; "
     "expected above 0"),
    (("fishhook", "--set", "unit.tractor.mass_kg=-9000"), "-9000 is out of bounds"),
    (("fishhook", "--set", "abs.mode=of"), "expected one of: off, slip_threshold"),
    (("fishhook", "--blow", "steer_left"), "expected TIRE@SECONDS"),
    (("fishhook", "--blow", "steer_lef@2"), "did you mean 'steer_left'?"),
    (("fishhook", "--blow", "steer_left@99"), "outside the run"),
    (("fishhook", "--blow", "steer_left@2", "--blow", "steer_left@1"), "blowout steer_left@1: "
     "steer_left bursts at 1 s and again at 2 s; expected each tire at most once"),
    (("fishhook", "--format", "xls"), "expected bag or csv"),
    (("fishhook", "--step-s", "1"), "step_s is 1.0"),
])
def test_bad_usage_is_one_line_and_leaves_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str],
    words: tuple[str, ...], line: str
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["run", *words]) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert line in said
    assert list(tmp_path.iterdir()) == []
