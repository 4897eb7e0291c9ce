"""Recordings as pandas frames and xarray datasets, and how they show themselves."""

from __future__ import annotations

import pytest

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
