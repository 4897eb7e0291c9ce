"""Pictures of how well the diagnosed model does: overlays, fit by channel, candidates, pulls."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from truck_blowout_sim.comparison.units import display_unit
from truck_blowout_sim.diagnosis.result import Calibrated, Candidate, Fit, Overlay
from truck_blowout_sim.diagnosis.result.evidence import FAR
from truck_blowout_sim.report.style import (
    AFTER,
    BEFORE,
    EVENT,
    INK,
    MEASURED,
    ORANGE,
    SOFT,
    VERMILION,
    Picture,
    new_figure,
    plain_log_ticks,
)

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
_COLUMNS = 2
_ROLES = {"train": "fitted runs", "holdout": "unseen runs"}
_GRAY = "#b5bdc5"
_MOST_BARS = 20
_MOST_CHANNELS = 24
_FIT_CAPTION = ("The error (rms) of the worst channels, in units of their noise σ. At 1 σ noise "
                "explains all that is left. As diagnosed: on fitted runs with start speeds, "
                "instruments and numbers of the sheet fitted, too.")


def overlay_picture(
    overlays: Sequence[Overlay], labels: Mapping[str, str], name: str,
    blowouts: Sequence[tuple[str, float, str]] = (),
) -> Picture:
    """Channels of one recording: record, model as given, model as diagnosed.

    Args:
        overlays: of one recording.
        labels: words for channels.
        name: of the picture.
        blowouts: (recording, instant, tires) to mark.
    """
    rows = -(-len(overlays) // _COLUMNS)
    figure = new_figure((9.6, 2.4 * rows))
    panels = figure.subplots(rows, _COLUMNS, squeeze=False).ravel()
    for axes, overlay in zip(panels, overlays, strict=False):
        _overlay(axes, overlay, labels)
        for recording, time_s, _ in blowouts:
            if recording == overlay.recording:
                axes.axvline(time_s, color=EVENT, linewidth=1.0, linestyle=":")
    for axes in panels[len(overlays) :]:
        axes.remove()
    figure.supxlabel("time (s)", fontsize=9)
    handles, words = panels[0].get_legend_handles_labels()
    figure.legend(handles, words, loc="outside upper right", ncols=3)
    first = overlays[0]
    role = {"train": "fitted to this run", "holdout": "never fitted to this run",
            "baseline": "without the effect"}[first.role]  # fmt: skip
    said = "A run" if first.role == "baseline" else "The diagnosed model was"
    burst = ", ".join(f"{tires} blows at {time_s:.2f} s" for recording, time_s, tires in blowouts
                      if recording == first.recording)  # fmt: skip
    caption = f"{said} {role}." + (f" Dotted line: {burst}." if burst else "")
    return Picture(name, f"{first.recording} ({first.role})", caption, figure)


def _overlay(axes: Axes, overlay: Overlay, labels: Mapping[str, str]) -> None:
    unit = display_unit(overlay.channel)
    axes.set_title(labels.get(overlay.channel, overlay.channel), fontsize=9.5)
    axes.set_ylabel(unit.symbol)
    axes.tick_params(labelsize=8)
    axes.plot(overlay.time_s, overlay.measured * unit.per_si, color=MEASURED, linewidth=1.0,
              label="record")  # fmt: skip
    axes.plot(overlay.time_s, overlay.before * unit.per_si, color=BEFORE, linewidth=1.2,
              linestyle=(0, (4, 2)), label="model as given")  # fmt: skip
    if overlay.after is not None:
        axes.plot(overlay.time_s, overlay.after * unit.per_si, color=AFTER, linewidth=1.4,
                  label="model as diagnosed")  # fmt: skip


def fit_picture(fits: Mapping[str, Fit], labels: Mapping[str, str]) -> Picture:
    """Rms residual of each channel in sigma, before and after, on a logarithmic scale."""
    shown = [(role, fit) for role, fit in fits.items() if fit.before]
    channels = sorted({name for _, fit in shown for name in fit.before},
                      key=lambda n: -max(fit.before.get(n, 0.0) for _, fit in shown)
                      )[:_MOST_CHANNELS]  # fmt: skip
    figure = new_figure((9.6, 1.2 + 0.21 * len(channels)))
    panels = figure.subplots(1, len(shown), sharex=True, sharey=True, squeeze=False)[0]
    for axes, (role, fit) in zip(panels, shown, strict=True):
        axes.set_title(_ROLES.get(role, role))
        axes.axvspan(0.01, 1.0, color=INK, alpha=0.06, linewidth=0)
        before, after = (np.array([one.get(name, np.nan) for name in channels])
                         for one in (fit.before, fit.after))
        rows = np.arange(len(channels))
        axes.hlines(rows, before, after, color=SOFT, linewidth=1.0, zorder=1)
        _dots(axes, before, rows, BEFORE, "o", "as given")
        _dots(axes, after, rows, AFTER, "D", "as diagnosed")
        axes.set_xscale("log")
        plain_log_ticks(axes.xaxis)
        axes.set_xlabel("rms residual (σ)")
    panels[0].set_xlim(0.5, None)
    panels[0].set_yticks(np.arange(len(channels)), [labels.get(c, c) for c in channels])
    panels[0].tick_params(axis="y", labelsize=8, length=0)
    panels[0].set_ylim(len(channels) - 0.5, -0.5)
    panels[-1].legend(loc="lower right")
    return Picture("fit", "Fit by channel", _FIT_CAPTION, figure)


def _dots(axes: Axes, values: Floats, rows: Integers, color: str, marker: str, words: str
          ) -> None:
    axes.plot(np.where(values > 0.0, values, np.nan), rows, marker, color=color, markersize=4.5,
              label=words, linestyle="none")


def candidates_picture(candidates: Sequence[Candidate]) -> Picture:
    """How much of the mismatch each explanation removes, best first."""
    shown = candidates[:_MOST_BARS]
    figure = new_figure((9.6, 0.9 + 0.27 * len(shown)))
    axes = figure.add_subplot()
    colors = [VERMILION if c.accepted else ORANGE if c.aliased else _GRAY for c in shown]
    gains = [max(c.delta_chi2, 0.0) for c in shown]
    axes.barh(np.arange(len(shown)), gains, color=colors, height=0.7)
    axes.set_yticks(np.arange(len(shown)), [f"{c.name}  {c.where}".strip() for c in shown])
    axes.tick_params(axis="y", labelsize=8.5, length=0)
    axes.set_ylim(len(shown) - 0.5, -0.5)
    axes.set_xlabel("fall of the weighted sum of squares (Δχ²)")
    for color, words in ((VERMILION, "named"), (ORANGE, "fits as well"), (_GRAY, "rejected")):
        if color in colors:
            axes.barh([np.nan], [np.nan], color=color, label=words)
    axes.legend(loc="lower right")
    return Picture("candidates", "Candidates", "The longer, the more is explained.", figure)


def pulls_picture(calibrated: Sequence[Calibrated]) -> Picture:
    """How far the recordings move each number of the spec sheet, in its own prior sigma."""
    figure = new_figure((9.6, 1.0 + 0.25 * len(calibrated)))
    axes = figure.add_subplot()
    axes.axvspan(-FAR, FAR, color=INK, alpha=0.06, linewidth=0)
    axes.axvline(0.0, color=SOFT, linewidth=0.8)
    rows, pulls = np.arange(len(calibrated)), np.array([number.pull for number in calibrated])
    errors = np.array([number.sigma / number.prior_sigma for number in calibrated])
    far = np.abs(pulls) > FAR
    for these, color in ((~far, AFTER), (far, VERMILION)):
        axes.errorbar(pulls[these], rows[these], xerr=errors[these], fmt="o", color=color,
                      markersize=4.5)
    axes.set_yticks(np.arange(len(calibrated)), [number.name for number in calibrated])
    axes.tick_params(axis="y", labelsize=8.5, length=0)
    axes.set_ylim(len(calibrated) - 0.5, -0.5)
    axes.set_xlabel("distance from the spec sheet (prior σ)")
    caption = f"Bars: 1 σ of the estimate. Beyond {FAR:g} prior σ a number is not plausible."
    return Picture("calibration", "Spec sheet against recordings", caption, figure)
