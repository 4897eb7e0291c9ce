"""Plots of any channel: units, axes, overlay, typos, and that the blowout hides no curve."""

from __future__ import annotations

import json
import warnings
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from matplotlib.image import imread

from truck_blowout_sim import Blowout, Recording, Series, write_recording
from truck_blowout_sim.cli.main import main
from truck_blowout_sim.report.channel_plots import PlotRequest, channel_plot

TIME = np.linspace(0.0, 4.0, 41)
RUN = Recording("run", {
    "tractor_yaw_rate_radps": Series(TIME, np.radians(TIME)),
    "tractor_vx_mps": Series(TIME, 20.0 + 0.0 * TIME),
    "tractor_x_m": Series(TIME, 20.0 * TIME),
}, (Blowout(2.0, ("steer_left",)),))  # fmt: skip
YAW = PlotRequest((("tractor_yaw_rate_radps",),))
RECORD = "test_2013_steer_blowout"


def lines(request: PlotRequest, runs: list[Recording] | None = None) -> list:
    axes = channel_plot(runs or [RUN], request, "plot").figure.axes[0]
    return [line for line in axes.lines if len(line.get_xdata()) > 2]


def test_units_and_axes_are_those_asked_for() -> None:
    assert lines(YAW)[0].get_ydata()[-1] == pytest.approx(4.0)
    sae = PlotRequest(YAW.panels, axes="sae")
    assert lines(sae)[0].get_ydata()[-1] == pytest.approx(-4.0)
    si, us = (PlotRequest((("tractor_vx_mps",),), units=units) for units in ("si", "us"))
    assert lines(si)[0].get_ydata()[0] == pytest.approx(20.0)
    assert lines(us)[0].get_ydata()[0] == pytest.approx(44.739, abs=1e-3)


def test_the_axis_says_its_unit_and_side() -> None:
    figure = channel_plot([RUN], PlotRequest(YAW.panels, axes="sae"), "plot").figure
    assert "deg/s" in figure.axes[0].get_ylabel()


def test_runs_are_told_apart_by_color_and_dash() -> None:
    first, second = lines(YAW, [RUN, RUN])
    assert first.get_color() != second.get_color()
    assert first.get_linestyle() != second.get_linestyle()


@pytest.mark.parametrize("channel", ["tire_fz_{}_n", "hub_load_of_a_long_name_{}_n"])
def test_a_legend_of_many_lines_fits_below_its_panel(channel: str) -> None:
    names = tuple(channel.format(f"{side}_{k}") for k in range(27) for side in ("left", "right"))
    run = replace(RUN, channels={name: Series(TIME, TIME) for name in names})
    picture = channel_plot([run], PlotRequest((names, names[:2])), "plot")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        picture.png()
    panel, place, last = picture.figure.axes
    legend = place.get_legend()
    assert len(legend.get_texts()) == len(names)
    box = legend.get_window_extent().transformed(picture.figure.transFigure.inverted())
    assert box.x0 >= 0.0
    assert box.x1 <= 1.0
    assert last.get_position().y1 < box.y0
    assert box.y1 < panel.get_position().y0
    assert last.get_position().height * picture.figure.get_size_inches()[1] > 1.5


def test_the_blowout_lies_under_the_curves_and_its_word_above_the_panel() -> None:
    axes = channel_plot([RUN], YAW, "plot").figure.axes[0]
    mark = next(line for line in axes.lines if len(line.get_xdata()) == 2)
    assert mark.get_zorder() < lines(YAW)[0].get_zorder()
    words = axes.texts[0]
    assert "steer_left" in words.get_text()
    assert words.xy[1] >= 1.0


def test_another_channel_may_stand_on_the_horizontal_axis() -> None:
    over = PlotRequest(YAW.panels, over="tractor_x_m", units="si")
    assert lines(over)[0].get_xdata()[-1] == pytest.approx(80.0)


def test_a_ring_under_the_curve_marks_the_blowout_over_another_channel() -> None:
    axes = channel_plot([RUN], PlotRequest(YAW.panels, over="tractor_x_m", units="si"),
                        "plot").figure.axes[0]  # fmt: skip
    curve, ring = axes.lines
    burst_s = RUN.blowouts[0].time_s
    assert ring.get_xdata() == pytest.approx([RUN.at("tractor_x_m", np.array([burst_s]))[0]])
    assert ring.get_zorder() < curve.get_zorder()
    assert axes.texts[0].get_text() == "blown: steer_left"


def test_every_format_is_written_and_dark_paper_is_dark(tmp_path: Path) -> None:
    words = ["plot", RECORD, "-c", "tractor_vx_mps", "steering_wheel_angle_rad", "--format", "png",
             "svg", "pdf", "--dark", "-o", str(tmp_path)]
    assert main(words) == 0
    assert sorted(path.suffix for path in tmp_path.iterdir()) == [".pdf", ".png", ".svg"]
    image = imread(tmp_path / "plot.png")
    assert np.median(image[..., :3]) < 0.2
    assert main(words) == 2


@pytest.mark.parametrize(("words", "said"), [
    (["-c", "tractor_yawrate_radps"], "tractor_yaw_rate_radps"),
    (["-c", "no_such_*"], "--list"),
    (["--units", "use"], "us"),
    (["--axes", "iso8855"], "iso"),
    (["--format", "jpg"], "png"),
])  # fmt: skip
def test_a_wrong_word_is_refused_with_what_was_meant(
    words: list[str], said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["plot", RECORD, *words, "-o", str(tmp_path)]) == 2
    error = capsys.readouterr().err
    assert said in error
    assert error.count("\n") == 1


def test_a_run_of_any_format_lists_its_channels(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    bag = write_recording(RUN, tmp_path / "bag")
    assert main(["plot", str(bag), "--list", "--json"]) == 0
    assert "tractor_x_m" in json.loads(capsys.readouterr().out)["channels"]["bag"]


def test_names_of_runs_stand_in_the_legend_as_they_are() -> None:
    """No formula between two dollars, and none left out for its first letter."""
    names = ("_first", "cost_$5_and_$6", "_<b>$x^$")
    picture = channel_plot([replace(RUN, name=name) for name in names], YAW, "plot")
    words = picture.figure.axes[0].get_legend().get_texts()
    assert [one.get_text().strip() for one in words] == list(names)
    assert not any(one.get_parse_math() for one in words)
    assert picture.png()[:4] == b"\x89PNG"


@pytest.mark.parametrize(("span", "said"), [
    (["--start", "100"], "--start 100"), (["--end", "-5"], "--end -5"),
])
def test_a_time_outside_of_every_run_is_refused_with_the_times(
    span: list[str], said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write_recording(RUN, tmp_path / "run.csv")
    assert main(["plot", str(tmp_path / "run.csv"), *span, "-o", str(tmp_path / "out")]) == 2
    line = capsys.readouterr().err.splitlines()[-1]
    assert f"{said}: no run has anything there; expected times in 0 to 4 s" in line
    assert not (tmp_path / "out").exists()
