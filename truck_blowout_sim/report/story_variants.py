"""The same run with other models: what each part of the physics does to it.

Validated with: test/report/test_story_page.py.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from truck_blowout_sim.comparison import Comparison
from truck_blowout_sim.comparison.units import display_unit
from truck_blowout_sim.report.comparison_lines import draw_measured, event_times, marks_for
from truck_blowout_sim.report.style import (
    BLUE,
    GREEN,
    MODEL,
    Picture,
    mark_events,
    new_figure,
    styled,
)

_SHOWN_S = (-0.5, 4.0)  # from the event
_COLORS = (MODEL, BLUE, GREEN)


@dataclass(frozen=True)
class Variant:
    """One model of the run.

    Attributes:
        words: what it is, in the legend.
        comparison: of the recording with it.
    """

    words: str
    comparison: Comparison

    def after_event(self, channel: str, from_s: float, to_s: float) -> float:
        """Mean of a channel between two times after the first event, less its value there; SI."""
        series, event_s = self.comparison.model[channel], event_times(self.comparison)[0]
        inside = (series.time_s >= event_s + from_s) & (series.time_s <= event_s + to_s)
        return float(series.value[inside].mean() - np.interp(event_s, series.time_s, series.value))


@styled
def variants_picture(variants: Sequence[Variant], channels: Sequence[tuple[str, str]]) -> Picture:
    """Channels, with their titles, of three models around the first event; recorded ones too."""
    first = variants[0].comparison
    event_s = event_times(first)[0]
    figure = new_figure((8.4, 0.8 + 2.6 * len(channels)))
    panels = figure.subplots(len(channels), 1, sharex=True, squeeze=False)[:, 0]
    for axes, (name, title) in zip(panels, channels, strict=True):
        unit = display_unit(name)
        if name in first.pairs:
            pair = first.pairs[name]
            draw_measured(axes, pair.time_s, pair.measured * unit.per_si, pair.time_s,
                          marks_for(first, name))  # fmt: skip
        for one, color in zip(variants, _COLORS, strict=True):
            series = one.comparison.model[name]
            axes.plot(series.time_s, series.value * unit.per_si, color=color, label=one.words,
                      zorder=3)
        mark_events(axes, event_times(first), "")
        axes.set_title(title)
        axes.set_ylabel(unit.symbol)
    panels[0].legend(loc="best")
    panels[-1].set_xlim(event_s + _SHOWN_S[0], event_s + _SHOWN_S[1])
    panels[-1].set_xlabel("time (s)")
    return Picture("variants", "The same inputs, other models", "Dashed: the blowout.", figure)
