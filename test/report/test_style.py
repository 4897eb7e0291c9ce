from __future__ import annotations

import matplotlib as mpl
import numpy as np

from truck_blowout_sim.report.style import INK, Picture, new_axes, plain_log_ticks, styled


@styled
def draw() -> Picture:
    figure, axes = new_axes(y="mph")
    axes.plot(np.arange(5.0), np.arange(5.0) ** 2, label="model")
    axes.legend()
    return Picture("speed", "Speed", "Rises.", figure)


def test_the_same_drawing_gives_the_same_bytes() -> None:
    assert draw().png() == draw().png()
    assert draw().saved("svg") == draw().saved("svg")


def test_the_users_own_settings_neither_count_nor_change() -> None:
    plain = draw().png()
    with mpl.rc_context({"lines.linewidth": 9.0, "axes.facecolor": "black", "font.size": 30}):
        assert draw().png() == plain
        assert mpl.rcParams["font.size"] == 30


def test_a_drawing_carries_neither_date_nor_addresses_to_fetch() -> None:
    svg = draw().saved("svg").decode()
    assert "<dc:date>" not in svg
    assert 'href="http' not in svg
    assert INK in svg


@styled
def draw_logarithmic() -> Picture:
    figure, axes = new_axes()
    axes.plot([0.0, 1.0], [0.05, 200.0])
    axes.set_yscale("log")
    plain_log_ticks(axes.yaxis)
    return Picture("log", "Log", "Rises.", figure)


def test_a_logarithmic_axis_has_plain_numbers() -> None:
    picture = draw_logarithmic()
    picture.png()
    words = {label.get_text() for label in picture.figure.axes[0].get_yticklabels(which="both")}
    assert {"0.1", "1", "10", "100"} <= words
    assert not [text for text in words if "$" in text]
