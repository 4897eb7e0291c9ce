"""The figures that a blowout test is judged by, model against record.

They are those of the published comparison of the 2013 test: speed and its error, lateral speed
error, yaw rate and its error, trajectory, position error, brake chamber pressures, steering.

References: V. Chakravarthy, Ohio State University, 2013, figures 29 and 31-37.
Validated with: test/report/test_comparison_page.py.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from truck_blowout_sim.comparison import Comparison
from truck_blowout_sim.comparison.units import display_unit
from truck_blowout_sim.report.comparison_lines import (
    draw_both,
    draw_error,
    draw_measured,
    event_times,
    marks_for,
)
from truck_blowout_sim.report.style import (
    BLUE,
    EVENT,
    INK,
    MODEL,
    WIDE,
    Picture,
    in_legend,
    mark_events,
    new_axes,
    new_figure,
    styled,
)
from truck_blowout_sim.vehicle.units import FOOT_M, PSI_PA

_TALL = (WIDE[0], 5.2)
_QUIET_PA = 2.0 * PSI_PA
_STEERING = "steering_wheel_angle_rad"


@styled
def comparison_pictures(comparison: Comparison) -> tuple[Picture, ...]:
    """Every figure for which the recording has the channels."""
    return tuple(_pictures(comparison))


def _pictures(comparison: Comparison) -> Iterator[Picture]:
    if _STEERING in comparison.recording:
        yield _steering(comparison)
    yield from _with_error(comparison, "tractor_vx_mps", "speed", "Longitudinal speed", "forward")
    yield from _with_error(
        comparison, "tractor_vy_mps", "lateral_speed", "Lateral speed", "left positive"
    )
    for unit in comparison.vehicle.units:
        title = f"Yaw rate of the {unit}"
        name = f"{unit}_yaw_rate_radps"
        words = "counter-clockwise (left) positive"
        yield from _with_error(comparison, name, f"yaw_rate_{unit}", title, words)
    if "tractor_along_m" in comparison:
        yield _trajectory(comparison)
        yield _position_error(comparison)
    yield from _pressures(comparison)


def _with_error(
    comparison: Comparison, name: str, file: str, title: str, words: str
) -> Iterator[Picture]:
    """A channel above, its error below; the model alone where it was not recorded."""
    if name not in comparison.model:
        return
    symbol = display_unit(name).symbol
    if name not in comparison.pairs:
        figure, axes = new_axes(y=symbol)
        axes.set_title(f"{title}, {words}")
        draw_both(axes, comparison, name)
        yield Picture(file, title, f"Not recorded: {comparison.against} alone.", figure)
        return
    figure = new_figure(_TALL)
    upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=(3, 2))
    upper.set_title(f"{title}, {words}")
    upper.set_ylabel(symbol)
    lower.set_ylabel(f"error, {symbol}")
    lower.set_xlabel("time (s)")
    draw_both(upper, comparison, name)
    draw_error(lower, comparison, name)
    yield Picture(file, title, _error_words(comparison, name), figure)


def _error_words(comparison: Comparison, name: str) -> str:
    error = comparison[name]
    if error.imposed:
        return "The model was made to follow this channel, so the error says nothing."
    words = (
        f"Error {error.shown(error.rms)} rms, at most {error.shown(abs(error.peak))}"
        f" at {error.peak_time_s:.2f} s"
    )
    if error.rms_sigma is not None:
        words += f"; {error.rms_sigma:.1f} times the channel's noise"
    if error.rating is not None:
        words += f"; ISO/TS 18571 rating {error.rating.overall:.2f} ({error.rating.grade})"
    return words + "."


def _steering(comparison: Comparison) -> Picture:
    figure, axes = new_axes(y="deg")
    axes.set_title("Hand-wheel angle, left positive")
    series = comparison.recording[_STEERING]
    degrees = np.degrees(series.value)
    draw_measured(axes, series.time_s, degrees, series.time_s, comparison.marks.get(_STEERING))
    mark_events(axes, event_times(comparison))
    axes.legend(loc="best")
    given = "" if comparison.of_recordings else "; the model is given it"
    return Picture("steering", "Steering", f"What the driver did{given}.", figure)


def _trajectory(comparison: Comparison) -> Picture:
    along, across = comparison.pairs["tractor_along_m"], comparison.pairs["tractor_across_m"]
    figure, axes = new_axes(x="along the first course (ft)", y="to the left (ft)")
    axes.set_title("Path of the tractor")
    marks = marks_for(comparison, "tractor_across_m")
    draw_measured(
        axes, along.measured / FOOT_M, across.measured / FOOT_M, along.time_s, marks
    )
    axes.plot(along.model / FOOT_M, across.model / FOOT_M, color=MODEL,
              label=in_legend(comparison.other))
    for k, time_s in enumerate(event_times(comparison)):
        at = [np.interp(time_s, p.time_s, p.measured) / FOOT_M for p in (along, across)]
        axes.plot(*at, "x", color=EVENT, markersize=9, markeredgewidth=2,
                  label="blowout" if k == 0 else None)  # fmt: skip
    _room_above(axes, 10.0)
    axes.legend(loc="best", ncols=2)
    return Picture("trajectory", "Trajectory", "The two scales differ.", figure)


def _room_above(axes: Axes, least: float) -> None:
    """Keep a straight path from looking like a wild one."""
    low, high = axes.get_ylim()
    if high - low < least:
        middle = (low + high) / 2
        axes.set_ylim(middle - least / 2, middle + least / 2)


def _position_error(comparison: Comparison) -> Picture:
    figure, axes = new_axes(y=f"{comparison.other} − record (ft)")
    axes.set_title("Position error of the tractor")
    axes.axhline(0.0, color=EVENT, linewidth=0.8)
    for name, color, words in (
        ("tractor_along_m", BLUE, "along, ahead positive"),
        ("tractor_across_m", MODEL, "across, left positive"),
    ):
        pair = comparison.pairs[name]
        axes.plot(pair.time_s, pair.error / FOOT_M, color=color, label=words)
    mark_events(axes, event_times(comparison))
    axes.legend(loc="best")
    along, across = comparison["tractor_along_m"], comparison["tractor_across_m"]
    words = (
        f"At most {along.shown(abs(along.peak))} along and {across.shown(abs(across.peak))} across;"
        " speed and heading errors add up over time."
    )
    return Picture("position_error", "Position error", words, figure)


def _pressures(comparison: Comparison) -> Iterator[Picture]:
    """One panel an axle that was braked; the others are named in the caption."""
    braked: list[str] = []
    quiet: list[str] = []
    for axle in comparison.vehicle.axles:
        names = [f"brake_chamber_{axle}_{side}_pa" for side in ("left", "right")]
        known = [np.max(comparison.model[name].value) for name in names if name in comparison.model]
        if known:
            (braked if max(known) > _QUIET_PA else quiet).append(axle)
    if not braked:
        return
    words = (f"{_listed(quiet)}: no pressure in {comparison.against}." if quiet
             else "Every axle is braked.")
    figure = new_figure((WIDE[0], 1.2 + 1.9 * len(braked)))
    _pressure_panels(figure, comparison, braked)
    yield Picture("brake_pressures", "Brake chamber pressures", words, figure)


def _pressure_panels(figure: Figure, comparison: Comparison, axles: list[str]) -> None:
    panels = figure.subplots(len(axles), 1, sharex=True, sharey=True, squeeze=False)[:, 0]
    for axes, axle in zip(panels, axles, strict=True):
        axes.set_title(f"Brake chambers of {axle}, gauge")
        axes.set_ylabel("psi")
        _control_pressure(axes, comparison, axle)
        for side, line in (("left", "-"), ("right", (0, (5, 2)))):
            name = f"brake_chamber_{axle}_{side}_pa"
            if name in comparison.recording:
                series = comparison.recording[name]
                axes.plot(series.time_s, series.value / PSI_PA, color=INK, linestyle=line,
                          label=f"recorded, {side}", linewidth=1.0)  # fmt: skip
            if name in comparison.model:
                series = comparison.model[name]
                axes.plot(series.time_s, series.value / PSI_PA, color=MODEL, linestyle=line,
                          label=in_legend(f"{comparison.other}, {side}"))  # fmt: skip
        mark_events(axes, event_times(comparison), height=0.15)  # pressures begin at 0
        axes.legend(loc="best", ncols=2, frameon=True, framealpha=1.0, edgecolor="none")
    panels[-1].set_xlabel("time (s)")


def _control_pressure(axes: Axes, comparison: Comparison, axle: str) -> None:
    """The pressure the driver asked for, where no chamber of the axle was recorded."""
    name = f"brake_pressure_{comparison.vehicle.spec.axles[axle].circuit}_pa"
    chambers = [f"brake_chamber_{axle}_{side}_pa" for side in ("left", "right")]
    if name not in comparison.recording or any(c in comparison.recording for c in chambers):
        return
    series = comparison.recording[name]
    marks = comparison.marks.get(name)
    draw_measured(axes, series.time_s, series.value / PSI_PA, series.time_s, marks,
                  "control pressure, ")  # fmt: skip


def _listed(names: list[str]) -> str:
    return ", ".join(names)
