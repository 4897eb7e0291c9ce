"""Every verb that reads logs reads them alike: by name, with a mapping, with blowouts, in parts."""

from __future__ import annotations

import inspect
import json
from collections.abc import Callable
from importlib import import_module
from pathlib import Path

import pytest

from truck_blowout_sim.cli.main import VERBS, main
from truck_blowout_sim.cli.reading import LogOptions, apart_over_roles
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import Recording, read_recording

SHIPPED = "test_2013_steer_blowout"
READING = ("inspect", "import", "export", "compare", "diagnose", "calibrate", "plot", "view")

MAP = """\
channels:
  steering_wheel_angle_rad: {from: Wheel, unit: deg}
  tractor_vx_mps: {from: Speed, unit: km/h}
"""


@pytest.fixture
def log(tmp_path: Path) -> Path:
    """Somebody else's log of a second, without a blowout."""
    rows = "\n".join(f"{0.01 * i:.2f},{i / 10:.1f},72.0" for i in range(100))
    path = tmp_path / "theirs.csv"
    path.write_text(f"Time,Wheel,Speed\n{rows}\n")
    (tmp_path / "map.yaml").write_text(MAP)
    return path


def options(log: Path, *blow: str) -> LogOptions:
    return LogOptions(mapping=log.parent / "map.yaml", blow=blow)


@pytest.mark.parametrize("verb", READING)
def test_verbs_that_read_logs_take_the_same_options(verb: str) -> None:
    command = import_module(f"truck_blowout_sim.cli.{VERBS[verb][0]}").command
    assert {"mapping", "blow", "also", "namespace"} <= set(inspect.signature(command).parameters)


def test_a_blowout_is_marked_where_it_is_seen(log: Path, tmp_path: Path,
                                              capsys: pytest.CaptureFixture[str]) -> None:
    page, words = tmp_path / "seen.html", [str(log), "-m", str(tmp_path / "map.yaml")]
    assert main(["view", *words, "--blow", "steer_left@0.4", "-o", str(page)]) == 0
    assert main(["inspect", *words, "--blow", "steer_left@0.4"]) == 0
    assert "blowout of steer_left at 0.4 s" in capsys.readouterr().out
    assert "steer_left" in page.read_text()
    assert main(["plot", *words, "--blow", "steer_left@7", "-o", str(tmp_path)]) == 2
    assert "expected an instant of theirs, 0 s to 0.99 s" in capsys.readouterr().err


