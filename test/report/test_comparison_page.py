from __future__ import annotations

import errno
import json
import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from truck_blowout_sim.comparison import Comparison, compare, compare_recordings, verdict
from truck_blowout_sim.errors import StorageError
from truck_blowout_sim.recordings import INPUT_NAMES, Recording, Series
from truck_blowout_sim.report.comparison_figures import comparison_pictures
from truck_blowout_sim.report.comparison_page import comparison_page, write_comparison_report
from truck_blowout_sim.vehicle import Vehicle

THESIS_FIGURES = {
    "speed", "lateral_speed", "yaw_rate_tractor", "yaw_rate_trailer", "trajectory",
    "position_error", "brake_pressures", "steering",
}  # fmt: skip


@pytest.fixture(scope="module")
def compared(vehicle: Vehicle) -> Comparison:
    return compare("test_2013_steer_blowout", vehicle)


@pytest.fixture(scope="module")
def page(compared: Comparison) -> str:
    return comparison_page(compared)


def test_the_figures_of_the_thesis_are_drawn(compared: Comparison) -> None:
    assert {picture.name for picture in comparison_pictures(compared)} == THESIS_FIGURES


def test_the_report_is_a_page_pictures_and_numbers(compared: Comparison, tmp_path: Path) -> None:
    page = write_comparison_report(compared, tmp_path)
    assert page == tmp_path / "report.html"
    figures = {path.stem for path in (tmp_path / "figures").glob("*.png")}
    assert figures == THESIS_FIGURES
    assert all((tmp_path / "figures" / f"{n}.png").read_bytes()[:4] == b"\x89PNG" for n in figures)
    numbers = json.loads((tmp_path / "comparison.json").read_text())
    assert numbers["rebuilt"]["tractor_yaw_rate_radps"]["stated"] > 0
    found = {path.name for path in tmp_path.iterdir()}
    assert found == {"report.html", "comparison.json", "figures"}


def test_the_verdict_comes_first(compared: Comparison, page: str) -> None:
    for part in verdict(compared).split("; ", 1):
        assert part[1:].replace("'", "&#39;") in page
    assert page.index('class="verdict"') < page.index("<h2>")


def test_a_rebuilt_record_is_said_to_be_one(page: str) -> None:
    assert "No measurement: rebuilt from the thesis" in page
    assert "What was rebuilt" in page
    assert "T L461" in page


def test_a_rebuilt_record_is_drawn_by_its_marks(compared: Comparison) -> None:
    pictures = {p.name: p for p in comparison_pictures(compared)}
    axes = pictures["yaw_rate_tractor"].figure.axes[0]
    labels = [line.get_label() for line in axes.lines]
    for mark in ("stated", "derived", "interpolated"):
        assert f"rebuilt from text: {mark}" in labels
    assert "recorded" not in labels
    stated = next(line for line in axes.lines if line.get_label() == "rebuilt from text: stated")
    dotted = next(
        line for line in axes.lines if line.get_label() == "rebuilt from text: interpolated"
    )
    assert stated.get_linewidth() > 2 * dotted.get_linewidth()
    assert dotted.get_linestyle() == ":"


def test_a_measured_record_is_drawn_as_one_line(compared: Comparison) -> None:
    pictures = {p.name: p for p in comparison_pictures(replace(compared, marks={}))}
    labels = [line.get_label() for line in pictures["yaw_rate_tractor"].figure.axes[0].lines]
    assert labels[:2] == ["recorded", "model"]


def test_what_was_not_recorded_is_drawn_as_the_models_alone(compared: Comparison) -> None:
    pictures = {p.name: p for p in comparison_pictures(compared)}
    assert "Not recorded" in pictures["lateral_speed"].caption


def test_brakes_that_were_never_applied_are_not_drawn(compared: Comparison) -> None:
    model = compared.model
    idle = {
        name: Series(s.time_s, 0 * s.value) if name.startswith("brake_chamber_") else s
        for name, s in model.channels.items()
    }
    coasting = replace(compared, model=replace(model, channels=idle))
    drawn = {picture.name for picture in comparison_pictures(coasting)}
    assert drawn == THESIS_FIGURES - {"brake_pressures"}


def test_the_page_needs_no_other_file(page: str) -> None:
    assert page.count("<img src=") == len(THESIS_FIGURES)
    assert page.count('src="data:image/svg+xml;base64,') == len(THESIS_FIGURES)
    assert "http://" not in page
    assert "https://" not in page


def two_recordings(vehicle: Vehicle) -> Comparison:
    """Two runs without a hand wheel, of which one chamber of an axle was recorded."""
    time_s = np.arange(0.0, 3.0, 0.01)
    turn = Series(time_s, 0.1 * np.sin(time_s))
    chamber = Series(time_s, np.full(time_s.size, 3e5))
    first, second = (Recording(name, {"tractor_yaw_rate_radps": turn,
                                      "brake_chamber_steer_left_pa": chamber})
                     for name in ("monday", "tuesday"))
    return compare_recordings(first, second, vehicle=vehicle)


def test_two_recordings_are_drawn_without_a_hand_wheel_and_with_one_chamber(
    vehicle: Vehicle
) -> None:
    pictures = {p.name: p for p in comparison_pictures(two_recordings(vehicle))}
    assert set(pictures) == {"yaw_rate_tractor", "brake_pressures"}
    for picture in pictures.values():
        labels = [line.get_label() for axes in picture.figure.axes for line in axes.lines]
        assert any(str(label).startswith("tuesday") for label in labels)
        assert not any("model" in str(label) for label in labels)


def test_the_page_of_two_recordings_claims_no_model(vehicle: Vehicle) -> None:
    page = comparison_page(two_recordings(vehicle), ())
    assert "tuesday, a recording; no model ran" in page
    assert "Error is tuesday minus record." in page
    assert "Model driven by" not in page
    assert vehicle.title not in page


def test_the_page_says_why_the_speed_is_imposed(compared: Comparison) -> None:
    bare = compared.recording.without_channels(["throttle"])
    whole = replace(bare, channels={
        **dict.fromkeys(INPUT_NAMES, bare["tractor_vx_mps"]), **bare.channels})
    missing, asked = (comparison_page(replace(compared, recording=one, speed_imposed=True), ())
                      for one in (bare, whole))
    assert "because throttle or brake pressures were not recorded" in missing
    assert "the recorded speed is imposed, as asked" in asked


def test_a_report_that_does_not_fit_on_the_disk_leaves_nothing(
    compared: Comparison, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(path: Path, *_: object, **__: object) -> int:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), str(path))

    (tmp_path / "old").mkdir()
    (tmp_path / "old" / "report.html").write_text("before", encoding="utf-8")
    monkeypatch.setattr(Path, "write_text", full)
    for name in ("new", "old"):
        with pytest.raises(StorageError, match=f"{name}: cannot write: No space left"):
            write_comparison_report(compared, tmp_path / name)
    assert [path.relative_to(tmp_path).as_posix() for path in sorted(tmp_path.rglob("*"))] == [
        "old", "old/report.html"]
