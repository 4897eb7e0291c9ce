"""The thesis's .mat files: units and axes, and what is refused."""

from __future__ import annotations

import random
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import scipy.io
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import Blowout, Recording, read_recording, write_recording
from truck_blowout_sim.recordings.mat_file import read_variables

TIME = np.round(-4.92 + 0.01 * np.arange(1499), 9)
IN_TMP = settings(suppress_health_check=[HealthCheck.function_scoped_fixture])


def variables(suffix: str = "_e", **changed: object) -> dict[str, Any]:
    made = {f"{name}{suffix}": np.full((1499, 1), value) for name, value in
            (("vx", 55.0), ("vy", 1.0), ("yaw", -2.5), ("x", 100.0), ("y", 16.0))}  # fmt: skip
    made[f"time{suffix}"] = TIME[:, None]
    return {name: value for name, value in {**made, **changed}.items() if value is not None}


def saved(tmp_path: Path, content: dict[str, Any]) -> Path:
    path = tmp_path / "exp.mat"
    scipy.io.savemat(path, content)
    return path


def test_units_and_axes_are_converted(tmp_path: Path) -> None:
    recording = read_recording(saved(tmp_path, variables()))
    first = {name: series.value[0] for name, series in recording.channels.items()}
    assert first["tractor_vx_mps"] == pytest.approx(55 * 0.44704)
    assert first["tractor_vy_mps"] == pytest.approx(-0.44704)
    assert first["tractor_yaw_rate_radps"] == pytest.approx(np.radians(2.5))
    assert first["tractor_x_m"] == pytest.approx(30.48)
    assert first["tractor_y_m"] == pytest.approx(-16 * 0.3048)
    assert recording.blowouts == (Blowout(0.0, ("steer_left",)),)
    np.testing.assert_array_equal(recording["tractor_x_m"].time_s, TIME)


def test_hve_has_no_time_of_its_own_and_y_to_the_left(tmp_path: Path) -> None:
    path = saved(tmp_path, variables("_h", time_h=None))
    recording = read_recording(path, source="hve")
    assert recording["tractor_y_m"].value[0] == pytest.approx(16 * 0.3048)
    assert recording["tractor_yaw_rate_radps"].value[0] == pytest.approx(np.radians(2.5))
    assert recording["tractor_vx_mps"].time_s[0] == -4.92
    assert any("no time variable" in note for note in recording.notes)


@pytest.mark.parametrize("compressed", [False, True])
@pytest.mark.parametrize("dtype", ["f8", "f4", "i2", "u1", "i4"])
def test_numbers_are_read_as_scipy_wrote_them(tmp_path: Path, dtype: str, compressed: bool) -> None:
    made = {
        "a": np.arange(12).astype(dtype).reshape(3, 4),
        "b": np.array([[7]], dtype=dtype),
        "c": np.zeros((0, 3)),
        "words": "some text",
        "cells": np.array([1, "x"], dtype=object),
        "struct": {"field": 1.0},
        "turned": np.array([1j]),
    }
    path = tmp_path / "any.mat"
    scipy.io.savemat(path, made, do_compression=compressed)
    found = read_variables(path)
    assert set(found) == set(made)
    for name in ("a", "b", "c"):
        values = found[name].values
        assert values is not None
        np.testing.assert_array_equal(values, made[name])
    kinds = [found[name].kind for name in ("words", "cells", "struct", "turned")]
    assert found["words"].text == "some text"
    inside = {name: part for name in ("cells", "struct") for name, part in found[name].flat()}
    assert inside["struct.field"].values == 1.0
    assert inside["cells{1}"].values == 1.0
    assert inside["cells{2}"].text == "x"
    assert kinds == ["a text", "a cell array", "a structure", "complex"]


def test_every_channel_comes_back_with_its_own_instants(
    tmp_path: Path, full_recording: Recording
) -> None:
    again = read_recording(write_recording(full_recording, tmp_path / "full.mat"))
    assert dict(again.channels) == dict(full_recording.channels)
    assert again.blowouts == full_recording.blowouts
    assert again.metadata["note"] == full_recording.metadata["note"]


