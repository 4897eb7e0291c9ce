"""A mapping file turns somebody's log into a recording, or says in one line why not."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import scipy.io
import yaml
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import Blowout, Recording, Series, read_recording, write_recording
from truck_blowout_sim.recordings.mapping import load_mapping
from truck_blowout_sim.recordings.mapping.consistency import contradictions
from truck_blowout_sim.recordings.mapping.finish import at_base_link, with_local_origin
from truck_blowout_sim.recordings.mapping.plausible import reads_like
from truck_blowout_sim.recordings.mapping.rules import Mount
from truck_blowout_sim.recordings.units import find_unit

IN_TMP = settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=60)
N = 101
HEAD = "Time [ms],Speed [km/h],Steer,YawRate [deg/s],Roll [deg]\n"


@pytest.fixture
def log(tmp_path: Path) -> Path:
    path = tmp_path / "log.csv"
    rows = (f"{10 * i},{80 + 0.1 * i},{-i},{0.1 * i},1.5\n" for i in range(N))
    path.write_text(HEAD + "".join(rows))
    return path


def rules(log: Path, tree: dict[str, Any]) -> Path:
    path = log.parent / "map.yaml"
    path.write_text(yaml.safe_dump(tree))
    return path


def channels(**changed: object) -> dict[str, Any]:
    made = {"steering_wheel_angle_rad": {"from": "Steer", "unit": "deg", "sign": -1, "offset": 2},
            "tractor_vx_mps": {"from": "Speed"}}  # fmt: skip
    return {"channels": {**made, **changed}}


def refusal(log: Path, tree: dict[str, Any]) -> str:
    with pytest.raises(InputError) as caught:
        read_recording(log, mapping=rules(log, tree))
    assert "\n" not in str(caught.value)
    return str(caught.value)


def test_unit_sign_and_offset(log: Path) -> None:
    read = read_recording(log, mapping=rules(log, channels()))
    np.testing.assert_allclose(read["tractor_vx_mps"].value, (80 + 0.1 * np.arange(N)) / 3.6)
    steer = read["steering_wheel_angle_rad"]
    np.testing.assert_allclose(steer.value, np.radians(np.arange(N) - 2.0))
    np.testing.assert_allclose(steer.time_s, 0.01 * np.arange(N))
    assert any("2 unused columns: YawRate, Roll" in note for note in read.notes)


def test_shifts_blowouts_exclusions_and_metadata(log: Path) -> None:
    tree = channels(tractor_roll_rad={"from": "Roll"}) | {
        "shift_s": {"Steer": -0.2}, "exclude": ["tractor_roll_rad"],
        "blowouts": [{"tire": "steer_left", "at_s": 0.5}], "metadata": {"test": "mine"},
    }  # fmt: skip
    read = read_recording(log, mapping=rules(log, tree), blow=[Blowout(0.7, ("steer_right",))])
    assert read["steering_wheel_angle_rad"].time_s[0] == pytest.approx(-0.2)
    assert read["tractor_vx_mps"].time_s[0] == 0.0
    assert read.blowouts == (Blowout(0.5, ("steer_left",)), Blowout(0.7, ("steer_right",)))
    assert "tractor_roll_rad" not in read
    assert read.metadata["test"] == "mine"
    moved = read_recording(log, mapping=rules(log, tree), blow=[Blowout(0.6, ("steer_left",))])
    assert moved.blowouts == (Blowout(0.6, ("steer_left",)),)


@pytest.mark.parametrize(("tree", "words"), [
    (channels(tractor_vx_mps={"from": "Sped"}), "no column 'Sped' in the log; expected Speed"),
    (channels(tractor_vx={"from": "Speed"}), "no channel 'tractor_vx'; expected tractor_vx_mps"),
    (channels(tractor_vx_mps={"from": "Speed", "unit": "deg"}), "is one of angle"),
    (channels(tractor_vx_mps={"from": "Speed", "unit": "kmm/h"}), "unknown unit 'kmm/h'"),
    (channels(tractor_vx_mps={"from": "Speed", "unit": "m/s"}), "reads like km/h"),
    (channels(tractor_yaw_rate_radps={"from": "YawRate", "unit": "rad/s"}), "reads like deg/s"),
    (channels(throttle={"from": "Steer", "unit": "%", "sgn": 1}), "unknown key; expected sign"),
    (channels(steering_wheel_angle_rad={"from": "Steer"}), "no unit is stated"),
    (channels(steering_wheel_angle_rad={"from": "Steer", "unit": "deg", "sign": 2}), "1 or -1"),
    (channels(hub_speed_frnt_left_radps={"from": "Steer", "unit": "rpm"}), "unknown hub"),
    (channels() | {"exclude": ["tractor_rol_rad"]}, "is not recorded"),
    (channels() | {"blowouts": [{"tire": "steer_lft", "at_s": 0.5}]}, "expected steer_left"),
    (channels() | {"blowouts": [{"tire": "steer_left", "at_s": 50}]}, "expected an instant"),
    (channels() | {"blowouts": [{"tire": "steer_left", "at_s": at_s} for at_s in (0.5, 0.3)]},
     "key blowouts: steer_left bursts at 0.3 s and again at 0.5 s; expected each tire at most"),
    (channels() | {"time": {"from": "Tme"}}, "no column 'Tme'"),
    (channels() | {"time": {"from": "Steer", "unit": "s"}}, "do not run backwards"),
    (channels() | {"also": ["gone.csv"]}, "gone.csv: no such file"),
    (channels() | {"shift_s": {"Speeed": 0.1}}, "shift_s.Speeed: no file, and no column or topic"
     " that the mapping takes; expected Speed (the nearest)"),
    (channels() | {"shift_s": {"Roll": 0.1}}, "shift_s.Roll"),
    (channels() | {"sensors": {"cab": {}}}, "expected tractor, trailer"),
    ({"chanels": {}}, "unknown key; expected channels"),
    ({}, "no column becomes a channel"),
])  # fmt: skip
def test_what_is_wrong_is_named_with_what_is_near(
    log: Path, tree: dict[str, Any], words: str
) -> None:
    assert words in refusal(log, tree)


@pytest.mark.parametrize(("text", "key"), [
    ("channels:\n  throttle: {from: A}\n  throttle: {from: B}\n", "channels.throttle"),
    ("channels: {}\nchannels: {}\n", "channels"),
    ("also:\n  - {file: a.csv, file: b.csv}\n", "also.1.file"),
])  # fmt: skip
def test_a_key_that_stands_there_twice_is_refused(log: Path, text: str, key: str) -> None:
    path = log.parent / "map.yaml"
    path.write_text(text)
    with pytest.raises(InputError, match=f"map.yaml, key {key}: stands there twice"):
        read_recording(log, mapping=path)


def test_a_bad_cell_of_a_used_column_is_named_with_its_line(log: Path) -> None:
    log.write_text(log.read_text().replace("80.5,", "8o.5,"))
    assert "line 7: '8o.5'" in refusal(log, channels())


@pytest.mark.parametrize(("cell", "words"), [
    ("", "column 'Steer' is empty in the log; expected numbers"),
    ("abc", "column 'Steer' holds text in the log"),
])  # fmt: skip
def test_a_column_without_numbers_is_not_said_to_be_missing(
    log: Path, cell: str, words: str
) -> None:
    log.write_text(HEAD + "".join(f"{10 * i},80,{cell},0,1.5\n" for i in range(N)))
    assert words in refusal(log, channels())


@pytest.mark.parametrize("cell", ["inf", "-Inf", "1e999"])
def test_what_no_instrument_measures_is_refused_like_text(log: Path, cell: str) -> None:
    log.write_text(log.read_text().replace("80.5,", f"{cell},"))
    assert f"column 'Speed', line 7: '{cell}'" in refusal(log, channels())


@pytest.mark.parametrize("cell", ["1e300", "9000"])
def test_one_absurd_cell_is_no_matter_of_units(log: Path, cell: str) -> None:
    rows = "".join(f"{10 * i},80,{cell if i == 200 else 20 * math.sin(i)},0,1\n"
                   for i in range(400))  # fmt: skip
    log.write_text(HEAD + rows)
    words = refusal(log, channels())
    assert f"{float(cell):g} deg at 2 s is beyond what a truck can do, unlike the other" in words
    assert "unit" not in words


def test_an_absurd_reading_of_an_instrument_is_left_out(log: Path) -> None:
    rows = "".join(f"{10 * i},{9000 if i == 200 else 80},0,0,1\n" for i in range(400))
    log.write_text(HEAD + rows)
    recording = read_recording(log, mapping=rules(log, channels()))
    assert len(recording.channels["tractor_vx_mps"]) == 399
    assert any("1 of 400 readings are left out as impossible (the first: 2500 m/s at 2 s)" in note
               for note in recording.notes)  # fmt: skip


def test_a_unit_is_suggested_only_where_all_numbers_fit_it() -> None:
    numbers = np.append(30.0 * np.sin(np.arange(300.0)), np.full(5, 1e300))
    unit = find_unit("rad")
    assert unit is not None
    assert not reads_like(numbers, "angle", "steering_wheel_angle_rad", unit)
    assert reads_like(numbers[:300], "angle", "steering_wheel_angle_rad", unit) == "deg"


def test_another_unit_than_the_log_states_is_told(log: Path) -> None:
    tree = channels(tractor_vx_mps={"from": "Speed", "unit": "mph"})
    tree["time"] = {"from": "Time", "unit": "s"}
    notes = read_recording(log, mapping=rules(log, tree)).notes
    assert "column 'Speed' is taken in mph, as the mapping says; the log states km/h" in notes
    assert any("column 'Time' is taken in s, as the mapping says; the log states ms" in note
               for note in notes)  # fmt: skip
    assert not any("states" in note for note in read_recording(log, mapping=rules(log, channels())
                                                               ).notes)  # fmt: skip


def test_our_own_csv_is_read_beside_a_mapping_without_a_word_on_its_blowouts(tmp_path: Path
                                                                             ) -> None:  # fmt: skip
    path = tmp_path / "own.csv"
    path.write_text("time_s,blowout,tractor_vx_mps\n0,,20\n0.1,steer_left,20\n0.2,,20\n")
    read = read_recording(path, mapping=rules(path, {"metadata": {"test": "mine"}}))
    assert read.blowouts == (Blowout(0.1, ("steer_left",)),)
    assert not any("blowout" in note for note in read.notes)


def test_a_second_file_brings_the_steering_to_the_thesis_s_mat(tmp_path: Path) -> None:
    time_s = np.round(-4.92 + 0.01 * np.arange(1499), 9)[:, None]
    scipy.io.savemat(tmp_path / "exp.mat", {
        "time_e": time_s, "vx_e": np.full((1499, 1), 55.0), "yaw_e": np.full((1499, 1), -2.5),
        "vx_h": np.full((1499, 1), 54.0)})  # fmt: skip
    (tmp_path / "steer.csv").write_text(
        "t [s];wheel [deg]\n" + "".join(f"{-4.9 + 0.02 * i:.2f};{i / 10}\n" for i in range(700)))
    tree = {"also": ["steer.csv"],
            "channels": {"steering_wheel_angle_rad": {"from": "wheel", "unit": "deg"}}}
    mapping = rules(tmp_path / "exp.mat", tree)
    read = read_recording(tmp_path / "exp.mat", mapping=mapping)
    assert set(read.channels) == {
        "steering_wheel_angle_rad", "tractor_vx_mps", "tractor_yaw_rate_radps"}
    assert read.at("steering_wheel_angle_rad", [0.1]) == pytest.approx(math.radians(25.0))
    assert read.blowouts == (Blowout(0.0, ("steer_left",)),)
    hve = read_recording(tmp_path / "exp.mat", mapping=mapping, source="hve")
    assert hve["tractor_vx_mps"].value[0] == pytest.approx(54.0 * 0.44704)


def test_further_files_may_come_one_at_a_time(log: Path, tmp_path: Path) -> None:
    """An iterator is used up by looking into it."""
    path = tmp_path / "own.csv"
    path.write_text("time_s,tractor_vx_mps\n0,20\n0.1,20\n0.2,20\n")
    (tmp_path / "b.csv").write_text("time_s,throttle\n0,0.5\n0.1,0.5\n0.2,0.5\n")
    assert "throttle" in read_recording(path, also=iter([tmp_path / "b.csv"]))
    with pytest.raises(InputError, match="no such file"):
        read_recording(path, also=iter([tmp_path / "absent.csv"]))


def test_files_on_absolute_clocks_are_laid_on_the_first_ones(log: Path) -> None:
    rows = "".join(f"2024-02-01 12:00:{0.01 * i:06.3f},{80 + 0.1 * i}\n" for i in range(N))
    log.write_text("time,Speed [km/h]\n" + rows)
    rows = "".join(f"2024-02-01 12:00:{0.5 + 0.01 * i:06.3f},{i}\n" for i in range(N))
    (log.parent / "steer.csv").write_text("time,Steer [deg]\n" + rows)
    read = read_recording(log, mapping=rules(log, channels() | {"also": ["steer.csv"]}))
    assert read["tractor_vx_mps"].time_s[0] == 0.0
    assert read["steering_wheel_angle_rad"].time_s[0] == pytest.approx(0.5)
    assert float(read.metadata["clock_start_s"]) == pytest.approx(1706788800.0)
    assert any("time 0 is 1706788800.000 s on the clock of" in note for note in read.notes)


@pytest.mark.parametrize(("stamp", "words"), [
    ("12:00:{:06.3f}", "the clocks of steer.csv and log.csv cannot be compared, only log.csv has"
     " a date: its time is taken to begin with that of log.csv"),
    ("2024-02-04 12:00:{:06.3f}", "steer.csv begins 259200 s from log.csv"),
    ("{:.3f}", "steer.csv has a clock of its own"),
])  # fmt: skip
def test_clocks_that_cannot_be_compared_are_told(log: Path, stamp: str, words: str) -> None:
    rows = "".join(f"{0.01 * i:.2f},{20 + 0.1 * i}\n" for i in range(N))
    log.write_text("# clock_start_s: 1706788800.0\ntime_s,tractor_vx_mps\n" + rows)
    rows = "".join(f"{stamp.format(0.01 * i)},{i}\n" for i in range(N))
    (log.parent / "steer.csv").write_text("time,Steer [deg]\n" + rows)
    tree = {"also": ["steer.csv"], "channels": {"steering_wheel_angle_rad": {"from": "Steer"}}}
    read = read_recording(log, mapping=rules(log, tree))
    assert [note for note in read.notes if words in note]
    assert read["steering_wheel_angle_rad"].time_s[0] == 0.0


def test_clocks_that_may_be_of_two_time_zones_are_told(log: Path) -> None:
    for name, hour, head in (("log.csv", 12, "Speed [km/h]"), ("steer.csv", 14, "Steer [deg]")):
        rows = "".join(f"2024-02-01 {hour}:00:{0.01 * i:06.3f},{80 + 0.1 * i}\n" for i in range(N))
        (log.parent / name).write_text(f"time,{head}\n{rows}")
    read = read_recording(log, mapping=rules(log, channels() | {"also": ["steer.csv"]}))
    assert any("steer.csv begins 7200 s after log.csv by their clocks" in n for n in read.notes)


def test_a_column_beside_channels_that_are_named_stays_on_their_clock(log: Path) -> None:
    rows = "".join(f"{0.01 * i:.2f},{20 + 0.1 * i},{i}\n" for i in range(N))
    log.write_text("# clock_start_s: 1706788800.0\ntime_s,tractor_vx_mps,Steer\n" + rows)
    tree = {"channels": {"steering_wheel_angle_rad": {"from": "Steer", "unit": "deg"}}}
    read = read_recording(log, mapping=rules(log, tree))
    assert read["steering_wheel_angle_rad"].time_s[0] == read["tractor_vx_mps"].time_s[0] == 0.0


def test_an_instrument_off_base_link_is_moved_there() -> None:
    time_s = np.arange(200) / 100
    turn = np.full(200, 0.2)
    at_sensor = {"tractor_yaw_rate_radps": turn, "tractor_vx_mps": np.full(200, 20.0),
                 "tractor_vy_mps": 0.2 * np.full(200, -1.2), "tractor_ax_mps2": 1.2 * turn**2}
    made = Recording("turn", {n: Series(time_s, v) for n, v in at_sensor.items()})
    moved = at_base_link(made, {"tractor": Mount(x_m=-1.2)})
    np.testing.assert_allclose(moved["tractor_vy_mps"].value, 0.0, atol=1e-12)
    np.testing.assert_allclose(moved["tractor_ax_mps2"].value, 0.0, atol=1e-12)
    assert "moved" in moved.notes[0]


def test_coordinates_of_the_earth_get_a_local_origin(tmp_path: Path) -> None:
    time_s = np.arange(20) / 10
    made = Recording("utm", {"tractor_x_m": Series(time_s, 5e5 + time_s),
                             "tractor_y_m": Series(time_s, 4.2e6 - time_s)})  # fmt: skip
    local = with_local_origin(made)
    np.testing.assert_allclose(local["tractor_x_m"].value, time_s, atol=1e-6)
    assert local.metadata["map_origin_m"] == "500000 4200000"
    assert read_recording(write_recording(made, tmp_path / "utm.csv")).metadata["map_origin_m"]


@pytest.mark.parametrize(("factors", "words"), [
    ({}, ()),
    ({"tractor_yaw_rate_radps": math.pi / 180}, ("yaw_rate_radps is 0.0175 times", "for deg")),
    ({"tractor_vx_mps": 1 / 3.6}, ("m/s taken for km/h",)),
    ({"tractor_ay_mps2": 1 / 9.80665}, ("g taken for m/s2",)),
    ({"tractor_yaw_rad": 57.3}, ("the heading reads like deg taken for rad",)),
    ({"tractor_yaw_rad": -1.0}, ("yaw_rate_radps is -1 times what yaw_rad says: reads like the"
                                 " opposite sign",)),
    ({"tractor_yaw_rate_radps": 57.3}, ("the yaw rate reads like deg/s taken for rad/s",
                                        "times what the turning of its path says")),
    ({"tractor_x_m": 1 / 0.3048, "tractor_y_m": 1 / 0.3048}, ("position reads like ft taken",)),
    ({"tractor_x_m": 1e-3, "tractor_y_m": 1e-3}, ("position reads like km taken for m",)),
    ({"tractor_az_mps2": 0.01}, ("accelerometers: gravity removed",)),
    ({"tractor_az_mps2": -1.0}, ("tractor_az_mps2 is -1 times what gravity says",)),
])  # fmt: skip
def test_a_wrong_unit_shows_against_the_other_channels(
    factors: dict[str, float], words: tuple[str, ...]
) -> None:
    time_s = np.arange(0, 20, 0.02)
    rate, speed = 0.1 * np.cos(0.5 * time_s), 20.0
    yaw = 0.2 * np.sin(0.5 * time_s)
    made = {"tractor_yaw_rad": yaw, "tractor_yaw_rate_radps": rate,
            "tractor_vx_mps": np.full(time_s.size, speed), "tractor_ay_mps2": speed * rate,
            "tractor_az_mps2": np.full(time_s.size, 9.81),
            "tractor_x_m": np.cumsum(speed * np.cos(yaw)) * 0.02,
            "tractor_y_m": np.cumsum(speed * np.sin(yaw)) * 0.02}  # fmt: skip
    drive = Recording("drive", {n: Series(time_s, factors.get(n, 1.0) * v)
                                for n, v in made.items()})  # fmt: skip
    said = " | ".join(contradictions(drive))
    assert all(word in said for word in words)
    assert bool(said) == bool(words)


@pytest.mark.parametrize(("factors", "words"), [
    ({}, ""), ({"tractor_vx_mps": 1 / 1.609}, "the speed reads like mph taken for km/h"),
    ({"tractor_vx_mps": 1.609}, "the speed reads like km/h taken for mph"),
    ({"tractor_vx_mps": 2.237}, "the speed reads like mph taken for m/s"),
    ({"tractor_ax_mps2": 9.81}, "tractor_ax_mps2 is 10.8 times what its change of speed says"),
    ({"tractor_ax_mps2": -1.0}, "reads like the opposite sign"),
])  # fmt: skip
def test_a_stop_shows_a_speed_in_another_unit(factors: dict[str, float], words: str) -> None:
    """As on a slope of 3 %, with a nose that dives."""
    time_s = np.arange(0, 10, 0.02)
    along = np.where(time_s > 3.0, -2.0 * np.sin(0.4 * (time_s - 3.0)), 0.0)
    made = {"tractor_vx_mps": 22.0 + 0.02 * np.cumsum(along), "tractor_ax_mps2": 1.1 * along + 0.3}
    drive = Recording("stop", {n: Series(time_s, factors.get(n, 1.0) * v)
                               for n, v in made.items()})  # fmt: skip
    said = " | ".join(contradictions(drive))
    assert words in said
    assert bool(said) == bool(words)


def test_a_spin_is_no_speed_in_another_unit() -> None:
    """A body that goes straight on, braked by 4 m/s2 from 25 m/s while it turns by 70 deg."""
    time_s = np.arange(0, 10, 0.02)
    brakes = np.where(time_s > 4.0, 4.0, 0.0)
    speed, yaw = 25.0 - 0.02 * np.cumsum(brakes), 1.2 * np.clip((time_s - 4.0) / 4.0, 0.0, 1.0) ** 2
    made = {"tractor_vx_mps": speed * np.cos(yaw), "tractor_vy_mps": -speed * np.sin(yaw),
            "tractor_yaw_rate_radps": np.gradient(yaw, time_s),
            "tractor_ax_mps2": -brakes * np.cos(yaw)}  # fmt: skip
    drive = Recording("spin", {n: Series(time_s, v) for n, v in made.items()})
    assert contradictions(drive) == ()
    unseen = drive.only_channels([n for n in made if n != "tractor_vy_mps"])
    assert contradictions(unseen) != (), "only the side velocity tells"


def test_tire_pressures_in_psi_are_not_said_to_be_kpa() -> None:
    bar = find_unit("bar")
    assert bar is not None
    assert reads_like(np.full(9, 110.0), "pressure", "tire_pressure_steer_left_pa", bar) == "psi"


@IN_TMP
@given(st.recursive(
    st.one_of(st.none(), st.booleans(), st.floats(), st.integers(), st.text(max_size=8),
              st.sampled_from(["Speed", "deg", "Steer", "steer_left"])),
    lambda inner: st.one_of(st.lists(inner, max_size=3), st.dictionaries(st.sampled_from(
        ["time", "channels", "from", "unit", "also", "blowouts", "tire", "at_s", "shift_s", "file",
         "tractor_vx_mps", "sensors", "tractor", "x_m", "exclude", "sign", "offset"]),
        inner, max_size=4)), max_leaves=12))
def test_any_tree_is_a_mapping_or_one_line(log: Path, tree: object) -> None:
    path = log.parent / "any.yaml"
    path.write_text(yaml.safe_dump(tree))
    line = ""
    try:
        read_recording(log, mapping=path)
    except InputError as error:
        line = str(error)
    assert "\n" not in line


@IN_TMP
@given(st.one_of(st.text(max_size=60).map(str.encode), st.binary(max_size=60)))
def test_any_bytes_are_a_mapping_or_one_line(log: Path, data: bytes) -> None:
    path = log.parent / "any.yaml"
    path.write_bytes(data)
    line = ""
    try:
        load_mapping(path)
    except InputError as error:
        line = str(error)
    assert "\n" not in line
