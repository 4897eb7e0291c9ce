"""Pictures of where and when model and truck differ: channel by time, force by time."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import SymLogNorm
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.result import BeatScores, ChannelTimeMap, ForceHistory
from truck_blowout_sim.report.style import BLUE, SOFT, WIDE, Picture, new_figure

Floats = NDArray[np.float64]

# Within three sigma lies what noise makes by itself; beyond, each shade is a factor.
_NOISE, _MOST = 3.0, 100.0
_NORM = SymLogNorm(linthresh=_NOISE, linscale=0.35, vmin=-_MOST, vmax=_MOST)
_LEAST_IN = 2.5
_TICKS = (-100, -30, -10, -3, 3, 10, 30, 100)


def map_picture(mismatch: ChannelTimeMap, labels: Mapping[str, str], number: int) -> Picture:
    """Mismatch of every channel over time, as given and as diagnosed."""
    grids = [("model as given", mismatch.before)]
    if mismatch.after is not None:
        grids.append(("model as diagnosed", mismatch.after))
    height = max(1.1 + 0.19 * len(mismatch.channels), _LEAST_IN)  # room for the bar's words
    figure = new_figure((9.6, height))
    panels = figure.subplots(1, len(grids), sharey=True, squeeze=False)[0]
    for axes, (words, grid) in zip(panels, grids, strict=True):
        _grid(axes, mismatch, grid)
        axes.set_title(words)
    panels[0].set_yticks(
        np.arange(len(mismatch.channels)), [labels.get(c, c) for c in mismatch.channels]
    )
    panels[0].tick_params(axis="y", labelsize=8, length=0)
    panels[0].invert_yaxis()
    bar = figure.colorbar(panels[0].collections[0], ax=list(panels), shrink=min(1.0, 3.0 / height),
                          ticks=_TICKS, format="%d", pad=0.01)  # fmt: skip
    bar.minorticks_off()
    bar.set_label("model − record, in σ")
    caption = (
        f"{mismatch.recording} ({mismatch.role}). White: what noise explains; "
        "red: the model reads more than the record, blue: less; gray: not measured."
    )
    return Picture(f"map_{number}", "Mismatch by channel and time", caption, figure)


def _grid(axes: Axes, mismatch: ChannelTimeMap, grid: Floats) -> None:
    edges = np.arange(len(mismatch.channels) + 1) - 0.5
    axes.set_facecolor("#d9dde1")
    axes.pcolormesh(mismatch.time_s, edges, np.clip(grid, -_MOST, _MOST),  # NaN stays blank
                    cmap="RdBu_r", norm=_NORM, rasterized=True)  # fmt: skip
    axes.set_xlabel("time (s)")
    axes.grid(visible=False)


def force_picture(force: ForceHistory, number: int) -> Picture:
    """Missing force and moment of one body over time, with two sigma around."""
    figure = new_figure((WIDE[0], 5.4))
    rows = (
        ("forward (kN)", force.fx_n, force.fx_sigma_n),
        ("left (kN)", force.fy_n, force.fy_sigma_n),
        ("yaw moment (kN m)", force.mz_nm, force.mz_sigma_nm),
    )
    for axes, (words, value, sigma) in zip(figure.subplots(3, 1, sharex=True), rows, strict=True):
        axes.axhline(0.0, color=SOFT, linewidth=0.8)
        low, high = (value - 2 * sigma) / 1e3, (value + 2 * sigma) / 1e3
        axes.fill_between(force.time_s, low, high, color=BLUE, alpha=0.2, linewidth=0)
        axes.plot(force.time_s, value / 1e3, color=BLUE)
        axes.set_ylabel(words)
    axes.set_xlabel("time (s)")
    caption = (
        f"What would have to act on the {force.body} in {force.recording}, about its base_link, "
        "for the model to follow the record; band: ±2σ."
    )
    return Picture(f"force_{number}", f"Missing force on the {force.body}", caption, figure)


def beat_picture(beats: BeatScores) -> Picture:
    """How far each distance or pace that was tried stands above chance."""
    figure = new_figure((WIDE[0], 2.8))
    axes = figure.subplots()
    x = 1.0 / beats.every if beats.kind == "steady" else beats.every
    order = np.argsort(x)
    axes.plot(x[order], beats.score[order], color=BLUE)
    axes.axhline(beats.least, color=SOFT, linewidth=0.8)
    axes.set_xlabel({"turning": "distance from beat to beat (m): one wheel turn",
                     "swinging": "distance from swing to swing (m)"}.get(
                         beats.kind, "beats a second"))
    axes.set_ylabel("standard errors above chance")
    caption = ("What the model leaves of accelerations and rates, all runs together, at the full "
               "rate of the recording. Line: from here on it counts.")
    return Picture("beats", "Something beats", caption, figure)
