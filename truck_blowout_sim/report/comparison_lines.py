"""Lines that every figure of a comparison shares: measured, simulated, their difference.

A record rebuilt from text is drawn by what its samples are: stated ones as a broad line, derived
ones as a thin line, interpolated ones dotted, so that nobody takes a drawn line for a measurement.
"""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from truck_blowout_sim.comparison import Comparison
from truck_blowout_sim.comparison.pairing import Pair
from truck_blowout_sim.comparison.provenance import MARKS, Marks
from truck_blowout_sim.recordings.stretches import unbroken
from truck_blowout_sim.report.style import INK, MODEL, SOFT, in_legend, mark_events

Floats = NDArray[np.float64]

_LINE_OF_MARK = {
    "stated": {"linewidth": 3.2, "linestyle": "-", "solid_capstyle": "round"},
    "derived": {"linewidth": 1.3, "linestyle": "-"},
    "interpolated": {"linewidth": 1.3, "linestyle": ":"},
}
_SOURCE_OF = {"along_m": "x_m", "across_m": "y_m"}


def draw_measured(axes: Axes, x: Floats, y: Floats, time_s: Floats, marks: Marks | None,
                  prefix: str = "") -> None:  # fmt: skip
    """The record against anything; in three kinds of line where it was rebuilt from text."""
    if marks is None:
        axes.plot(x, y, color=INK, label=f"{prefix}recorded")
        return
    nearest = np.searchsorted(marks.time_s, time_s + 1e-9, side="right") - 1
    mark = marks.mark[np.clip(nearest, 0, marks.mark.size - 1)]
    for index, word in enumerate(MARKS):
        runs = _runs(mark == index)
        for k, (first, last) in enumerate(runs):
            label = f"{prefix}rebuilt from text: {word}" if k == 0 else None
            axes.plot(x[first:last], y[first:last], color=INK, label=label, **_LINE_OF_MARK[word])  # type: ignore[arg-type]
            if last - first <= 2 and word == "stated":
                axes.plot(x[first], y[first], "o", color=INK, markersize=5)


def draw_both(axes: Axes, comparison: Comparison, name: str) -> None:
    """A channel as recorded and as simulated over time, in the unit people read."""
    pair = comparison.pairs.get(name)
    if pair is None:
        series, unit = comparison.model[name], _unit(name)
        axes.plot(series.time_s, series.value * unit, color=MODEL,
                  label=in_legend(f"{comparison.other} (not recorded)"))
    else:
        scale = pair.unit.per_si
        marks = marks_for(comparison, name)
        draw_measured(axes, pair.time_s, pair.measured * scale, pair.time_s, marks)
        axes.plot(pair.time_s, pair.model * scale, color=MODEL,
                  label=in_legend(comparison.other))
    mark_events(axes, event_times(comparison))
    axes.legend(loc="best", ncols=2)


def draw_error(axes: Axes, comparison: Comparison, name: str) -> None:
    """Model minus record over time, with the band that noise explains."""
    pair = comparison.pairs[name]
    error = comparison[name]
    scale = pair.unit.per_si
    axes.axhline(0.0, color=SOFT, linewidth=0.8)
    if error.noise is not None:
        band = 2.0 * error.noise.value * scale
        axes.axhspan(-band, band, color=INK, alpha=0.08, linewidth=0, label="noise, ±2σ")
    axes.plot(pair.time_s, pair.error * scale, color=MODEL,
              label=in_legend(f"{comparison.other} − record"))
    mark_events(axes, event_times(comparison), "")
    axes.legend(loc="best", ncols=2)


def marks_for(comparison: Comparison, name: str) -> Marks | None:
    """Marks of a channel, those of x or y for a position along or across."""
    unit, _, stem = name.partition("_")
    source = f"{unit}_{_SOURCE_OF[stem]}" if stem in _SOURCE_OF else name
    return comparison.marks.get(source)


def event_times(comparison: Comparison) -> tuple[float, ...]:
    """Instants of the recorded blowouts."""
    return tuple(event.time_s for event in comparison.recording.blowouts)


def _unit(name: str) -> float:
    empty = np.zeros(0)
    return Pair(name, empty, empty, empty).unit.per_si


def _runs(chosen: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """First and one past the last index of each unbroken run, one further so that lines join."""
    return [(first, min(end + 1, chosen.size)) for first, end in unbroken(chosen)]
