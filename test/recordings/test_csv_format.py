"""CSV: exact round trips, and one clear line for everything that is wrong."""

from __future__ import annotations

import string
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import (
    Blowout,
    Recording,
    Series,
    by_name,
    channels_for,
    read_recording,
    write_recording,
)
from truck_blowout_sim.recordings.formats import read_native

IN_TMP = settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
HEADER = "time_s,throttle,tractor_vx_mps"


def parse(tmp_path: Path, text: str | bytes) -> Recording:
    path = tmp_path / "log.csv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return read_recording(path)


def refusal(tmp_path: Path, text: str | bytes) -> str:
    """The error's line, empty if the text was accepted; any other exception passes."""
    try:
        parse(tmp_path, text)
    except InputError as error:
        return str(error)
    return ""


def test_a_file_as_the_interface_describes_it(tmp_path: Path) -> None:
    recording = parse(
        tmp_path,
        "# test: by hand\n# accelerometers: gravity removed\n# a remark\n"
        "time_s,steering_wheel_angle_rad,blowout,tractor_vx_mps\n"
        "-0.01,0.1,,20\n0.00,,steer_left+drive_1_left_outer,20.5\n0.01,0.3,,\n",
    )
    assert recording.name == "log"
    assert dict(recording.metadata) == {"test": "by hand", "accelerometers": "gravity removed"}
    assert recording["steering_wheel_angle_rad"].time_s.tolist() == [-0.01, 0.01]
    assert recording["tractor_vx_mps"].value.tolist() == [20.0, 20.5]
    assert recording.blowouts == (Blowout(0.0, ("steer_left", "drive_1_left_outer")),)


def test_a_file_without_a_number_is_refused(tmp_path: Path) -> None:
    assert "log.csv: holds no numbers" in refusal(tmp_path, f"{HEADER}\n0,,\n1,,\n")


def test_round_trip_is_exact(tmp_path: Path, full_recording: Recording) -> None:
    again = read_recording(write_recording(full_recording, tmp_path / "full.csv"))
    assert dict(again.channels) == dict(full_recording.channels)
    assert again.blowouts == full_recording.blowouts
    assert dict(again.metadata) == dict(full_recording.metadata)


@IN_TMP
@given(data=st.data())
def test_any_recording_survives(tmp_path: Path, data: st.DataObject) -> None:
    table = by_name(c for c in channels_for())
    names = data.draw(st.lists(st.sampled_from(sorted(table)), min_size=1, max_size=4, unique=True))
    channels = {}
    for name in names:
        ticks = data.draw(st.lists(st.integers(-500, 2000), min_size=1, max_size=20, unique=True))
        low, high = table[name].lowest, table[name].highest
        values = [data.draw(st.floats(low, high)) for _ in ticks]
        channels[name] = Series(np.array(sorted(ticks)) / 100, np.array(values))
    recording = Recording("any", channels)
    again = read_native(write_recording(recording, tmp_path / "any.csv"))
    assert dict(again.channels) == channels


def test_another_vehicle_s_names_are_declared_in_the_file(tmp_path: Path) -> None:
    series = Series(np.array([0.0, 1.0]), np.array([2e5, 2e5]))
    recording = Recording("car", {"tire_pressure_front_left_pa": series},
                          (Blowout(0.5, ("front_left",)),))  # fmt: skip
    path = write_recording(recording, tmp_path / "car.csv")
    again = read_recording(path)
    assert again["tire_pressure_front_left_pa"] == series
    assert again.blowouts == recording.blowouts


