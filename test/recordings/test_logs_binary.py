"""MDF and MATLAB files of other loggers."""

from __future__ import annotations

import random
import struct
from dataclasses import replace
from datetime import datetime, timezone
from pathlib import Path

import numpy as np
import pytest
import scipy.io
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from truck_blowout_sim.cli.main import main
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import read_recording
from truck_blowout_sim.recordings.logs import open_log
from truck_blowout_sim.recordings.mapping.rules import Also, Rules, Source

IN_TMP = settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=12)
TIME = 0.01 * np.arange(200)
RULES = Rules(channels={"tractor_vx_mps": Source("VehSpd"),
                        "tractor_yaw_rate_radps": Source("YawRate")})  # fmt: skip


def mdf(path: Path, version: str) -> Path:
    asammdf = pytest.importorskip("asammdf")
    file = asammdf.MDF(version=version)
    signal = asammdf.Signal
    file.append([signal(72.0 + TIME, TIME, unit="km/h", name="VehSpd")])
    file.append([signal(np.sin(TIME[::2]), TIME[::2], unit="deg/s", name="YawRate")])
    file.append([signal(np.array([b"a", b"b"]), TIME[:2], name="State", encoding="utf-8")])
    file.save(path, overwrite=True)
    file.close()
    return path


@pytest.mark.parametrize(("version", "name"), [("3.30", "log.mdf"), ("4.10", "log.mf4"),
                                               ("4.10", "log.dat")])  # fmt: skip
def test_mdf_groups_keep_their_rates_and_units(tmp_path: Path, version: str, name: str) -> None:
    written = mdf(tmp_path / ("log.mdf" if version < "4" else "log.mf4"), version)
    read = read_recording(written.rename(tmp_path / name), mapping=RULES)
    np.testing.assert_allclose(read["tractor_vx_mps"].value, (72.0 + TIME) / 3.6)
    np.testing.assert_allclose(read["tractor_yaw_rate_radps"].time_s, TIME[::2])
    np.testing.assert_allclose(
        read["tractor_yaw_rate_radps"].value, np.radians(np.sin(TIME[::2])))


@pytest.mark.parametrize("zone", [timezone.utc, None])
def test_mdf_files_are_laid_on_the_start_of_the_first(
    tmp_path: Path, zone: timezone | None
) -> None:
    asammdf = pytest.importorskip("asammdf")
    for name, unit, second in (("VehSpd", "km/h", 15), ("YawRate", "deg/s", 17)):
        file = asammdf.MDF(version="4.10")
        file.start_time = datetime(2024, 3, 14, 12, 30, second, tzinfo=zone)
        file.append([asammdf.Signal(10.0 + TIME, TIME, unit=unit, name=name)])
        file.save(tmp_path / f"{name}.mf4")
        file.close()
    rules = replace(RULES, also=(Also("YawRate.mf4"),))
    read = read_recording(tmp_path / "VehSpd.mf4", mapping=rules)
    assert read["tractor_vx_mps"].time_s[0] == 0.0
    assert read["tractor_yaw_rate_radps"].time_s[0] == 2.0
    assert read.metadata["clock_start_s"] == "1710419415.0"
    assert any("YawRate.mf4 starts 2 s after VehSpd.mf4" in note for note in read.notes)


def test_a_log_without_a_mapping_says_what_it_wants(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"expected a mapping: --map FILE"):
        read_recording(mdf(tmp_path / "log.mf4", "4.10"))


def test_a_mat_file_without_vectors_is_refused(tmp_path: Path) -> None:
    scipy.io.savemat(tmp_path / "log.mat", {"mass": 7.0, "driver": "nobody"})
    with pytest.raises(InputError, match="no vector of numbers in it"):
        open_log(tmp_path / "log.mat")


def test_structures_of_a_mat_file_are_read_by_path(tmp_path: Path) -> None:
    path = tmp_path / "log.mat"
    scipy.io.savemat(path, {"t": TIME, "log": {"speed": {"data": 72.0 + TIME, "unit": "km/h"}}})
    rules = Rules(channels={"tractor_vx_mps": Source("log.speed.data")})
    np.testing.assert_allclose(
        read_recording(path, mapping=rules)["tractor_vx_mps"].value, (72.0 + TIME) / 3.6)


def test_vectors_are_on_the_time_of_their_own_structure(tmp_path: Path) -> None:
    path, half = tmp_path / "log.mat", TIME[::2]
    log = {"Speed": {"time": TIME, "value": 72.0 + TIME, "unit": "km/h"},
           "Yaw": {"time": half, "value": np.sin(half), "unit": "deg/s"}}  # fmt: skip
    scipy.io.savemat(path, {"log": log})
    assert list(open_log(path).names) == ["log.Speed.value", "log.Yaw.value"]
    rules = Rules(channels={"tractor_vx_mps": Source("log.Speed.value"),
                            "tractor_yaw_rate_radps": Source("log.Yaw.value")})  # fmt: skip
    read = read_recording(path, mapping=rules)
    np.testing.assert_allclose(read["tractor_vx_mps"].value, (72.0 + TIME) / 3.6)
    np.testing.assert_allclose(read["tractor_yaw_rate_radps"].time_s, half)


