"""MDF and MATLAB files of other loggers."""

from __future__ import annotations

import random
from pathlib import Path

import numpy as np
import pytest
import scipy.io
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import read_recording
from truck_blowout_sim.recordings.logs import open_log
from truck_blowout_sim.recordings.mapping.rules import Rules, Source

IN_TMP = settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=25)
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


def test_a_log_without_a_mapping_says_what_it_wants(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"expected a mapping: --map FILE"):
        read_recording(mdf(tmp_path / "log.mf4", "4.10"))


def test_structures_of_a_mat_file_are_read_by_path(tmp_path: Path) -> None:
    path = tmp_path / "log.mat"
    scipy.io.savemat(path, {"t": TIME, "log": {"speed": {"data": 72.0 + TIME, "unit": "km/h"}}})
    rules = Rules(channels={"tractor_vx_mps": Source("log.speed.data")})
    np.testing.assert_allclose(
        read_recording(path, mapping=rules)["tractor_vx_mps"].value, (72.0 + TIME) / 3.6)


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


@pytest.fixture(scope="module")
def mdf_bytes(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    return mdf(tmp_path_factory.mktemp("mdf") / "log.mf4", "4.10").read_bytes()


@IN_TMP
@given(st.randoms(use_true_random=False), st.booleans())
def test_damage_gives_a_recording_or_one_line(
    tmp_path: Path, mdf_bytes: bytes, dice: random.Random, cut: bool
) -> None:
    data = bytearray(mdf_bytes)
    for _ in range(4):
        data[dice.randrange(8, len(data))] = dice.randrange(256)
    path = tmp_path / "damaged.mf4"
    path.write_bytes(data[: dice.randrange(len(data))] if cut else data)
    line = ""
    try:
        read_recording(path, mapping=RULES)
    except InputError as error:
        line = str(error)
    assert "\n" not in line


def test_a_damaged_log_is_one_line(tmp_path: Path) -> None:
    for name in ("x.mf4", "x.mat", "x.db3", "x.bag", "x.vbo"):
        (tmp_path / name).write_bytes(b"MDF 4.10 " + bytes(100))
        with pytest.raises(InputError) as caught:
            open_log(tmp_path / name)
        assert "\n" not in str(caught.value)
