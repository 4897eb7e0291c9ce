"""Figures 38 to 45: blowouts of trailer and drive axles in a step steer, over the run without."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from truck_blowout_sim.comparison.units import display_unit
from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.report.style import BLUE, VERMILION
from truck_blowout_sim.report.thesis.canvas import (
    CASES,
    blowout_line,
    canvas,
    legend,
    shifted_path,
)
from truck_blowout_sim.simulation.thesis_data import ThesisData

_UNITS = ("tractor", "trailer")


def trajectories(data: ThesisData, stated: str, axle: str, cases: Sequence[str]) -> Figure:
    """Figures 38, 41, 44: paths of the tractor, and how far each leaves that without blowout."""
    figure, (plan, apart) = canvas(stated, columns=2, height=4.2)
    normal = data.turns[axle, "no blowout"]
    for case in cases:
        run = data.turns[axle, case]
        x, y = shifted_path(run, per_m=1.0)
        plan.plot(x, y, color=CASES[case], label=case, zorder=3,
                  linestyle="-" if case == "no blowout" else (0, (6, 2)))  # fmt: skip
        if case != "no blowout":
            _mark_place(plan, data, axle, case)
            _apart(apart, normal, run, CASES[case], case)
    plan.set(xlabel="x (m)", ylabel="y (m), left positive", title="path of the tractor")
    plan.set_aspect("equal", adjustable="datalim")
    apart.set(xlabel="time (s)", ylabel="distance from the path without blowout (m)")
    blowout_line(apart, 5.0)
    legend(plan)
    legend(apart)
    return figure


def yaw_rates(data: ThesisData, stated: str, axle: str, case: str) -> Figure:
    """Figures 39, 40, 42, 43, 45: both units, with and without."""
    figure, panels = canvas(stated, rows=3, height=6.2)
    for axes, unit, color in zip(panels[:2], _UNITS, (VERMILION, BLUE), strict=True):
        channel = f"{unit}_yaw_rate_radps"
        for name in ("no blowout", case):
            series = data.turns[axle, name][channel]
            axes.plot(series.time_s, series.value * display_unit(channel).per_si, label=name,
                      color=CASES[name], zorder=3)  # fmt: skip
        with_, without = (data.turns[axle, name][channel] for name in (case, "no blowout"))
        change = (with_.value - without.at(with_.time_s)) * display_unit(channel).per_si
        panels[2].plot(with_.time_s, change, color=color, label=unit, zorder=3)
        axes.set(ylabel="yaw rate (deg/s)", title=unit)
        blowout_line(axes, 5.0, "blowout" if unit == "tractor" else "")
        legend(axes)
    panels[2].set(xlabel="time (s)", ylabel="change (deg/s)", title="what the blowout changes")
    blowout_line(panels[2], 5.0, "")
    legend(panels[2])
    return figure


def _mark_place(axes: Axes, data: ThesisData, axle: str, case: str) -> None:
    run = data.turns[axle, case]
    x, y = (float(run.at(f"tractor_{k}_m", [5.0])[0] - run[f"tractor_{k}_m"].value[0])
            for k in "xy")
    axes.plot([x], [y], "v", color=CASES[case], markersize=6, zorder=4)


def _apart(axes: Axes, normal: Recording, run: Recording, color: str, label: str) -> None:
    time = run["tractor_x_m"].time_s
    gap = np.hypot(*(run.at(f"tractor_{k}_m", time) - normal.at(f"tractor_{k}_m", time)
                     for k in "xy"))
    axes.plot(time, gap, color=color, label=label, zorder=3)
