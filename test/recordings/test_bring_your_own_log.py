"""The shipped example logs: read by their mappings, they are the run they were made from."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from truck_blowout_sim.cli.main import main
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import Blowout, Recording, read_recording
from truck_blowout_sim.recordings.mapping.inventory import inspect_log
from truck_blowout_sim.recordings.mapping.writing import mapping_text
from truck_blowout_sim.resources import config_dir

LOGS = config_dir() / "logs"
VBOX, STACK = "vbox_steer_blowout.csv", "stack_steer_blowout"


@pytest.fixture(scope="module")
def read() -> dict[str, Recording]:
    return {name: read_recording(LOGS / name, mapping=LOGS / f"{name.split('.')[0]}.map.yaml")
            for name in (VBOX, STACK)}  # fmt: skip


def test_both_logs_are_one_run(read: dict[str, Recording]) -> None:
    vbox, stack = read[VBOX], read[STACK]
    times = np.arange(0.2, 14.5, 0.05)
    for name, close in (("tractor_vx_mps", 0.1), ("tractor_yaw_rate_radps", 0.004),
                        ("tractor_ay_mps2", 0.25), ("tractor_az_mps2", 0.25),
                        ("steering_wheel_angle_rad", 0.01), ("throttle", 0.01),
                        ("brake_pressure_trailer_pa", 2000.0)):
        np.testing.assert_allclose(vbox.at(name, times), stack.at(name, times), atol=close,
                                   err_msg=name)  # fmt: skip
    for one in read.values():
        assert one.blowouts == (Blowout(4.92, ("steer_left",)),)
        assert one.start_s == pytest.approx(0.0, abs=0.01)


def test_what_the_logs_hold_is_a_truck_that_goes_left_after_the_blowout(
    read: dict[str, Recording],
) -> None:
    stack = read[STACK]
    assert stack["tractor_vx_mps"].value[0] == pytest.approx(23.4, abs=0.2)
    assert stack.at("tractor_yaw_rate_radps", 4.92 + 0.6) > 0.02
    assert abs(stack["tractor_x_m"].value[0]) < 1.0
    assert "tractor_roll_rad" not in stack
    assert stack.at("hub_speed_steer_left_radps", 1.0) == pytest.approx(46.0, rel=0.1)


@pytest.mark.parametrize("name", [VBOX, STACK])
def test_a_mapping_is_begun_from_names_units_and_sizes(
    name: str, read: dict[str, Recording], tmp_path: Path
) -> None:
    found = inspect_log(LOGS / name)
    begun = tmp_path / "begun.yaml"
    begun.write_text(mapping_text(found), encoding="utf-8")
    again = read_recording(LOGS / name, mapping=begun)
    same = {"tractor_vx_mps", "tractor_yaw_rate_radps", "tractor_ay_mps2", "tractor_az_mps2",
            "steering_wheel_angle_rad", "throttle"}  # fmt: skip
    assert same <= set(again.channels)
    for channel in same:
        times = np.arange(0.2, 14.5, 0.1)
        np.testing.assert_allclose(again.at(channel, times), read[name].at(channel, times),
                                   atol=0.05, err_msg=channel)  # fmt: skip
    lines = begun.read_text(encoding="utf-8").splitlines()
    guessed = [line for line in lines if re.match(r"  \w+: \{from", line)]
    assert guessed
    assert all("# GUESS: " in line for line in guessed)


def test_a_mapping_is_begun_for_all_files_of_a_test(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Columns of both files, each with its file, and times whose unit is stated nowhere."""
    times, (a, b) = 0.01 * np.arange(200), (tmp_path / "a.csv", tmp_path / "b.csv")
    rows = zip(times, 80.0 + times, np.sin(times), strict=True)
    a.write_text("Time,Vx,Yaw\n" + "".join(f"{t:.2f},{v:.4f},{y:.4f}\n" for t, v, y in rows))
    rows = zip(times, 30.0 * np.sin(times), times, strict=True)
    b.write_text("Time,Steer_SW,Vx\n" + "".join(f"{t:.2f},{v:.4f},{y:.4f}\n" for t, v, y in rows))
    begun = tmp_path / "begun.yaml"
    assert main(["inspect", str(a), "--also", str(b), "--write-map", str(begun)]) == 0
    assert re.search(r"Steer_SW .* steering_wheel_angle_rad \(guess\)", capsys.readouterr().out)
    text = begun.read_text()
    assert "time: {from: Time, unit: s}  # GUESS: its unit is not stated\nalso:\n" in text
    assert "  - {file: b.csv, time: {from: Time, unit: s}}  # GUESS: its unit" in text
    assert "steering_wheel_angle_rad: {from: Steer_SW, file: b.csv, unit: deg}" in text
    read = read_recording(a, mapping=begun)
    assert set(read.channels) == {"tractor_vx_mps", "tractor_yaw_rad", "steering_wheel_angle_rad"}
    np.testing.assert_allclose(read["tractor_vx_mps"].value, (80.0 + times) / 3.6, atol=1e-4)


