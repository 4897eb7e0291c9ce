"""The verb as a terminal user meets it."""

from __future__ import annotations

import json
import runpy
from pathlib import Path
from types import SimpleNamespace
from typing import cast
from unittest.mock import patch

import numpy as np
import pytest
import scipy.io
from rich.console import Console

from truck_blowout_sim import load_vehicle, simulate, write_recording
from truck_blowout_sim.cli.compare import _folders, _print
from truck_blowout_sim.cli.main import main
from truck_blowout_sim.comparison import Comparison
from truck_blowout_sim.recordings import Recording, read_recording
from truck_blowout_sim.recordings.shipped import find_recording

SUM_UP = Path(__file__).parents[2] / "scripts" / "sum_up_comparison.py"
TEST_2013 = "test_2013_steer_blowout"


def complaint(captured: str) -> str:
    lines = [line for line in captured.splitlines() if line.strip()]
    assert len(lines) == 1
    return lines[0]


def test_a_shipped_record_is_compared_by_its_name(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["compare", TEST_2013, "-o", str(tmp_path / "out")]) == 0
    shown = capsys.readouterr()
    assert "yaw rate of the tractor" in shown.out
    assert "rebuilt from the thesis" in shown.out
    assert "report.html" in shown.out
    assert json.loads((tmp_path / "out" / "comparison.json").read_text())["recording"] == TEST_2013
    assert (tmp_path / "out" / "figures" / "yaw_rate_tractor.png").is_file()


def test_a_comparison_is_summed_up_by_its_worst_and_best_channels() -> None:
    def channel(rating: float | None, *, imposed: bool = False) -> dict[str, object]:
        return {"label": f"channel {rating}", "imposed": imposed,
                "display": {"unit": "deg", "rms": 1.0 - (rating or 0.0)},
                "iso_18571": None if rating is None else {"overall": rating}}

    ratings = [0.9, 0.5, None, 0.99, 0.7, 0.6, 0.95]
    channels = {f"c{n}": channel(rating) for n, rating in enumerate(ratings)}
    channels["held"] = channel(0.1, imposed=True)
    lines = runpy.run_path(str(SUM_UP))["lines"]({"channels": channels})
    assert lines[0] == "8 channels compared, 6 rated by ISO/TS 18571, mean 0.773 (1: equal)"
    assert [line.split(",")[0].split("channel ")[1] for line in lines[1:]] == [
        "0.5", "0.6", "0.7", "0.99", "0.95"]
    assert lines[1] == "worst  0.500  channel 0.5, rms error 0.5 deg"


def test_each_channel_of_a_full_recording_is_one_line_in_a_pipe(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    run = simulate(load_vehicle("rigid_truck"), "coast_down").between(0.0, 1.5)
    write_recording(run, tmp_path / "run.csv")
    assert main(["compare", str(tmp_path / "run.csv"), "-o", str(tmp_path / "out")]) == 0
    shown = capsys.readouterr().out
    labels = [line.split("  ")[0] for line in shown.splitlines()]
    assert "specific force to the left of the tractor" in labels


def test_the_thesis_s_analysis_runs_with_steering_from_a_second_file(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    record = read_recording(find_recording(TEST_2013)).between(-1.0, 2.0)
    time_s = record["tractor_vx_mps"].time_s
    speed, rate = record["tractor_vx_mps"].value, record["tractor_yaw_rate_radps"].value
    scipy.io.savemat(tmp_path / "exp.mat", {
        "time_e": time_s, "vx_e": speed / 0.44704, "yaw_e": -np.degrees(rate),
        "vx_h": speed / 0.44704, "yaw_h": -0.5 * np.degrees(rate)})  # fmt: skip
    turned = np.degrees(record.at("steering_wheel_angle_rad", time_s))
    rows = (f"{t:.2f},{angle:.4f}\n" for t, angle in zip(time_s, turned, strict=True))
    (tmp_path / "steering.csv").write_text("t [s],handwheel [deg]\n" + "".join(rows))
    (tmp_path / "map.yaml").write_text(
        "also: [steering.csv]\nchannels: {steering_wheel_angle_rad: {from: handwheel}}")
    words = ["compare", str(tmp_path / "exp.mat"), "-m", str(tmp_path / "map.yaml"), "--hve",
             "--step-s", "0.004", "-o", str(tmp_path / "out")]  # fmt: skip
    assert main(words) == 0
    assert "exp (HVE)" in capsys.readouterr().out
    held = json.loads((tmp_path / "out/hve/comparison.json").read_text())
    assert held["recording"] == "exp"
    assert main(words) == 2
    assert "--force" in capsys.readouterr().err


def test_what_hve_cannot_be_read_from_is_refused_before_anything_is_written(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["compare", TEST_2013, "--hve", "-o", str(tmp_path / "out")]) == 2
    assert "a .mat with the thesis's variables" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (["no_such_run.csv"], f"no such file or folder: 'no_such_run.csv'; .*{TEST_2013}"),
        ([TEST_2013, "--vehicle", "no_such_truck"], "no_such_truck"),
        ([TEST_2013, "--step-s", "1"], "--step-s"),
        ([TEST_2013, "--vehicle", "ferrari_250lm"], "steer_left"),
    ],
)
def test_bad_input_is_one_line_and_status_two(
    words: list[str], expected: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    import re

    assert main(["compare", *words, "-o", str(tmp_path / "out")]) == 2
    assert re.search(expected, complaint(capsys.readouterr().err))
    assert not (tmp_path / "out").exists()


def test_a_broken_csv_names_its_place(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    bad = tmp_path / "bad.csv"
    bad.write_text("time_s,steering_wheel_angle_rad,tractor_vx_mps\n0,0,20\n0.01,nan?,20\n")
    assert main(["compare", str(bad), "-o", str(tmp_path / "out")]) == 2
    line = complaint(capsys.readouterr().err)
    assert "bad.csv" in line
    assert "line 3" in line


def test_several_recordings_get_a_folder_each(tmp_path: Path) -> None:
    assert _folders(["a.csv"], tmp_path) == [tmp_path]
    found = _folders(["runs/a.csv", "b/", "other/a.mcap", "more/a"], tmp_path)
    assert [folder.name for folder in found] == ["a", "b", "a_2", "a_3"]
    met = _folders(["run_2.csv", "run.csv", "more/run.csv", "Run.csv"], tmp_path)
    assert [folder.name for folder in met] == ["run_2", "run", "run_3", "Run_4"]


def test_brackets_in_names_and_notes_are_shown_and_no_styles(
    capsys: pytest.CaptureFixture[str],
) -> None:
    compared = SimpleNamespace(
        recording=Recording("run [/] [red]", {}), channels=(), notes=("column [bold] was left",))
    with patch("truck_blowout_sim.comparison.verdict", lambda _: "as [dim] says"):
        _print(Console(width=200), cast(Comparison, compared), Path("out[/b]/report.html"))
    shown = capsys.readouterr().out
    for text in ("run [/] [red]: as [dim] says", "note: column [bold] was left",
                 "out[/b]/report.html"):
        assert text in shown
