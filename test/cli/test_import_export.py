"""`import`, `export` and `recover` as a user types them."""

from __future__ import annotations

import json
import struct
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from truck_blowout_sim.cli.main import main
from truck_blowout_sim.recordings import read_recording

# A terminal would show a warning beside the lines that are counted here.
pytestmark = [pytest.mark.filterwarnings(f"error::{kind}") for kind in
              ("UserWarning", "RuntimeWarning", "FutureWarning")]

CSV = """# test: by hand
time_s,throttle,blowout,tractor_vx_mps,tire_pressure_steer_left_pa
-0.5,0.3,,20,758423
0,0.3,steer_left,20,758423
0.5,0.3,,19.5,0
"""


@dataclass(frozen=True)
class Done:
    """What a command line left: its status and what it said."""

    returncode: int
    stdout: str
    stderr: str


Cli = Callable[..., Done]


@pytest.fixture
def cli(capsys: pytest.CaptureFixture[str]) -> Cli:
    """Run a command line in this process: starting Python takes longer than the command."""

    def run(*words: str | Path) -> Done:
        capsys.readouterr()
        status = main([str(word) for word in words])
        return Done(status, *capsys.readouterr())

    return run


def typed(*words: str | Path) -> subprocess.CompletedProcess[str]:
    """The same in a process of its own."""
    return subprocess.run([sys.executable, "-m", "truck_blowout_sim", *map(str, words)],
                          capture_output=True, text=True, check=False)  # fmt: skip


@pytest.fixture
def log(tmp_path: Path) -> Path:
    path = tmp_path / "log.csv"
    path.write_text(CSV)
    return path


def test_there_and_back(tmp_path: Path, log: Path) -> None:
    there = typed("import", log, "-o", tmp_path / "bag")
    assert (there.returncode, there.stderr) == (0, "")
    assert "steer_left blown at 0 s" in there.stdout
    back = typed("export", tmp_path / "bag", "-o", tmp_path / "again.csv")
    assert back.returncode == 0
    one, two = read_recording(log), read_recording(tmp_path / "again.csv")
    assert set(one.channels) == set(two.channels)
    for name, series in one.channels.items():
        np.testing.assert_allclose(two[name].value, series.value)
        np.testing.assert_array_equal(two[name].time_s, series.time_s)
    assert one.blowouts == two.blowouts
    assert two.metadata["test"] == "by hand"


def test_a_plain_csv_begins_with_its_header(tmp_path: Path, log: Path, cli: Cli) -> None:
    assert cli("export", log, "-o", tmp_path / "plain.csv", "--plain").returncode == 0
    lines = (tmp_path / "plain.csv").read_text().splitlines()
    assert lines[0] == "time_s,throttle,blowout,tractor_vx_mps,tire_pressure_steer_left_pa"
    assert len(lines) == 4
    assert read_recording(tmp_path / "plain.csv").blowouts == read_recording(log).blowouts


def test_bad_input_is_one_line_and_status_2_and_nothing_is_left(tmp_path: Path, log: Path) -> None:
    log.write_text(CSV.replace("19.5", "nan"))
    done = typed("import", log, "-o", tmp_path / "bag")
    assert done.returncode == 2
    assert done.stdout == ""
    assert len(done.stderr.splitlines()) == 1
    assert "log.csv, line 5, column tractor_vx_mps" in done.stderr
    assert sorted(p.name for p in tmp_path.iterdir()) == ["log.csv"]


