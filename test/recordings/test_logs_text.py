"""Text logs as loggers write them: CarSim, VBOX, MATLAB, European spreadsheets."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import read_recording
from truck_blowout_sim.recordings.logs import open_log
from truck_blowout_sim.recordings.logs.cells import column_of
from truck_blowout_sim.recordings.mapping.rules import Rules, Source, TimeRule
from truck_blowout_sim.recordings.mapping.times import times_of

IN_TMP = settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=40)
ROWS = range(30)

CARSIM = "Time,Vx,AVz,Steer_SW\ns,km/h,deg/s,deg\n" + "".join(
    f"{0.01 * i:.2f},{80 + 0.1 * i:.1f},{0.2 * i:.1f},{-i}\n" for i in ROWS)  # fmt: skip
EUROPEAN = (
    '"Messung 7";;\nDatum: 01.02.2024;;\n"Zeit [ms]";"Geschwindigkeit [km/h]";"LWI [°]"\n'
) + "".join(f"{10 * i};{80 + 0.1 * i:.1f};{-i}\n".replace(".", ",") for i in ROWS)
MATLAB = "Time\tSpeed\tSWA\n" + "".join(
    f"00:00:{0.01 * i:06.3f}\t{22.2 + 0.1 * i}\t{-i}\n" for i in ROWS)  # fmt: skip
DATED = "timestamp,speed (mph),swa (deg),note\n" + "".join(
    f"2024-02-01 12:00:{0.01 * i:06.3f},{50 + 0.1 * i:.1f},{-i},ok\n" for i in ROWS)  # fmt: skip
QUOTED = "Time [s],Speed [km/h],SWA\n" + "".join(
    f'"{0.01 * i:.2f}","{80 + 0.1 * i:.1f}","{-i}"\n'.replace(".", ",") for i in ROWS)
BLANKS = "  Time   Speed   SWA\n" + "".join(
    f"  {0.01 * i:.2f}   {80 + i}   {-i}\n" for i in ROWS)  # fmt: skip
VBO = """File created on 01/02/2024 at 12:00:00

[header]
satellites
time
velocity kmh
LWS_Angle

[column names]
sats time velocity LWS_Angle

[data]
""" + "".join(f"009 1200{0.01 * i:05.2f} {80 + 0.1 * i:07.3f} {-i}\n" for i in ROWS)


def log(tmp_path: Path, text: str, name: str = "log.csv", coding: str = "utf-8") -> Path:
    path = tmp_path / name
    path.write_bytes(text.encode(coding))
    return path


@pytest.mark.parametrize(("text", "name", "columns"), [
    (CARSIM, "log.csv", {"Vx": "km/h", "AVz": "deg/s", "Steer_SW": "deg"}),
    (EUROPEAN, "log.csv", {"Geschwindigkeit": "km/h", "LWI": "°"}),
    (MATLAB, "log.txt", {"Speed": "", "SWA": ""}),
    (DATED, "log.csv", {"speed": "mph", "swa": "deg"}),
    (BLANKS, "log.dat", {"Speed": "", "SWA": ""}),
    (QUOTED, "log.csv", {"Speed": "km/h", "SWA": ""}),
    (VBO, "log.vbo", {"velocity": "kmh", "LWS_Angle": ""}),
])  # fmt: skip
def test_columns_units_and_time_are_found(
    tmp_path: Path, text: str, name: str, columns: dict[str, str]
) -> None:
    opened = open_log(log(tmp_path, text, name))
    times = times_of(opened, TimeRule())
    np.testing.assert_allclose(times.time_s - times.time_s[0], 0.01 * np.arange(30), atol=1e-6)
    assert {n: opened.column(n).unit for n in columns} == columns
    last = list(columns)[-1]
    np.testing.assert_array_equal(opened.column(last).values, -np.arange(30.0))


def test_a_clock_of_digits_goes_on_counting_after_midnight(tmp_path: Path) -> None:
    """A satellite receiver's day ends in the afternoon in America."""
    rows = "".join(
        f"009 {'2359' if i < 15 else '0000'}{(59.85 + 0.01 * i) % 60.0:05.2f} {3000 + 0.01 * i:.2f}"
        f" {80 + 0.1 * i:07.3f}\n" for i in ROWS)
    text = f"[header]\nsats\n[column names]\nsats time lat velocity\n[data]\n{rows}"
    times = times_of(open_log(log(tmp_path, text, "log.vbo")), TimeRule())
    assert (times.column, times.unit, times.named) == ("time", "hhmmss", True)
    np.testing.assert_allclose(times.time_s - times.time_s[0], 0.01 * np.arange(30), atol=1e-6)


def test_a_distance_is_not_taken_for_time_and_a_column_without_unit_is_told(tmp_path: Path
                                                                           ) -> None:
    grows = "".join(f"{0.2 * i:.1f},{0.01 * i:.2f},{-i}\n" for i in ROWS)
    path = log(tmp_path, f"Distance [m],clk,SWA\n{grows}")
    times = times_of(open_log(path), TimeRule())
    assert (times.column, times.named) == ("clk", False)
    mapping = Rules(channels={"steering_wheel_angle_rad": Source("SWA", unit="deg")})
    note = next(n for n in read_recording(path, mapping=mapping).notes if "'clk'" in n)
    assert "is taken for it" in note