@pytest.mark.parametrize(
    ("text", "place", "words"),
    [
        ("", "line 1", "is empty"),
        ("\n\n", "line", "is empty"),
        ("# only: comments\n", "line", "no header"),
        (HEADER + "\n", "line 1", "no rows"),
        ("a,b,c\n1,2,3\n", "line 1", "time_s"),
        (f"{HEADER}\n0,0.1,20\n0.01,0.1\n", "line 3", "cut short"),
        (f"{HEADER}\n0,0.1\n0.01,0.1,20\n", "line 2", "2 cells"),
        (f"{HEADER}\n0,nan,20\n", "line 2, column throttle", "nan"),
        (f"{HEADER}\n0,0.1,inf\n", "line 2, column tractor_vx_mps", "inf"),
        (f"{HEADER}\nnan,0.1,20\n", "line 2, column time_s", "nan"),
        (f"{HEADER}\n,0.1,20\n", "line 2, column time_s", "empty"),
        (f"{HEADER}\ns,-,m/s\n0,0.1,20\n", "line 2, column time_s", "units"),
        (f"{HEADER}\n0,0.1,fast\n", "line 2, column tractor_vx_mps", "'fast'"),
        (f"{HEADER}\n0,0.1,1_0\n", "line 2, column tractor_vx_mps", "'1_0'"),
        (f"{HEADER}\n0,0.1,20\n0,0.1,20\n", "line 3, column time_s", "does not follow"),
        (f"{HEADER}\n1e12,0.1,20\n", "line 2, column time_s", "expected seconds"),
        (f"{HEADER}\n0.1,0.1,20\n0,0.1,20\n", "line 3, column time_s", "does not follow"),
        (f"{HEADER}\n0,0.1,700\n", "line 2, column tractor_vx_mps", "700"),
        (f"{HEADER}\n0,1.5,20\n", "line 2, column throttle", "1.5"),
        (f"{HEADER},throttle\n0,0.1,20,0.1\n", "line 1", "2 times"),
        ("# units: mph\n" + HEADER + "\n0,0.1,20\n", "units", "SI"),
        ("time_s,tractor_vx_mph\n0,20\n", "line 1", "tractor_vx_mps"),
        ("time_s,tractor_velocity\n0,20\n", "line 1", "tractor_velocity"),
        ("time_s,tire_pressure_steer_lefft_pa\n0,1\n", "line 1", "steer_left"),
        ("time_s,hub_speed_nose_radps\n0,1\n", "line 1", "unknown hub"),
        ("time_s,blowout\n0,steer_lefft\n", "line 2, column blowout", "unknown tire"),
        ("time_s,blowout\n0,steer_left\n1,steer_left\n", "line 3, column blowout", "second time"),
        ("time_s,tire_pressure_steer_left_pa\n0,-120000\n", "line 2", "-120000"),
        ("time_s,brake_pressure_trailer_pa\n0,-9000\n", "line 2", "-9000"),
        ('time_s,throttle\n0,"0.1\n', "line 2", "quoting"),
        (b"time_s,throttle\n0,\xff\xfe\n", "byte", "0xff"),
        (b"time_s,throttle\n0,\0\n", "byte", "zero byte"),
    ],
)
def test_bad_input_is_one_line_with_place_and_value(
    tmp_path: Path, text: str | bytes, place: str, words: str
) -> None:
    with pytest.raises(InputError) as caught:
        parse(tmp_path, text)
    line = str(caught.value)
    assert "\n" not in line
    assert "log.csv" in line
    assert place in caught.value.where
    assert words in line
    assert caught.value.expected


def test_a_zero_error_of_a_pressure_gauge_is_no_bad_input(tmp_path: Path) -> None:
    recording = parse(tmp_path, "time_s,brake_pressure_trailer_pa\n0,-350\n")
    assert recording["brake_pressure_trailer_pa"].value.tolist() == [-350.0]


def with_glitches(column: str, bad: str, many: int) -> str:
    cells = (bad if 50 <= i < 50 + many else "30" for i in range(300))
    return f"time_s,{column}\n" + "".join(f"{i},{cell}\n" for i, cell in enumerate(cells))


@pytest.mark.parametrize(("column", "bad"), [
    ("hub_speed_steer_left_radps", "6553.5"), ("tire_pressure_steer_left_pa", "-120000"),
])  # fmt: skip
def test_rare_impossible_readings_are_left_out(tmp_path: Path, column: str, bad: str) -> None:
    recording = parse(tmp_path, with_glitches(column, bad, 3))
    assert len(recording[column]) == 297
    assert f"{column}: 3 of 300 readings are left out as impossible" in recording.notes[0]
    with pytest.raises(InputError, match="line 52"):
        parse(tmp_path, with_glitches(column, bad, 4))


def test_an_impossible_command_is_refused_however_rare(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="line 52"):
        parse(tmp_path, with_glitches("brake_pressure_steer_pa", "-120000", 1))


def test_a_column_of_no_concern_is_ignored_and_said(tmp_path: Path) -> None:
    recording = parse(tmp_path, "time_s,throttle,gps_satellites\n0,0.1,9\n")
    assert set(recording.channels) == {"throttle"}
    assert "gps_satellites" in recording.notes[0]


def test_windows_line_ends_and_byte_order_mark(tmp_path: Path) -> None:
    recording = parse(tmp_path, b"\xef\xbb\xbf# a: b\r\ntime_s,throttle\r\n0,0.5\r\n")
    assert recording["throttle"].value.tolist() == [0.5]


@IN_TMP
@given(st.binary(max_size=300))
def test_random_bytes_are_refused_in_one_line(tmp_path: Path, data: bytes) -> None:
    assert "\n" not in refusal(tmp_path, data)


@IN_TMP
@given(st.text(st.sampled_from(string.digits + ".,-+e_nai\"'\n \t"), max_size=120))
def test_random_cells_give_a_recording_or_one_line(tmp_path: Path, body: str) -> None:
    assert "\n" not in refusal(tmp_path, f"{HEADER}\n{body}")


def test_the_same_recording_gives_the_same_bytes(tmp_path: Path, full_recording: Recording) -> None:
    one = write_recording(full_recording, tmp_path / "one.csv").read_bytes()
    assert write_recording(full_recording, tmp_path / "two.csv").read_bytes() == one


def test_a_table_under_our_own_names_is_held_against_itself(tmp_path: Path) -> None:
    """Whoever writes deg/s into tractor_yaw_rate_radps is told, also without a mapping."""
    time_s = np.arange(0.0, 20.0, 0.05)
    rate = 0.05 * np.sin(0.5 * time_s)
    table = np.column_stack([time_s, 0.0 * time_s + 20.0, np.degrees(rate), 20.0 * rate])
    path = tmp_path / "own.csv"
    np.savetxt(path, table, delimiter=",", comments="",
               header="time_s,tractor_vx_mps,tractor_yaw_rate_radps,tractor_ay_mps2")
    assert any("the yaw rate reads like deg/s" in note for note in read_recording(path).notes)
