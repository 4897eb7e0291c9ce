from __future__ import annotations

import base64

import matplotlib as mpl
import numpy as np

from truck_blowout_sim.report.style import INK, Picture, new_axes, styled


@styled
def draw() -> Picture:
    figure, axes = new_axes(y="mph")
    axes.plot(np.arange(5.0), np.arange(5.0) ** 2, label="model")
    axes.legend()
    return Picture("speed", "Speed", "Rises.", figure)


def test_the_same_drawing_gives_the_same_bytes() -> None:
    assert draw().png() == draw().png()
    assert draw().svg_uri() == draw().svg_uri()


def test_the_users_own_settings_neither_count_nor_change() -> None:
    plain = draw().png()
    with mpl.rc_context({"lines.linewidth": 9.0, "axes.facecolor": "black", "font.size": 30}):
        assert draw().png() == plain
        assert mpl.rcParams["font.size"] == 30


def test_a_drawing_carries_neither_date_nor_addresses_to_fetch() -> None:
    svg = base64.b64decode(draw().svg_uri().partition(",")[2]).decode()
    assert "<dc:date>" not in svg
    assert 'href="http' not in svg
    assert INK in svg or "#1b1f24" in svg