@pytest.mark.parametrize("cell", [
    "14-Mar-2024 23:59:{:06.3f}", "2024-03-14T23:59:{:012.9f}Z", "2024-03-15 00:59:{:06.3f}+01:00",
    "03/14/2024 11:59:{:06.3f} PM", "14/03/2024 23:59:{:06.3f}", "14.03.2024 23:59:{:06.3f}",
    "14 Mar 2024 23:59:{:06.3f}", "2024/03/14 23:59:{:06.3f}",
])  # fmt: skip
def test_dates_as_loggers_and_matlab_write_them(tmp_path: Path, cell: str) -> None:
    text = "Time,SWA\n" + "".join(f"{cell.format(0.01 * i)},{-i}\n" for i in ROWS)
    times = times_of(open_log(log(tmp_path, text)), TimeRule())
    np.testing.assert_allclose(times.time_s, 1710460740.0 + 0.01 * np.arange(30), atol=1e-6)


@pytest.mark.parametrize(("form", "factor"), [("{} sec", 1.0), ("{} min", 60.0), ("{} hr", 3600.0)])
def test_durations_as_matlab_writes_them(tmp_path: Path, form: str, factor: float) -> None:
    text = "Time,SWA\n" + "".join(f"{form.format(0.01 * i)},{-i}\n" for i in ROWS)
    times = times_of(open_log(log(tmp_path, text)), TimeRule())
    np.testing.assert_allclose(times.time_s, factor * 0.01 * np.arange(30), atol=1e-9)


@pytest.mark.parametrize("coding", ["utf-16", "utf-8-sig", "cp1252"])
def test_encodings(tmp_path: Path, coding: str) -> None:
    assert "LWI" in open_log(log(tmp_path, EUROPEAN, coding=coding)).names


def test_the_head_is_kept_and_text_columns_are_told(tmp_path: Path) -> None:
    opened = open_log(log(tmp_path, EUROPEAN))
    assert opened.metadata["Datum"] == "01.02.2024"
    assert any("'note' holds text" in note for note in open_log(log(tmp_path, DATED)).notes)


def test_a_clock_time_above_the_table_is_no_entry(tmp_path: Path) -> None:
    opened = open_log(log(tmp_path, "File made on 24/11/2026 @ 12:34\nTruck: 7\n" + CARSIM))
    assert dict(opened.metadata) == {"Truck": "7"}


def test_a_last_line_that_is_cut_short_is_told(tmp_path: Path) -> None:
    opened = open_log(log(tmp_path, CARSIM + "0.30,8"))
    assert len(opened.column("Vx").values) == 30
    assert any("line 33" in note for note in opened.notes)


def test_a_cell_that_is_no_number_keeps_its_line(tmp_path: Path) -> None:
    opened = open_log(log(tmp_path, CARSIM.replace("80.5,", "8o.5,")))
    assert opened.column("Vx").bad == "line 8: '8o.5'"


@pytest.mark.parametrize("text", ["", "\n\n", "only words\nand more\n", "a,b\nc,d\n", "1\n2\n"])
def test_what_is_no_table_is_one_line(tmp_path: Path, text: str) -> None:
    with pytest.raises(InputError, match=r"log\.csv"):
        open_log(log(tmp_path, text))


@IN_TMP
@given(st.text(alphabet="0123456789,;.\t\"\n :-ab[]#", max_size=200), st.sampled_from(
    ["log.csv", "log.txt", "log.vbo"]))
def test_any_text_is_a_table_or_one_line(tmp_path: Path, text: str, name: str) -> None:
    path = log(tmp_path, text, name)
    line = ""
    try:
        opened = open_log(path)
        for column in opened.names:
            opened.column(column)
        times_of(opened, TimeRule())
    except InputError as error:
        line = str(error)
    assert "\n" not in line


@IN_TMP
@given(st.binary(max_size=200), st.sampled_from(["log.csv", "log.vbo", "log.dat"]))
def test_any_bytes_are_a_table_or_one_line(tmp_path: Path, data: bytes, name: str) -> None:
    (tmp_path / name).write_bytes(data)
    line = ""
    try:
        open_log(tmp_path / name)
    except InputError as error:
        line = str(error)
    assert "\n" not in line


def test_torn_rows_of_a_vbo_file_are_said(tmp_path: Path) -> None:
    path = log(tmp_path, VBO + "009 120001\n", "log.vbo")
    table = open_log(path)
    assert [note for note in table.notes if note.startswith("1 rows with another number")]


@pytest.mark.parametrize("cells", [("1_5", "2", "3"), ("1", "1_5", "2")])
def test_a_number_has_no_underscore(cells: tuple[str, ...]) -> None:
    values, _, wrong = column_of(cells, ".")
    assert wrong == cells.index("1_5")
    assert np.isnan(values[wrong])
