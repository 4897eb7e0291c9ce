"""Recordings as pandas frames and xarray datasets, and how they show themselves."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import Recording


def test_there_and_back_through_pandas(full_recording: Recording) -> None:
    pytest.importorskip("pandas")
    frame = full_recording.to_pandas()
    assert frame.index.name == "time_s"
    assert frame.attrs["units"]["tractor_vx_mps"] == "m/s"
    again = Recording.from_pandas(frame)
    assert dict(again.channels) == dict(full_recording.channels)
    assert again.blowouts == full_recording.blowouts
    assert dict(again.metadata) == dict(full_recording.metadata)


def test_there_and_back_through_xarray(full_recording: Recording) -> None:
    pytest.importorskip("xarray")
    dataset = full_recording.to_xarray()
    assert dataset["tire_pressure_steer_left_pa"].attrs["units"] == "Pa"
    again = Recording.from_xarray(dataset)
    assert dict(again.channels) == dict(full_recording.channels)
    assert again.blowouts == full_recording.blowouts


def test_a_channel_that_is_not_there_is_a_key_error_with_the_nearest(
    sparse_recording: Recording,
) -> None:
    with pytest.raises(KeyError, match="was not recorded; tractor_vx_mps"):
        sparse_recording["tractor_vx"]
    with pytest.raises(KeyError, match="was not recorded; tractor_vx_mps"):
        sparse_recording.gaps("tractor_vx")


def test_a_recording_shows_itself_in_one_line(full_recording: Recording) -> None:
    count = len(full_recording.channels)
    assert repr(full_recording) == (
        f"<Recording 'full': {count} channels, 0 to 3 s, steer_left blown at 1 s,"
        " drive_1_left_outer+drive_1_left_inner blown at 1.505 s>"
    )
    assert repr(full_recording["throttle"]) == "<Series: 301 samples, 0 to 3 s>"


def frame_of(values: list[Any], name: str = "tractor_vx_mps", **units: str) -> Any:  # noqa: ANN401
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame({name: values}, index=np.arange(len(values)) * 0.1)
    frame.attrs["units"] = units
    return frame.rename_axis("time_s")


def test_units_of_a_frame_are_converted() -> None:
    """72 km/h are 20 m/s, not 72; 8.5 bar absolute are gauge Pa; times in ms are seconds."""
    read = Recording.from_pandas(frame_of([72.0, 36.0], tractor_vx_mps="km/h", time_s="ms"))
    assert read["tractor_vx_mps"].value.tolist() == pytest.approx([20.0, 10.0])
    assert read["tractor_vx_mps"].time_s.tolist() == pytest.approx([0.0, 1e-4])
    name = "tire_pressure_steer_left_pa"
    read = Recording.from_pandas(frame_of([8.5], name, **{name: "bar absolute"}))
    assert read[name].value.tolist() == pytest.approx([8.5e5 - 101325.0])


def test_units_of_a_dataset_are_converted() -> None:
    xarray = pytest.importorskip("xarray")
    dataset = xarray.Dataset({"tractor_vx_mps": ("time_s", [72.0, 36.0], {"units": "km/h"})},
                             coords={"time_s": [0.0, 0.1]})  # fmt: skip
    read = Recording.from_xarray(dataset)
    assert read["tractor_vx_mps"].value.tolist() == pytest.approx([20.0, 10.0])
    with pytest.raises(InputError, match="no time_s"):
        Recording.from_xarray(dataset.drop_vars("time_s"))


@pytest.mark.parametrize(("values", "name", "unit", "words"), [
    ([1.0], "tractor_vx_mps", "furlong", "frame, column tractor_vx_mps: unknown unit 'furlong'"),
    ([1.0], "tractor_vx_mps", "bar", "unit 'bar' is one of pressure"),
    ([1.0], "foo", "", "column foo: is no channel"),
    ([1.0], "tractor_vx", "", "expected tractor_vx_mps (the nearest)"),
    (["fast"], "tractor_vx_mps", "", "column tractor_vx_mps: holds no numbers"),
    ([], "tractor_vx_mps", "", "frame: holds no numbers"),
    ([np.nan], "tractor_vx_mps", "", "frame: holds no numbers"),
])  # fmt: skip
def test_what_a_frame_cannot_mean_is_refused(
    values: list[Any], name: str, unit: str, words: str
) -> None:
    with pytest.raises(InputError, match=re.escape(words)):
        Recording.from_pandas(frame_of(values, name, **({name: unit} if unit else {})))


def test_instants_that_are_dates_are_refused() -> None:
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame({"tractor_vx_mps": [1.0, 2.0]},
                             index=pandas.to_datetime(["2024-01-01", "2024-01-02"]))  # fmt: skip
    with pytest.raises(InputError, match="column time_s: holds datetime64"):
        Recording.from_pandas(frame)