@pytest.mark.parametrize(
    "words",
    [
        ("import", "gone.csv", "-o", "bag"),
        ("export", "gone.mcap", "-o", "x.csv"),
        ("recover", "gone.mcap"),
        ("import", "log.csv", "-o", "x.docx"),
        ("import", "log.csv", "-o", "bag", "--map", "gone.yaml"),
        ("import", "log.csv", "-o", "log.csv", "--force"),
        ("import", "log.csv", "-o", "log.csv/bag"),
        ("export", "log.csv", "-o", "/proc/no/such.csv"),
        ("export", "log.csv", "-o", "x.csv", "--thesis-variables"),
        ("export", "log.csv", "-o", "x.mat", "--plain"),
        ("import", "log.csv"),
    ],
)
def test_bad_usage_is_one_line_and_status_2(
    tmp_path: Path, log: Path, cli: Cli, words: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(log.parent)
    done = cli(*words)
    assert done.returncode == 2
    assert len(done.stderr.splitlines()) == 1
    assert sorted(p.name for p in tmp_path.iterdir()) == ["log.csv"]


def test_nothing_that_exists_is_replaced_unless_forced(tmp_path: Path, log: Path, cli: Cli) -> None:
    assert cli("import", log, "-o", tmp_path / "bag").returncode == 0
    kept = {path: path.read_bytes() for path in (tmp_path / "bag").iterdir()}
    again = cli("import", log, "-o", tmp_path / "bag")
    assert (again.returncode, len(again.stderr.splitlines())) == (2, 1)
    assert "--force" in again.stderr
    onto_itself = cli("import", tmp_path / "bag", "-o", tmp_path / "bag", "--force")
    assert onto_itself.returncode == 2
    assert {path: path.read_bytes() for path in (tmp_path / "bag").iterdir()} == kept
    assert cli("import", log, "-o", tmp_path / "bag", "--force").returncode == 0


def test_a_topic_that_is_not_in_the_bag_is_refused_and_the_nearest_named(
    tmp_path: Path, log: Path, cli: Cli
) -> None:
    assert cli("import", log, "-o", tmp_path / "bag").returncode == 0
    rules = tmp_path / "map.yaml"
    rules.write_text("channels: {throttle: {from: '/truck/throtle:data', unit: '%'}}")
    done = cli("import", tmp_path / "bag", "-o", tmp_path / "b", "-m", rules)
    assert done.returncode == 2
    assert "no column '/truck/throtle:data' in the log" in done.stderr
    assert "/truck/throttle:data (the nearest)" in done.stderr
    assert not (tmp_path / "b").exists()


def test_an_unfinished_bag_is_exported_with_a_note_and_recovered(
    tmp_path: Path, log: Path, cli: Cli
) -> None:
    bag = tmp_path / "bag.mcap"
    assert cli("import", log, "-o", bag).returncode == 0
    bag.write_bytes(bag.read_bytes()[:-40])
    done = cli("export", bag, "-o", tmp_path / "out.csv")
    assert done.returncode == 0
    assert "not closed" in done.stderr
    saved = cli("recover", bag)
    assert saved.returncode == 0
    assert "messages" in saved.stdout
    assert cli("export", bag, "-o", tmp_path / "whole.csv").stderr == ""


def test_recover_tells_what_is_lost(tmp_path: Path, log: Path, cli: Cli) -> None:
    bag = tmp_path / "bag.mcap"
    assert cli("import", log, "-o", bag).returncode == 0
    data = bag.read_bytes()
    data_end = data.index(b"\x0f" + struct.pack("<Q", 4))
    begun_chunk = b"\x06" + struct.pack("<Q", 1000) + b"half"
    bag.write_bytes(data[:data_end] + begun_chunk)
    assert "lost: 1 chunk, 13 bytes in all" in cli("recover", bag).stdout


def test_an_imported_bag_shows_the_truck_unless_told_not_to(
    tmp_path: Path, log: Path, cli: Cli
) -> None:
    def topics(*words: str) -> set[str]:
        assert cli("import", log, "-o", tmp_path / "bag", "--force", *words).returncode == 0
        text = (tmp_path / "bag" / "metadata.yaml").read_text()
        return {line.split()[-1] for line in text.splitlines() if " name: /" in line}

    shown = {"/tf", "/tf_static", "/clock", "/truck/robot_description"}
    assert shown <= topics()
    assert not shown & topics("--no-show")
    unfit = cli("import", log, "-o", tmp_path / "other", "--vehicle", "bmw_320i")
    assert unfit.returncode == 2
    assert "blowout of 'steer_left'" in unfit.stderr
    assert not (tmp_path / "other").exists()


def test_a_log_of_a_truck_that_is_not_shipped_is_imported_without_a_model(
    tmp_path: Path, log: Path, cli: Cli
) -> None:
    log.write_text("# tire_names: nose tail\n# hub_names: nose tail\n"
                   + CSV.replace("steer_left", "nose"))  # fmt: skip
    done = cli("import", log, "-o", tmp_path / "bag", "--json")
    assert done.returncode == 0
    assert "--vehicle names one" in json.loads(done.stdout)["shown"][0]
    assert "/tf" not in (tmp_path / "bag" / "metadata.yaml").read_text()
