"""Plots of any channel of any run, overlaid.

A panel shows one channel of several runs (a color each), or several channels (a color each, a dash
for each further run). The legend of many lines lies below their panel. The blowout is a thin line
under the curves with its name above the panel; over another channel than time it is a ring around
the point of the curve.

Validated with: test/report/test_channel_plots.py.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from truck_blowout_sim.comparison.units import axes_sign, display_unit
from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.recordings.channels import by_name
from truck_blowout_sim.recordings.names import parts_of
from truck_blowout_sim.report.common_words import shared_words
from truck_blowout_sim.report.style import CYCLE, EVENT, Picture, in_legend, new_figure, styled

TIME = "time_s"
_DASHES: tuple[Any, ...] = ("-", (0, (5, 2)), (0, (1.5, 1.5)), (0, (6, 2, 1.5, 2)))
_PANEL_HEIGHT, _WIDTH, _LEGEND_ROWS = 2.3, 8.4, 10
# of a legend's entries, in inches
_LEGEND_LINE, _LETTER_WIDTH, _HANDLE_WIDTH, _LEGEND_WIDTH = 0.19, 0.075, 0.55, 7.5
_SAE = "\nSAE axes: right, down and clockwise are positive"
_TURNED = (("left positive", "right positive"), ("left side up", "right side up"),
           ("to the left", "to the right"), ("nose down", "nose up"), ("upward", "downward"))


@dataclass(frozen=True)
class PlotRequest:
    """What is plotted, and how.

    Attributes:
        panels: channels of each panel, from top to bottom.
        over: channel on the horizontal axis; ``time_s`` for time.
        units: ``us`` or ``si``.
        axes: ``iso`` or ``sae``.
        start_s, end_s: part of the runs.
    """

    panels: tuple[tuple[str, ...], ...]
    over: str = TIME
    units: str = "us"
    axes: str = "iso"
    start_s: float | None = None
    end_s: float | None = None


@styled
def channel_plot(runs: Sequence[Recording], request: PlotRequest, name: str) -> Picture:
    """One figure with a panel for each group of channels.

    A run that lacks a channel is left out of its panel; a panel that no run has is left empty.
    """
    figure, shared = new_figure(), request.over == TIME
    many = [_lines(runs, channels) > _LEGEND_ROWS for channels in request.panels]
    grid = figure.add_gridspec(len(many) + sum(many), 1)
    panels: list[Axes] = []
    heights: list[float] = []
    for channels, below in zip(request.panels, many, strict=True):
        axes = figure.add_subplot(grid[len(heights)],
                                  sharex=panels[0] if shared and panels else None)
        panels.append(axes)
        heights.append(_PANEL_HEIGHT)
        _panel(axes, runs, channels, request)
        if below:
            heights.append(_legend_below(axes, figure.add_subplot(grid[len(heights)])))
        elif len(channels) > 1 or len(runs) > 1:
            axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), borderaxespad=0.3)
    grid.set_height_ratios(heights)
    figure.set_size_inches(_WIDTH, 0.9 + sum(heights))
    for axes in panels[:-1] if shared else ():
        axes.tick_params(labelbottom=False)
    if shared:
        for axes in panels:
            _mark(axes, runs, named=axes is panels[0])
    for axes in panels if not shared else panels[-1:]:
        over = "time (s)" if shared else _label(_words(runs, request.over, request),
                                                [request.over], request)
        axes.set_xlabel(over + ("" if request.axes == "iso" else _SAE))
    words = ", ".join(run.name for run in runs)
    return Picture(name, words, "; ".join("+".join(group) for group in request.panels), figure)


def _lines(runs: Sequence[Recording], channels: Sequence[str]) -> int:
    return sum(channel in run for run in runs for channel in channels)


def _legend_below(axes: Axes, place: Axes) -> float:
    """The legend of many lines in a place of its own below their panel; returns its height."""
    handles, labels = axes.get_legend_handles_labels()
    width = _HANDLE_WIDTH + _LETTER_WIDTH * max(map(len, labels))
    columns = max(int(_LEGEND_WIDTH / width), 1)
    place.set_axis_off()
    legend = place.legend(handles, labels, loc="upper left", ncols=columns, borderaxespad=0.0)
    legend.set_in_layout(False)  # its place is as high as it is; more would squeeze the panel
    return _LEGEND_LINE * (math.ceil(len(labels) / columns) + 1)


def _panel(axes: Axes, runs: Sequence[Recording], channels: Sequence[str], request: PlotRequest
           ) -> None:
    common, own = shared_words([_words(runs, channel, request) for channel in channels])
    several = len(channels) > 1
    for r, run in enumerate(runs):
        for c, channel in enumerate(channels):
            if channel not in run:
                continue
            x, y = _values(run, channel, request)
            words = [w for w, shown in ((own[c], several), (run.name, len(runs) > 1)) if shown]
            turns, color = divmod(c, len(CYCLE)) if several else (0, r % len(CYCLE))
            axes.plot(x, y, color=CYCLE[color], linestyle=_DASHES[(r + turns) % len(_DASHES)],
                      label=in_legend(", ".join(words) or channel), zorder=3)  # fmt: skip
            if request.over != TIME:
                _ring(axes, run, channel, request)
    axes.set_ylabel(_label(common, channels, request))


def _values(run: Recording, channel: str, request: PlotRequest) -> tuple[Any, Any]:
    series = run[channel].between(*_span(run, request))
    y = _shown(channel, series.value, request)
    if request.over == TIME:
        return series.time_s, y
    return _shown(request.over, run.at(request.over, series.time_s), request), y


def _span(run: Recording, request: PlotRequest) -> tuple[float, float]:
    return (run.start_s if request.start_s is None else request.start_s,
            run.end_s if request.end_s is None else request.end_s)


def _shown(channel: str, values: Any, request: PlotRequest) -> Any:  # noqa: ANN401
    """Values of a channel in the units and axes that were asked for."""
    return values * (display_unit(channel, request.units).per_si
                     * axes_sign(channel, request.axes))


def _ring(axes: Axes, run: Recording, channel: str, request: PlotRequest) -> None:
    """Blowouts on a curve over another channel than time: a ring around the point, named."""
    start_s, end_s = _span(run, request)
    for event in run.blowouts:
        if not start_s <= event.time_s <= end_s:
            continue
        x, y = (float(_shown(name, run.at(name, np.array([event.time_s])), request)[0])
                for name in (request.over, channel))
        axes.plot(x, y, "o", markersize=9, markerfacecolor="none", markeredgecolor=EVENT,
                  zorder=1)  # fmt: skip
        axes.annotate("blown: " + ", ".join(event.tires), (x, y), xytext=(0, 9),
                      textcoords="offset points", ha="center", va="bottom", color=EVENT,
                      fontsize=8)  # fmt: skip


def _words(runs: Sequence[Recording], channel: str, request: PlotRequest) -> str:
    """The quantity in words, with the side that is positive in the axes asked for."""
    table = by_name(parts_of([name for run in runs for name in run.channels]).table())
    words = table[channel].quantity if channel in table else channel
    if display_unit(channel, request.units).symbol == "%":
        words = words.partition(",")[0]  # not "0 to 1"
    for ours, theirs in _TURNED if axes_sign(channel, request.axes) < 0.0 else ():
        words = words.replace(ours, theirs)
    return words


def _label(words: str, channels: Sequence[str], request: PlotRequest) -> str:
    """Words with the units, on two lines where they are long."""
    symbols = ", ".join(filter(None, dict.fromkeys(
        display_unit(channel, request.units).symbol for channel in channels)))  # fmt: skip
    return f"{_folded(words)} ({symbols})" if words and symbols else words or symbols


def _folded(words: str) -> str:
    if len(words) < 26:
        return words
    at = words.find(", ") + 1 or words.find(" ", len(words) // 2 - 2)
    return words if at < 0 else f"{words[:at]}\n{words[at + 1:]}"


def _mark(axes: Axes, runs: Sequence[Recording], *, named: bool) -> None:
    """Blowouts: a line under the curves, the tire's name above the panel."""
    low, high = axes.get_xlim()
    events: dict[float, list[str]] = {}
    for run in runs:
        for event in run.blowouts:
            events.setdefault(round(event.time_s, 3), []).extend(event.tires)
    for time_s, tires in events.items():
        if not low <= time_s <= high:
            continue
        axes.axvline(time_s, color=EVENT, linewidth=1.0, linestyle=(0, (4, 3)), zorder=1)
        if named:
            axes.annotate("blown: " + ", ".join(dict.fromkeys(tires)), (time_s, 1.0),
                          xycoords=("data", "axes fraction"), xytext=(0, 3),
                          textcoords="offset points", ha="center", va="bottom", color=EVENT,
                          fontsize=8, annotation_clip=False)  # fmt: skip
    axes.set_xlim(low, high)
