"""Words of an axis and of its legend: what names share, and what tells them apart."""

from __future__ import annotations

import numpy as np
import pytest

from truck_blowout_sim import Recording, Series
from truck_blowout_sim.report.channel_plots import PlotRequest, channel_plot
from truck_blowout_sim.report.common_words import shared_words


@pytest.mark.parametrize(("names", "shared", "own"), [
    (("yaw rate of the tractor", "yaw rate of the trailer"), "yaw rate", ["tractor", "trailer"]),
    (("force of tire steer_left, left positive", "force of tire steer_right, left positive"),
     "force of tire, left positive", ["steer_left", "steer_right"]),
    (("pressure of the steer circuit, gauge", "pressure of the drive circuit, gauge"),
     "pressure of the circuit, gauge", ["steer", "drive"]),
    (("forward speed", "throttle"), "", ["forward speed", "throttle"]),
    (("yaw rate", "yaw rate of the trailer"), "", ["yaw rate", "yaw rate of the trailer"]),
    (("yaw rate of the tractor",), "yaw rate of the tractor", ["yaw rate of the tractor"]),
])  # fmt: skip
def test_names_are_split_into_shared_and_own_words(
    names: tuple[str, ...], shared: str, own: list[str]
) -> None:
    assert shared_words(names) == (shared, own)


def test_a_panel_of_two_channels_names_quantity_unit_and_each_curve() -> None:
    time = np.linspace(0.0, 1.0, 5)
    names = ("tractor_yaw_rate_radps", "trailer_yaw_rate_radps")
    run = Recording("run", {name: Series(time, 0.1 * time) for name in names})
    axes = channel_plot([run], PlotRequest((names,)), "plot").figure.axes[0]
    assert axes.get_ylabel() == "yaw rate (deg/s)"
    assert [words.get_text() for words in axes.get_legend().get_texts()] == ["tractor", "trailer"]


def test_all_tires_in_one_panel_differ_in_color_or_dash_on_dark_paper_too() -> None:
    time = np.linspace(0.0, 1.0, 5)
    names = tuple(f"tire_pressure_{tire}_pa" for tire in (
        "steer_left", "steer_right", "drive_1_left_outer", "drive_1_left_inner",
        "drive_1_right_outer", "drive_1_right_inner", "drive_2_left_outer"))  # fmt: skip
    run = Recording("run", {name: Series(time, 7e5 + 0.0 * time) for name in names})
    picture = channel_plot([run], PlotRequest((names,)), "plot")
    picture.saved("png", dark=True)
    looks = {(line.get_color(), str(line.get_linestyle()), line.is_dashed())
             for line in picture.figure.axes[0].lines}  # fmt: skip
    assert len(looks) == len(names)