def test_a_blowout_of_the_same_tire_marked_twice_is_refused(
    log: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "marked.csv"
    words = ["export", str(log), "-m", str(tmp_path / "map.yaml"), "-o", str(out), "--blow"]
    assert main([*words, "steer_left@0.4", "--blow", "steer_left@0.5"]) == 2
    assert capsys.readouterr().err.endswith("--blow: steer_left bursts at 0.4 s and again at 0.5 s;"
                                            " expected each tire at most once\n")
    assert not out.exists()
    assert main([*words, "steer_left+steer_left@0.4"]) == 0
    assert read_recording(out).blowouts[0].tires == ("steer_left",)


@pytest.mark.parametrize("folder", ["", "maps"])
def test_a_file_that_the_mapping_names_is_no_output(
    log: Path, tmp_path: Path, folder: str, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / folder).mkdir(exist_ok=True)
    steering, mapping = tmp_path / folder / "steering.csv", tmp_path / folder / "with.yaml"
    steering.write_text("Time,Angle\n0.0,0.0\n0.5,1.0\n0.9,2.0\n")
    mapping.write_text("also: [steering.csv]\n" + MAP.replace("Wheel", "Angle"))
    kept = steering.read_bytes()
    words = ["import", str(log), "-m", str(mapping), "-o", str(steering), "--force"]
    assert main(words) == 2
    assert f"would be written onto the input {steering}" in capsys.readouterr().err
    assert steering.read_bytes() == kept


def test_a_shipped_recording_is_found_by_name(tmp_path: Path,
                                              capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["export", SHIPPED, "-o", str(tmp_path / "test.csv"), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["blowouts"][0]["tires"] == ["steer_left"]
    assert main(["inspect", f"{SHIPPED}s"]) == 2
    assert SHIPPED in capsys.readouterr().err


def test_a_mapping_applies_to_the_runs_that_it_fits(log: Path) -> None:
    ours, theirs = options(log).read_all([SHIPPED, log])
    assert "read under its own names" in ours.notes[-1]
    assert theirs["tractor_vx_mps"].value[0] == pytest.approx(20.0)


def test_a_mapping_applies_to_the_groups_that_it_fits(log: Path) -> None:
    """A run alone in its group, beside runs in other groups, needs no mapping either."""
    (ours,) = options(log).read_all([SHIPPED], among=2)
    assert "read under its own names" in ours.notes[-1]
    (theirs,) = options(log, "steer_left@0.5").read_all([log], among=2)
    assert theirs.blowouts[0].time_s == 0.5


def test_compare_maps_the_runs_that_the_mapping_fits(log: Path, tmp_path: Path,
                                                     capsys: pytest.CaptureFixture[str]) -> None:
    own = tmp_path / "own.csv"
    assert main(["export", str(log), "-m", str(tmp_path / "map.yaml"), "-o", str(own)]) == 0
    words = ["compare", str(own), str(log), "-m", str(tmp_path / "map.yaml"), "--step-s", "0.004"]
    assert main([*words, "-o", str(tmp_path / "out")]) == 0
    assert "does not fit" in capsys.readouterr().out


def test_inspect_counts_the_numbers_of_topics_that_only_show_the_truck(
    log: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    bag = str(tmp_path / "bag")
    assert main(["import", str(log), "-m", str(log.parent / "map.yaml"), "-o", bag]) == 0
    capsys.readouterr()
    assert main(["inspect", bag]) == 0
    shown = capsys.readouterr().out
    assert "numbers, none of them a channel" in shown
    assert "transforms[" not in shown
    assert "odometry:twist.twist.linear.x" in shown
    assert main(["inspect", bag, "--json"]) == 0
    assert "/tf:transforms[0].transform.translation.x" in capsys.readouterr().out


def test_a_mapping_that_fits_none_of_several_is_an_error(
    log: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Though each of them can be read under its own names."""
    for words in (["plot", SHIPPED, SHIPPED], ["calibrate", SHIPPED, "--holdout", SHIPPED],
                  ["diagnose", SHIPPED, "--holdout", SHIPPED]):  # fmt: skip
        words += ["-o", str(tmp_path / "out.yaml")]
        assert main([*words, "-m", str(log.parent / "map.yaml")]) == 2
        assert "no column 'Wheel'" in capsys.readouterr().err.splitlines()[-1]


def test_a_mapping_that_fits_no_run_is_an_error(log: Path) -> None:
    with pytest.raises(InputError, match="no column 'Wheel'"):
        options(log).read_all([SHIPPED])
    log.write_text(log.read_text().replace("Wheel", "Wheels"))
    with pytest.raises(InputError, match="no column 'Wheel'"):
        options(log).read_all([SHIPPED, log])


def test_of_several_runs_those_are_marked_that_mark_nothing(log: Path) -> None:
    ours, theirs = options(log, "steer_right@0.5").read_all([SHIPPED, log])
    assert [b.tires for b in ours.blowouts] == [("steer_left",)]
    assert [(b.tires, b.time_s) for b in theirs.blowouts] == [(("steer_right",), 0.5)]


def test_of_one_run_the_named_tire_is_moved() -> None:
    (ours,) = LogOptions(blow=("steer_left@1.5",)).read_all([SHIPPED])
    assert [(b.tires, b.time_s) for b in ours.blowouts] == [(("steer_left",), 1.5)]


def test_runs_of_one_name_are_told_apart() -> None:
    assert len({run.name for run in LogOptions().read_all([SHIPPED, SHIPPED + ".csv"])}) == 2


def test_runs_of_one_name_in_several_roles_are_told_apart() -> None:
    run = Recording("drive", {})
    groups = [[run, Recording("other", {})], [run]]
    roles = apart_over_roles(groups, [["a/drive.csv", "other.csv"], ["b/drive.csv"]])
    assert [[one.name for one in role] for role in roles] == [
        ["drive (a/drive.csv)", "other"], ["drive (b/drive.csv)"]]


@pytest.mark.parametrize(("read", "said"), [
    (lambda log: LogOptions(also=(log,)).read_all([log, log]), "--also with 2 recordings"),
    (lambda log: options(log, "none").read(log), "--blow 'none'"),
    (lambda log: options(log, "steer_left@soon").read(log), "'soon' is not a number"),
    (lambda log: options(log, "steer_lift@0.1").read(log), "steer_left .the nearest"),
])  # fmt: skip
def test_what_cannot_be_is_one_line(read: Callable[[Path], object], said: str, log: Path) -> None:
    with pytest.raises(InputError, match=said):
        read(log)


def test_a_cars_log_is_mapped_to_its_own_hubs(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """What `inspect --vehicle` writes is what `inspect --map --vehicle` reads."""
    log, mapping = tmp_path / "car.csv", tmp_path / "car.yaml"
    rows = "\n".join(f"{0.01 * k:.2f},{k % 9},80.0,{80 + k % 2}" for k in range(50))
    log.write_text(f"time_s,Steer_SW [deg],Speed [km/h],wheel_speed_rr [km/h]\n{rows}\n",
                   encoding="utf-8")  # fmt: skip
    vehicle = ["--vehicle", "bmw_320i"]
    assert main(["inspect", str(log), *vehicle, "--write-map", str(mapping)]) == 0
    assert "--vehicle bmw_320i" in capsys.readouterr().out
    assert main(["inspect", str(log), *vehicle, "--map", str(mapping)]) == 0
    assert "hub_speed_rear_right_radps" in capsys.readouterr().out
    assert main(["inspect", str(log), "--vehicle", "bmw_32"]) == 2
    assert "bmw_320i" in capsys.readouterr().err
