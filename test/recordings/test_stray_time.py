"""A row before the receiver's first fix must not make a run of fifty years."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from truck_blowout_sim.cli.main import main
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import Recording, Series, read_recording, write_recording
from truck_blowout_sim.recordings.stray_time import LONGEST_S, leap, require_span

FIX_S = 1.7e9


def log(*times_s: float) -> Recording:
    times = np.array(times_s)
    return Recording("log", {name: Series(times, np.zeros(len(times))) for name in (
        "steering_wheel_angle_rad", "tractor_vx_mps")})


def test_a_leap_is_a_note_and_a_pause_between_laps_is_none() -> None:
    assert leap(log(0.0, FIX_S, FIX_S + 1.0, FIX_S + 2.0)) == (0.0, FIX_S)
    assert leap(log(0.0, 1.0, 2.0, 150.0, 151.0, 152.0)) is None
    assert leap(log(0.0, FIX_S)) is None


def test_the_longest_span_is_a_day() -> None:
    require_span(log(0.0, LONGEST_S))
    with pytest.raises(InputError, match="lasts 86401 s; expected a day at most"):
        require_span(log(0.0, LONGEST_S + 1.0))


@pytest.mark.parametrize("verb", ["view", "compare"])
def test_verbs_refuse_it_in_one_line(
    verb: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = write_recording(log(0.0, *(FIX_S + 0.01 * np.arange(200))), tmp_path / "log.csv")
    assert any("the time leaps from 0 s to 1700000000 s" in n for n in read_recording(path).notes)
    output = tmp_path / ("page.html" if verb == "view" else "out")
    assert main([verb, str(path), "-o", str(output)]) == 2
    said = capsys.readouterr().err.splitlines()
    assert "lasts 1700000002 s, with a leap from 0 s to 1700000000 s" in said[-1]
    assert not output.exists()


def test_import_keeps_every_sample_and_tells_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = write_recording(log(0.0, *(FIX_S + 0.01 * np.arange(200))), tmp_path / "log.csv")
    assert main(["import", str(path), "-o", str(tmp_path / "bag")]) == 0
    said = capsys.readouterr()
    assert "note: the time leaps from 0 s to 1700000000 s" in said.err
    assert "no robot model: lasts 1700000002 s" in said.out
    assert len(read_recording(tmp_path / "bag")["tractor_vx_mps"]) == 201


@pytest.mark.parametrize("times", ["0 0.01 1e300", "-9e8 0 2e9", "-2e9 0"])
def test_time_that_no_stamp_holds_is_refused_also_with_a_mapping(
    times: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    log = tmp_path / "log.csv"
    log.write_text("t,speed\n" + "".join(f"{cell},20\n" for cell in times.split()))
    rules = tmp_path / "map.yaml"
    rules.write_text("time: {from: t, unit: s}\n"
                     "channels: {tractor_vx_mps: {from: speed, unit: m/s}}\n")
    assert main(["import", str(log), "--map", str(rules), "-o", str(tmp_path / "bag")]) == 2
    said = capsys.readouterr().err.splitlines()
    assert "expected seconds, -1000000000 to 2147483648" in said[-1]
    assert not (tmp_path / "bag").exists()
