"""Figures 3 to 6 and 29 to 37: the test's record and our runs of it."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from truck_blowout_sim.comparison.units import display_unit
from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.report.thesis.canvas import (
    BAND,
    MEASURED,
    OURS_LINE,
    THESIS_LINE,
    blowout_line,
    canvas,
    curve,
    legend,
    remark,
    shifted_path,
    stated_points,
)
from truck_blowout_sim.simulation.thesis_data import OURS, THESIS, ThesisData

SPEED, YAW, WHEEL = "tractor_vx_mps", "tractor_yaw_rate_radps", "steering_wheel_angle_rad"
_RECORD = "record, rebuilt from the text"
_FT = 1.0 / 0.3048


def record_speed(data: ThesisData, stated: str) -> Figure:
    """Figure 3."""
    figure, (axes,) = canvas(stated)
    curve(axes, _log(data), SPEED, _RECORD, MEASURED, axes_kind="iso")
    stated_points(axes, [5.0], [50.0])
    return _over_time(figure, axes, "speed (mph)")


def record_yaw(data: ThesisData, stated: str) -> Figure:
    """Figure 4."""
    figure, (axes,) = canvas(stated)
    curve(axes, _log(data), YAW, _RECORD, MEASURED, axes_kind="sae")
    stated_points(axes, [1.0, 4.0], [-2.5, 0.0])
    return _over_time(figure, axes, "yaw rate (deg/s), SAE axes")


def record_steer(data: ThesisData, stated: str) -> Figure:
    """Figure 5."""
    figure, (axes,) = canvas(stated)
    curve(axes, _log(data), WHEEL, _RECORD, MEASURED, axes_kind="sae")
    stated_points(axes, [1.7, 5.0], [40.0, 25.0])
    return _over_time(figure, axes, "hand wheel (deg), right positive")


def record_path(data: ThesisData, stated: str) -> Figure:
    """Figure 6."""
    figure, (axes,) = canvas(stated)
    x, y = shifted_path(_log(data))
    axes.plot(x, -y, color=MEASURED, label=_RECORD)
    axes.axhspan(-16.5, -15.5, **BAND)
    axes.axvline(1053.0, color=BAND["color"], linewidth=4, alpha=0.3, zorder=0.5)
    remark(axes, "1,053 ft, about 16 ft (side not stated)")
    axes.set_ylim(20, -20)
    axes.set(xlabel="along the skid pad (ft)", ylabel="across (ft), right positive, downward")
    legend(axes)
    return figure


def steer_angles(data: ThesisData, stated: str) -> Figure:
    """Figure 29."""
    figure, (axes,) = canvas(stated)
    curve(axes, _log(data), WHEEL, _RECORD, MEASURED, axes_kind="sae", width=3.0)
    for run, name, color in _runs(data):
        curve(axes, run, WHEEL, name, color, axes_kind="sae", line=(0, (4, 3)))
    return _over_time(figure, axes, "hand wheel (deg), right positive")


def steer_input(data: ThesisData, stated: str) -> Figure:
    """Figure 30, also 25 without a number of its own here."""
    figure, (axes,) = canvas(stated)
    curve(axes, data.steer[OURS], WHEEL, "input of the run", OURS_LINE, axes_kind="iso")
    return _over_time(figure, axes, "hand wheel (deg), left positive")


def speeds(data: ThesisData, stated: str) -> Figure:
    """Figure 31."""
    figure, (axes,) = canvas(stated)
    curve(axes, _log(data), SPEED, _RECORD, MEASURED, axes_kind="iso", width=2.2)
    for run, name, color in _runs(data):
        curve(axes, run, SPEED, name, color, axes_kind="iso")
    return _over_time(figure, axes, "speed (mph)")


def speed_error(data: ThesisData, stated: str) -> Figure:
    """Figure 32."""
    figure, (axes,) = canvas(stated)
    axes.axhspan(-0.6, 0.6, label="stated: within 0.6 mph", **BAND)
    _errors(axes, data, SPEED)
    return _over_time(figure, axes, "speed of model minus record (mph)")


def lateral_speed(data: ThesisData, stated: str) -> Figure:
    """Figure 33."""
    figure, (axes,) = canvas(stated)
    for run, name, color in _runs(data):
        curve(axes, run, "tractor_vy_mps", name, color, axes_kind="sae")
    remark(axes, "the rebuilt record has no lateral speed: no error can be drawn")
    return _over_time(figure, axes, "lateral speed of the model (mph), SAE axes")


def yaw_rates(data: ThesisData, stated: str) -> Figure:
    """Figure 34."""
    figure, (axes,) = canvas(stated)
    curve(axes, _log(data), YAW, _RECORD, MEASURED, axes_kind="sae", width=2.2)
    for run, name, color in _runs(data):
        curve(axes, run, YAW, name, color, axes_kind="sae")
    stated_points(axes, [1.0], [-2.5], "stated peak of the test")
    return _over_time(figure, axes, "yaw rate (deg/s), SAE axes")


def paths(data: ThesisData, stated: str) -> Figure:
    """Figure 35."""
    figure, (axes,) = canvas(stated)
    axes.plot(*shifted_path(_log(data)), color=MEASURED, label=_RECORD, linewidth=2.2)
    for run, name, color in _runs(data):
        axes.plot(*shifted_path(run), color=color, label=name)
    at = data.steer[OURS]
    x = float(at.at("tractor_x_m", [0.0])[0] - at["tractor_x_m"].value[0]) * _FT
    blowout_line(axes, x)
    axes.set(xlabel="along (ft)", ylabel="across (ft), left positive")
    legend(axes)
    return figure


def position_error(data: ThesisData, stated: str) -> Figure:
    """Figure 36."""
    figure, (axes,) = canvas(stated)
    axes.axhspan(-1.6, 1.6, label="stated for TruckSim: about 1.6 ft", **BAND)
    _errors(axes, data, "tractor_x_m")
    return _over_time(figure, axes, "distance of model minus record (ft)")


def chambers(data: ThesisData, stated: str) -> Figure:
    """Figure 37."""
    figure, panels = canvas(stated, rows=2, height=5.2)
    for axes, sheet in zip(panels, (OURS, THESIS), strict=True):
        run = data.steer[sheet]
        psi = display_unit("x_pa").per_si
        for k, hub in enumerate(h for h in data.vehicles[sheet].hubs):
            series = run[f"brake_chamber_{hub}_pa"]
            braked = series.value.max() > 1e3
            axes.plot(series.time_s, series.value * psi, linewidth=1.2,
                      label=hub if braked else None, color=None if braked else MEASURED,
                      linestyle=("-", (0, (4, 2)))[k % 2], zorder=3)  # fmt: skip
        axes.set(ylabel="chamber (psi)", title=sheet)
        blowout_line(axes, 0.0, "")
        legend(axes, "upper left")
    panels[-1].set_xlabel("time after the blowout (s)")
    return figure


def _log(data: ThesisData) -> Recording:
    assert data.record is not None
    return data.record


def _runs(data: ThesisData) -> list[tuple[Recording, str, str]]:
    return [(data.steer[OURS], f"model, {OURS}", OURS_LINE),
            (data.steer[THESIS], f"model, {THESIS}", THESIS_LINE)]


def _errors(axes: Axes, data: ThesisData, channel: str) -> None:
    log, per = _log(data), display_unit(channel).per_si
    for run, name, color in _runs(data):
        series = run[channel]
        recorded = log.at(channel, series.time_s)
        if channel.endswith("_x_m"):
            difference = (series.value - series.value[0]) - (recorded - log[channel].value[0])
        else:
            difference = series.value - recorded
        axes.plot(series.time_s, difference * per, color=color, label=name)
        axes.annotate(f"at most {np.nanmax(np.abs(difference)) * per:.2f}",
                      (1.0, 0.02 if color == OURS_LINE else 0.09), xycoords="axes fraction",
                      color=color, fontsize=8, ha="right")  # fmt: skip


def _over_time(figure: Figure, axes: Axes, words: str) -> Figure:
    axes.set(xlabel="time after the blowout (s)", ylabel=words)
    blowout_line(axes, 0.0)
    legend(axes)
    return figure
