"""A figure with what the text of the thesis states of the original beside it."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from typing import Any, Literal

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from truck_blowout_sim.comparison.units import axes_sign, display_unit
from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.report.style import (
    BLUE,
    EVENT,
    GREEN,
    INK,
    ORANGE,
    PURPLE,
    SOFT,
    VERMILION,
    new_figure,
)

MEASURED, OURS_LINE, THESIS_LINE = INK, VERMILION, BLUE
CASES = {"no blowout": INK, "left duals": VERMILION, "right duals": BLUE, "left outer": GREEN}
STATED: dict[str, Any] = {"marker": "o", "markersize": 7, "markerfacecolor": "none",
                          "markeredgecolor": PURPLE, "markeredgewidth": 1.6,
                          "linestyle": "none", "zorder": 5}  # fmt: skip
BAND: dict[str, Any] = {"color": ORANGE, "alpha": 0.18, "linewidth": 0.0, "zorder": 0.5}
Line = str | tuple[float, tuple[float, ...]]
_SIZE, _NOTE_WIDTH = (9.6, 4.0), 34


def canvas(stated: str, rows: int = 1, columns: int = 1, *, height: float = _SIZE[1],
           share_x: bool = True) -> tuple[Figure, list[Axes]]:
    """Axes at the left, the statement of the thesis at the right."""
    figure = new_figure((_SIZE[0], height))
    parts: Any = figure.subfigures(1, 2, width_ratios=(3.0, 1.0))
    left, right = parts
    axes = left.subplots(rows, columns, squeeze=False, sharex=share_x and rows > 1)
    side = right.add_subplot()
    side.axis("off")
    side.text(0.0, 0.97, "The text of the thesis", weight="bold", color=SOFT, fontsize=9, va="top",
              transform=side.transAxes)  # fmt: skip
    side.text(0.0, 0.90, "\n".join(textwrap.wrap(stated, _NOTE_WIDTH)), color=INK, fontsize=8.8,
              va="top", linespacing=1.45, transform=side.transAxes)  # fmt: skip
    return figure, list(axes.ravel())


def curve(axes: Axes, run: Recording, channel: str, label: str, color: str, *, axes_kind: str,
          units: str = "us", width: float = 1.6, line: Line = "-") -> None:
    """One channel over time in printed units."""
    series = run[channel]
    factor = display_unit(channel, units).per_si * axes_sign(channel, axes_kind)
    axes.plot(series.time_s, series.value * factor, color=color, label=label, linewidth=width,
              linestyle=line, zorder=3)


def blowout_line(axes: Axes, time_s: float, words: str = "blowout") -> None:
    """The instant, under the curves; its word above the panel."""
    axes.axvline(time_s, color=EVENT, linewidth=1.0, linestyle=(0, (4, 3)), zorder=1)
    if words:
        axes.annotate(words, (time_s, 1.0), xycoords=("data", "axes fraction"), xytext=(0, 3),
                      textcoords="offset points", ha="center", va="bottom", color=EVENT,
                      fontsize=8)  # fmt: skip


def remark(axes: Axes, words: str) -> None:
    """A sentence above the panel, at its right, where no curve runs."""
    axes.annotate(words, (1.0, 1.0), xycoords="axes fraction", xytext=(0, 3),
                  textcoords="offset points", ha="right", va="bottom", fontsize=8)


def legend(axes: Axes, where: Literal["best", "upper left"] = "best") -> None:
    """Curves by name."""
    if axes.get_legend_handles_labels()[0]:
        axes.legend(loc=where)


def stated_points(axes: Axes, x: Sequence[float], y: Sequence[float], label: str = "stated"
                  ) -> None:
    """Open circles where the text states a number."""
    axes.plot(x, y, label=label, **STATED)


def shifted_path(run: Recording, unit: str = "tractor", per_m: float = 1.0 / 0.3048
                 ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Path from the run's first point, in feet unless told otherwise."""
    x, y = run[f"{unit}_x_m"], run[f"{unit}_y_m"]
    return (x.value - x.value[0]) * per_m, (y.value - y.value[0]) * per_m