def test_what_has_no_time_of_its_own_is_on_that_of_the_structure_around_it(tmp_path: Path) -> None:
    path, half = tmp_path / "log.mat", TIME[::2]
    log = {"time": TIME, "steer": {"data": np.cos(TIME), "unit": "deg"}, "yaw_rate": TIME,
           "speed": {"time": half, "data": 72.0 + half, "unit": "km/h"}}  # fmt: skip
    scipy.io.savemat(path, {"log": log})
    rules = Rules(channels={"tractor_vx_mps": Source("log.speed.data"),
                            "steering_wheel_angle_rad": Source("log.steer.data"),
                            "tractor_yaw_rate_radps": Source("log.yaw_rate", "deg/s")})  # fmt: skip
    read = read_recording(path, mapping=rules)
    np.testing.assert_allclose(read["tractor_vx_mps"].time_s, half)
    np.testing.assert_allclose(read["steering_wheel_angle_rad"].time_s, TIME)
    np.testing.assert_allclose(read["tractor_yaw_rate_radps"].time_s, TIME)


@pytest.mark.parametrize("hdf5", [False, True])
def test_columns_of_a_matrix_are_named_as_matlab_does(tmp_path: Path, hdf5: bool) -> None:
    path, both = tmp_path / "log.mat", np.stack([72.0 + TIME, np.sin(TIME)], axis=1)
    if hdf5:
        h5py = pytest.importorskip("h5py")
        with h5py.File(path, "w", userblock_size=512) as file:
            file["out/time"], file["out/signals/values"] = TIME[None, :], both.T
    else:
        scipy.io.savemat(path, {"out": {"time": TIME, "signals": {"values": both}}})
    rules = Rules(channels={"tractor_vx_mps": Source("out.signals.values(:,1)", "km/h"),
                            "tractor_yaw_rate_radps": Source("out.signals.values(:,2)", "deg/s")})
    read = read_recording(path, mapping=rules)
    np.testing.assert_allclose(read["tractor_vx_mps"].value, (72.0 + TIME) / 3.6)
    np.testing.assert_allclose(read["tractor_yaw_rate_radps"].value, np.radians(np.sin(TIME)))


def test_a_mat_file_of_other_names_asks_for_a_mapping(tmp_path: Path) -> None:
    scipy.io.savemat(tmp_path / "log.mat", {"t": TIME, "speed": TIME})
    with pytest.raises(InputError, match="a mapping: --map FILE"):
        read_recording(tmp_path / "log.mat")


def test_version_7_3_is_read_by_h5py(tmp_path: Path) -> None:
    h5py = pytest.importorskip("h5py")
    path = tmp_path / "log.mat"
    with h5py.File(path, "w", userblock_size=512) as file:
        file["time"] = TIME[None, :]
        file["log/speed"] = (72.0 + TIME)[None, :]
    with path.open("r+b") as file:
        file.write(b"MATLAB 7.3 MAT-file".ljust(124) + b"\x00\x02IM")
    rules = Rules(channels={"tractor_vx_mps": Source("log.speed", "km/h")})
    read = read_recording(path, mapping=rules)
    np.testing.assert_allclose(read["tractor_vx_mps"].time_s, TIME)


def element(kind: int, content: bytes) -> bytes:
    return struct.pack("<II", kind, len(content)) + content + b"\0" * (-len(content) % 8)


def mat_object(name: str, of: str) -> bytes:
    """A variable as MATLAB 5 to 7.2 files hold an object: name, type system, class, a reference."""
    parts = [element(6, struct.pack("<II", 17, 0)), element(1, name.encode()),
             element(1, b"MCOS"), element(1, of.encode())]  # fmt: skip
    return element(14, b"".join(parts))


@pytest.mark.parametrize(("of", "way_out"), [
    ("table", "T = drive; s = table2struct"), ("timetable", "timetable2table"),
    ("timeseries", "t = drive.Time"), ("Simulink.Bus", "save the vectors inside drive"),
])  # fmt: skip
def test_an_object_of_matlab_is_named_with_the_way_out(
    tmp_path: Path, of: str, way_out: str
) -> None:
    path = tmp_path / "log.mat"
    scipy.io.savemat(path, {"speed": 72.0 + TIME})
    vectors = path.read_bytes()
    path.write_bytes(vectors + mat_object("drive", of))
    (note,) = open_log(path).notes
    assert "variable drive is an object" in note
    assert way_out in note
    path.write_bytes(vectors[:128] + mat_object("drive", of))
    with pytest.raises(InputError, match="variable drive is an object") as caught:
        open_log(path)
    assert way_out in str(caught.value)