def test_a_stated_unit_that_is_not_known_is_left_to_the_user(tmp_path: Path) -> None:
    log, begun = tmp_path / "odd.csv", tmp_path / "begun.yaml"
    rows = "".join(f"{0.05 * k:.2f},60,{k},6\n" for k in range(60))
    log.write_text("Time [fortnights],Speed [km/h],Steer [gon],Brake pressure [kgf/cm2]\n" + rows)
    found = inspect_log(log)
    assert any("the log's unit 'fortnights' is not known here" in note for note in found.notes)
    text = mapping_text(found)
    begun.write_text(text)
    assert "time: {from: Time}  # GUESS: the log's unit 'fortnights' is not known here\n" in text
    assert "  steering_wheel_angle_rad: {from: Steer}  # GUESS: channel from the name; the" in text
    for before, after, asked in (
        ("{from: Time}", "{from: Time, unit: s}", "'fortnights' of time column 'Time'"),
        ("{from: Steer}", "{from: Steer, unit: deg}", "'gon' of column 'Steer'"),
        ('{from: "Brake pressure"}', '{from: "Brake pressure", unit: bar}', "'kgf/cm2' of column"),
    ):
        with pytest.raises(InputError, match=asked):
            read_recording(log, mapping=begun)
        text = text.replace(before, after)
        begun.write_text(text)
    assert read_recording(log, mapping=begun)["brake_pressure_steer_pa"].value[0] == 6e5


def test_a_time_in_long_steps_of_an_unknown_unit_is_not_guessed(tmp_path: Path) -> None:
    log = tmp_path / "slow.csv"
    log.write_text("Time [ticks],Speed [km/h]\n" + "".join(f"{5 * k},60\n" for k in range(60)))
    assert "time: {from: Time}  # GUESS: the log's unit 'ticks'" in mapping_text(inspect_log(log))


def test_inspect_says_it_in_a_table_and_in_json(capsys: pytest.CaptureFixture[str]) -> None:
    mapping = str(LOGS / "vbox_steer_blowout.map.yaml")
    assert main(["inspect", str(LOGS / VBOX), "--map", mapping]) == 0
    shown = capsys.readouterr().out
    assert re.search(r"Speed +km/h +20 .* tractor_vx_mps", shown)
    assert "1 of 9 columns become nothing" in shown
    assert main(["inspect", str(LOGS / VBOX), "--json"]) == 0
    assert '"unused"' in capsys.readouterr().out


@pytest.mark.filterwarnings("error")
def test_inspect_tells_what_a_mapping_would_refuse(tmp_path: Path) -> None:
    path = tmp_path / "odd.csv"
    times = [0.01 * k for k in range(300)]
    times[100], times[200] = 0.5, times[199]
    cells = ["1e300" if k == 50 else "abc" if k == 60 else f"{k % 30}" for k in range(300)]
    path.write_text("time [s],speed [km/h],steering angle [deg]\n" + "".join(
        f"{t:.2f},80,{cell}\n" for t, cell in zip(times, cells, strict=True)))
    notes = "\n".join(inspect_log(path).notes)
    assert "time runs backwards, first from 0.99 s to 0.5 s" in notes
    assert "1 rows share their time with a later one" in notes
    assert "column 'steering angle', line 62: 'abc' is not a number" in notes


def test_rows_without_a_valid_time_are_told(tmp_path: Path) -> None:
    path, rules = tmp_path / "gaps.csv", tmp_path / "map.yaml"
    times = ["inf" if k == 5 else "---" if k == 9 else f"{0.01 * k:.2f}" for k in range(30)]
    path.write_text("time [s],speed [km/h]\n" + "".join(f"{t},80\n" for t in times))
    rules.write_text("channels: {tractor_vx_mps: speed}\n")
    told = "gaps.csv: 2 rows without a valid time left out, the first is line 7: 'inf'"
    inspected = inspect_log(path).notes
    assert told in inspected
    assert not [note for note in inspected if "where a channel takes it" in note]
    read = read_recording(path, mapping=rules)
    assert told in read.notes
    assert len(read["tractor_vx_mps"]) == 28


def test_inspect_refuses_a_wrong_mapping_in_one_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    wrong = tmp_path / "wrong.yaml"
    wrong.write_text("channels: {tractor_vx_mps: {from: Speeed}}")
    assert main(["inspect", str(LOGS / VBOX), "--map", str(wrong)]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert "no column 'Speeed' in the log; expected Speed (the nearest)" in line
