from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from truck_blowout_sim.comparison.provenance import MARKS, marks_of
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import Recording, Series, read_recording
from truck_blowout_sim.recordings.shipped import find_recording, shipped_recordings

TEST_2013 = "test_2013_steer_blowout"


def recording(provenance: str) -> Recording:
    series = Series(np.array([0.0, 0.1]), np.zeros(2))
    return Recording("made", {"throttle": series}, metadata={"provenance": provenance})


def test_every_sample_of_the_shipped_record_is_marked() -> None:
    path = find_recording(TEST_2013)
    read = read_recording(path)
    marks = marks_of(path, read)
    assert set(marks) == set(read.channels)
    for name, series in read.channels.items():
        assert marks[name].time_s == pytest.approx(series.time_s), name
        assert sum(map(marks[name].share, MARKS)) == pytest.approx(1.0)
    yaw_rate = marks["tractor_yaw_rate_radps"]
    assert yaw_rate.mark[np.argmin(np.abs(yaw_rate.time_s - 1.0))] == 0
    assert any("L461" in source for source in yaw_rate.sources)


def test_a_measured_record_has_no_marks(tmp_path: Path) -> None:
    assert marks_of(tmp_path / "run.csv", Recording("run", {})) == {}


def test_a_missing_or_wrong_mark_is_refused_with_its_place(tmp_path: Path) -> None:
    name = "p.provenance.csv"
    with pytest.raises(InputError, match=r"p\.provenance\.csv: the provenance .* is missing"):
        marks_of(tmp_path / "run.csv", recording(name))
    (tmp_path / name).write_text("time_s,throttle\n0.0,stated T L1\n0.1,guessed\n")
    with pytest.raises(InputError, match=r"line 3, column throttle: a cell without a mark"):
        marks_of(tmp_path / "run.csv", recording(name))
    (tmp_path / name).write_text("time_s,throttle\nnow,stated\n")
    with pytest.raises(InputError, match="column time_s"):
        marks_of(tmp_path / "run.csv", recording(name))


@pytest.mark.parametrize("name", ["../secret.provenance.csv", "/etc/passwd", "secret.csv",
                                  "link.provenance.csv"])
def test_no_line_of_another_file_is_shown(tmp_path: Path, name: str) -> None:
    (tmp_path / "in").mkdir()
    for place in (tmp_path / "secret.provenance.csv", tmp_path / "in/secret.csv"):
        place.write_text("password,throttle\nhunter2,hunter2\n")
    (tmp_path / "in/link.provenance.csv").symlink_to(tmp_path / "secret.provenance.csv")
    with pytest.raises(InputError, match="expected a file beside the recording") as caught:
        marks_of(tmp_path / "in/run.csv", recording(name))
    assert "hunter2" not in str(caught.value)


def test_shipped_recordings_are_found_by_name_and_nothing_else_is() -> None:
    assert TEST_2013 in shipped_recordings()
    assert find_recording(TEST_2013).name == f"{TEST_2013}.csv"
    with pytest.raises(InputError, match=f"expected .*{TEST_2013}"):
        find_recording("test_2014")
    with pytest.raises(InputError, match="no such file"):
        find_recording(f"{TEST_2013}.provenance.csv")