def test_scipy_reads_vectors_units_and_events(tmp_path: Path, full_recording: Recording) -> None:
    path = write_recording(full_recording, tmp_path / "full.mat")
    loaded = scipy.io.loadmat(path, squeeze_me=True, struct_as_record=False)
    for name, series in full_recording.channels.items():
        np.testing.assert_array_equal(loaded[name], series.value)
        times = loaded.get(f"{name}_time_s", loaded["time_s"])
        np.testing.assert_array_equal(times, series.time_s)
    assert loaded["units"].tractor_vx_mps == "m/s"
    assert loaded["units"].tire_pressure_steer_left_pa == "Pa"
    assert loaded["blowout_tires"][0] == "steer_left"
    assert max(map(len, loaded)) <= 63


def test_the_thesis_variables_are_an_option_of_output(
    tmp_path: Path, sparse_recording: Recording
) -> None:
    path = write_recording(sparse_recording, tmp_path / "again.mat", thesis_variables=True)
    again = read_recording(path)
    for name in ("tractor_vx_mps", "tractor_yaw_rate_radps", "tractor_x_m"):
        np.testing.assert_allclose(again[name].value, sparse_recording[name].value, atol=1e-14)
        np.testing.assert_array_equal(again[name].time_s, sparse_recording[name].time_s)


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ({"other": np.zeros(3)}, "or a mapping"),
        (variables(vx_e=np.full(1499, np.nan)), "sample 1"),
        (variables(vx_e=np.zeros(7)), "7 samples"),
        (variables(vx_e="fast"), "variable vx_e"),
        (variables(vx_e=np.zeros((3, 4))), "variable vx_e"),
        (variables(vx_e=np.full(1499, 1j)), "variable vx_e"),
        (variables(time_e=TIME[::-1]), "does not follow"),
        (variables(time_e=np.full(1499, np.inf)), "inf"),
        (variables(vx_e=np.full(1499, 1e5)), "tractor_vx_mps"),
        ({"time_e": TIME}, "no channel among its variables"),
    ],
)
def test_bad_content_is_one_line(tmp_path: Path, content: dict[str, Any], words: str) -> None:
    with pytest.raises(InputError) as caught:
        read_recording(saved(tmp_path, content))
    assert words in str(caught.value)
    assert "exp.mat" in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_damaged_file_of_version_7_3_is_one_line(tmp_path: Path) -> None:
    path = tmp_path / "new.mat"
    path.write_bytes(b"MATLAB 7.3 MAT-file, Platform: GLNXA64" + bytes(600))
    with pytest.raises(InputError, match=r"new\.mat: (damaged|is MATLAB 7\.3)"):
        read_recording(path)


def test_a_cut_file_is_refused_at_every_length(tmp_path: Path) -> None:
    path = saved(tmp_path, variables())
    whole = path.read_bytes()
    for size in (0, 1, 100, 128, 200, 5_000, len(whole) // 2, len(whole) - 9):
        path.write_bytes(whole[:size])
        with pytest.raises(InputError, match=r"exp\.mat"):
            read_recording(path)


@IN_TMP
@given(st.randoms(use_true_random=False), st.booleans())
def test_damage_gives_a_recording_or_one_line(
    tmp_path: Path, dice: random.Random, compressed: bool
) -> None:
    """The library's own reader brings the interpreter down here."""
    path = tmp_path / "damaged.mat"
    content = {"time_e": np.arange(30.0), "vx_e": np.full(30, 50.0), "y_e": np.arange(30.0)}
    scipy.io.savemat(path, content, do_compression=compressed)
    data = bytearray(path.read_bytes())
    for _ in range(dice.randint(1, 5)):
        data[dice.randrange(128, len(data))] = dice.choice([0, 1, 127, 255, dice.randrange(256)])
    path.write_bytes(data)
    line = ""
    try:
        read_recording(path)
    except InputError as error:
        line = str(error)
    assert "\n" not in line


@IN_TMP
@given(st.binary(max_size=400), st.booleans())
def test_random_bytes_are_refused_in_one_line(tmp_path: Path, data: bytes, headed: bool) -> None:
    path = tmp_path / "random.mat"
    head = b"MATLAB 5.0 MAT-file".ljust(124) + b"\x00\x01IM"
    path.write_bytes(head + data if headed else data)
    with pytest.raises(InputError) as caught:
        read_recording(path)
    assert "\n" not in str(caught.value)
