"""Any recording survives a bag; any metadata text gives a bag or one line."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import (
    DEFAULT_TIRES,
    Blowout,
    Channel,
    Recording,
    Series,
    by_name,
    channels_for,
    read_recording,
    write_recording,
)
from truck_blowout_sim.recordings.formats import read_native

TABLE = by_name(c for c in channels_for() if c.place)
ANGLES = ("roll_rad", "pitch_rad", "yaw_rad")
IN_TMP = settings(
    suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=40, deadline=None
)


def values_of(channel: Channel) -> st.SearchStrategy[float]:
    """Numbers a channel may have; tilt short of upright, heading short of half a turn a sample."""
    if channel.name.endswith(ANGLES):
        return st.floats(-1.4, 1.4)
    # an extra that is nothing but zeros counts as not filled in
    return st.floats(max(channel.lowest, -1e6), min(channel.highest, 1e6)).filter(
        lambda value: channel.standard or value != 0
    )


@st.composite
def recordings(draw: st.DrawFn) -> Recording:
    names = draw(st.lists(st.sampled_from(sorted(TABLE)), min_size=1, max_size=6, unique=True))
    channels = {}
    for name in names:
        ticks = draw(st.lists(st.integers(-500, 1000), min_size=1, max_size=15, unique=True))
        values = [draw(values_of(TABLE[name])) for _ in ticks]
        channels[name] = Series(np.array(sorted(ticks)) / 100, np.array(values))
    first_s = min(series.time_s[0] for series in channels.values())
    tires = draw(st.lists(st.sampled_from(DEFAULT_TIRES), max_size=3, unique=True))
    after = [first_s + 0.01 * draw(st.integers(0, 500)) for _ in tires]
    events = {round(t, 9): tire for t, tire in zip(after, tires, strict=True)}
    return Recording("any", channels, tuple(Blowout(t, (tire,)) for t, tire in events.items()))


@IN_TMP
@given(recording=recordings(), bare=st.booleans())
def test_any_recording_survives(tmp_path: Path, recording: Recording, bare: bool) -> None:
    path = write_recording(recording, tmp_path / ("any.mcap" if bare else "any"))
    again = read_native(path)
    assert set(again.channels) == set(recording.channels)
    for name, series in recording.channels.items():
        np.testing.assert_allclose(again[name].time_s, series.time_s, atol=1e-12, err_msg=name)
        tolerance = 1e-9 if TABLE[name].offset else 1e-13
        np.testing.assert_allclose(again[name].value, series.value, rtol=1e-14, atol=tolerance)
    assert [b.tires for b in again.blowouts] == [b.tires for b in recording.blowouts]
    np.testing.assert_allclose([b.time_s for b in again.blowouts],
                               [b.time_s for b in recording.blowouts], atol=1e-12)  # fmt: skip


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory, sparse_recording: Recording) -> Path:
    return write_recording(sparse_recording, tmp_path_factory.mktemp("metadata") / "bag")


@IN_TMP
@given(cut=st.integers(0, 2000), rubbish=st.text(max_size=30))
def test_damaged_metadata_gives_a_recording_or_one_line(
    folder: Path, cut: int, rubbish: str
) -> None:
    path = folder / "metadata.yaml"
    whole = path.read_bytes()
    path.write_bytes(whole[:cut] + rubbish.encode("utf-8", "ignore") + whole[cut + len(rubbish) :])
    line = ""
    try:
        read_recording(folder)
    except InputError as error:
        line = str(error)
    finally:
        path.write_bytes(whole)
    assert "\n" not in line