def test_structure_arrays_and_cells_of_version_7_3_are_followed(tmp_path: Path) -> None:
    h5py = pytest.importorskip("h5py")
    path = tmp_path / "log.mat"
    with h5py.File(path, "w", userblock_size=512) as file:
        held = [file.create_dataset(f"#refs#/{k}", data=(k + TIME)[None, :]) for k in range(3)]
        array = file.create_group("log/Y")
        data = array.create_dataset("Data", (2, 1), dtype=h5py.ref_dtype)
        data[:, 0] = [one.ref for one in held[:2]]
        cells = file.create_dataset("cells", (1, 1), dtype=h5py.ref_dtype)
        cells.attrs["MATLAB_class"] = np.bytes_("cell")
        cells[0, 0] = held[2].ref
        table = file.create_dataset("drive", data=np.arange(6, dtype=np.uint32)[None, :])
        table.attrs["MATLAB_class"] = np.bytes_("table")
        table.attrs["MATLAB_object_decode"] = np.int32(3)
    found = open_log(path)
    assert list(found.names) == ["cells{1}", "log.Y(1).Data", "log.Y(2).Data"]
    np.testing.assert_allclose(found.column("log.Y(2).Data").values, 1 + TIME)
    assert "variable drive is an object of class table" in found.notes[0]


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    """A file of each kind that a library reads."""
    folder = tmp_path_factory.mktemp("whole")
    h5py = pytest.importorskip("h5py")
    with h5py.File(folder / "log.mat", "w", userblock_size=512) as file:
        file["time"], file["VehSpd"] = TIME[None, :], (72.0 + TIME)[None, :]
        file["log/YawRate"] = np.sin(TIME)[None, :]
    mdf(folder / "log.mf4", "4.10")
    mdf(folder / "log.mdf", "3.30")
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def read_damaged(folder: Path, name: str, data: bytearray, dice: random.Random, cut: bool) -> str:
    """The line that a damaged file gives, empty where it is read."""
    for _ in range(4):
        data[dice.randrange(8, len(data))] = dice.randrange(256)
    path = folder / f"damaged_{name}"
    path.write_bytes(data[: dice.randrange(len(data))] if cut else data)
    try:
        read_recording(path, mapping=RULES)
    except InputError as error:
        return str(error)
    return ""


DAMAGE = given(st.randoms(use_true_random=False), st.booleans())


@IN_TMP
@DAMAGE
def test_damage_of_a_mat_file_gives_a_recording_or_one_line(
    tmp_path: Path, whole: dict[str, bytes], dice: random.Random, cut: bool
) -> None:
    assert "\n" not in read_damaged(tmp_path, "log.mat", bytearray(whole["log.mat"]), dice, cut)


@pytest.mark.parametrize("name", ["log.mf4", "log.mdf"])
@settings(IN_TMP, max_examples=4)  # each starts a process
@DAMAGE
def test_damage_of_an_mdf_file_gives_a_recording_or_one_line(
    tmp_path: Path, whole: dict[str, bytes], name: str, dice: random.Random, cut: bool
) -> None:
    assert "\n" not in read_damaged(tmp_path, name, bytearray(whole[name]), dice, cut)


# asammdf as its C code behaves on about one damaged file in a hundred
CRASHING = """
import os, signal, tempfile
from datetime import datetime
from types import SimpleNamespace as Of

class MDF:
    version, masters_db, header = "4.10", {}, Of(start_time=datetime(2024, 3, 14))
    groups = [Of(channels=[Of(name="VehSpd", channel_type=0)])]

    def __init__(self, path):
        self.rest, _ = tempfile.mkstemp()
        os.write(1, b"printed")
        self.crash("open")

    def get(self, **_):
        self.crash("get")

    def crash(self, step):
        if step == "%s":
            os.kill(os.getpid(), signal.SIGSEGV)
"""


@pytest.mark.parametrize(("step", "place"), [("open", ""), ("get", ", channel VehSpd")])
def test_a_reader_that_crashes_is_one_line_and_leaves_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str],
    step: str, place: str,
) -> None:  # fmt: skip
    path, library, rest = tmp_path / "log.mf4", tmp_path / "library", tmp_path / "rest"
    library.mkdir()
    rest.mkdir()
    (library / "asammdf.py").write_text(CRASHING % step)
    path.write_bytes(b"MDF 4.10 " + bytes(100))
    monkeypatch.syspath_prepend(library)
    monkeypatch.setattr("tempfile.tempdir", str(rest))
    (tmp_path / "map.yaml").write_text("channels: {tractor_vx_mps: {from: VehSpd, unit: km/h}}")
    out = tmp_path / "out"
    assert main(["import", str(path), "-m", str(tmp_path / "map.yaml"), "-o", str(out)]) == 2
    shown = capsys.readouterr()
    assert shown.err.count("\n") == 1
    assert f"{path}{place}: damaged: its decoder ended by signal 11" in shown.err
    assert "expected an MDF file of version 3 or 4" in shown.err
    assert shown.out == ""
    assert not out.exists()
    assert not list(rest.iterdir())


def test_a_damaged_log_is_one_line(tmp_path: Path) -> None:
    for name in ("x.mf4", "x.mat", "x.db3", "x.bag", "x.vbo"):
        (tmp_path / name).write_bytes(b"MDF 4.10 " + bytes(100))
        with pytest.raises(InputError) as caught:
            open_log(tmp_path / name)
        assert "\n" not in str(caught.value)
