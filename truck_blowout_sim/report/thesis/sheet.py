"""Figures 10 to 17: axes, brake torque, springs, and tire parameters in a blowout."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from truck_blowout_sim.recordings.units import GRAVITY_MPS2
from truck_blowout_sim.report.style import INK, SOFT, plain_log_ticks
from truck_blowout_sim.report.thesis.canvas import (
    OURS_LINE,
    THESIS_LINE,
    blowout_line,
    canvas,
    legend,
    remark,
)
from truck_blowout_sim.simulation.thesis_data import OURS, THESIS, ThesisData
from truck_blowout_sim.vehicle.schema.axle import AxleSpec
from truck_blowout_sim.vehicle.statics import static_loads
from truck_blowout_sim.vehicle.units import PSI_PA

_LINES = {OURS: OURS_LINE, THESIS: THESIS_LINE}
_TRAVEL_MM = np.linspace(-95.0, 95.0, 381)


def axis_system(data: ThesisData, stated: str, kind: str) -> Figure:
    """Figures 10 and 11: an axis system on the truck, from the side and from above."""
    figure, panels = canvas(stated, rows=2, height=4.8, share_x=False)
    unit = data.vehicles[OURS].unit_specs["tractor"]
    front, rear, down = -unit.frame.front_x_m, -unit.frame.rear_x_m, kind == "sae"
    for axes, seen in zip(panels, ("side", "above"), strict=True):
        low, high = (0.5, 2.9) if seen == "side" else (-1.2, 1.2)
        axes.add_patch(Rectangle((rear, low), front - rear, high - low, facecolor="none",
                                 edgecolor=SOFT))  # fmt: skip
        origin = (0.0, 0.0) if seen == "above" else (0.0, 1.0)
        _arrow(axes, origin, (3.0, 0.0), "x forward")
        up = "z" if seen == "side" else "y"
        words = {"z": ("z up", "z down"), "y": ("y left", "y right")}[up][down]
        reach = 2.2 if seen == "side" else 1.5
        _arrow(axes, origin, (0.0, -reach if down else reach), words)
        axes.set(xlim=(rear - 1, front + 4), ylim=(-2.2, 4.2) if seen == "side" else (-2.4, 2.4),
                 title=f"seen from {'the left' if seen == 'side' else 'above'}")  # fmt: skip
        axes.set(xlabel="x (m)", ylabel=f"{up} (m)")
        axes.set_aspect("equal")
        axes.grid(visible=False)
    panels[0].axhline(0.0, color=INK, linewidth=1.2)
    return figure


def brake_torque(data: ThesisData, stated: str) -> Figure:
    """Figure 12."""
    figure, (axes,) = canvas(stated)
    psi = np.linspace(0.0, 100.0, 201)
    for sheet, vehicle in data.vehicles.items():
        brake = vehicle.spec.axles["trailer_1"].brake
        assert brake is not None
        over = np.maximum(psi * PSI_PA - brake.pushout_pa, 0.0)
        torque = brake.linear_nmppa * over - brake.quadratic_nmppa2 * over**2
        axes.plot(psi, torque / 1e3, color=_LINES[sheet], label=sheet,
                  linestyle="-" if sheet == OURS else (0, (4, 3)))  # fmt: skip
    axes.set(xlabel="chamber pressure (psi)", ylabel="brake torque of a wheel end (kN m)")
    legend(axes)
    return figure


def spring(data: ThesisData, stated: str, axle: str) -> Figure:
    """Figures 13 to 15: force over travel of one side, loading and unloading."""
    figure, (axes,) = canvas(stated)
    for sheet, vehicle in data.vehicles.items():
        spec = vehicle.spec.axles[axle]
        preload = static_loads(vehicle, GRAVITY_MPS2).spring_n[axle] / 2.0
        _loop(axes, spec, preload, _LINES[sheet], sheet)
        axes.plot([0.0], [preload / 1e3], "o", color=_LINES[sheet], markersize=5, zorder=4)
    own = data.vehicles[OURS].spec.axles[axle].suspension
    remark(axes, f"{own.spring_npm / 1e3:.0f} N/mm, friction ±{own.friction_n / 1e3:.1f} kN,"
                 f" stops at +{own.jounce_m * 1e3:.0f} and -{own.rebound_m * 1e3:.0f} mm; dot:"
                 " at rest")  # fmt: skip
    axes.set(xlabel="compression from rest (mm)", ylabel="force of one side (kN)")
    legend(axes, "upper left")
    return figure


def blowout_parameters(data: ThesisData, stated: str) -> Figure:
    """Figure 16: what a blowout does to a tire, over time, relative to the sound tire."""
    figure, (axes,) = canvas(stated)
    steps = data.vehicles[THESIS].blowout.steps
    assert steps is not None
    for words, values in (("radial stiffness", steps.stiffness_npm),
                          ("cornering stiffness", steps.cornering_scale),
                          ("rolling resistance", steps.rolling_0),
                          ("rolling radius", steps.radius_m)):
        axes.step(steps.time_s, np.array(values) / values[0], where="post", label=words)
    run = data.steer[OURS]
    series = run["tire_pressure_steer_left_pa"].between(0.0, 0.6)
    axes.plot(series.time_s, np.maximum(series.value / series.value[0], 1e-2), color=INK,
              linestyle=(0, (2, 2)), label="pressure, test truck")  # fmt: skip
    axes.set_yscale("log")
    plain_log_ticks(axes.yaxis)
    axes.set(xlabel="time after the blowout (s)", ylabel="part of the sound tire's value",
             title="steps: thesis sheet (tables 9 and 10)")  # fmt: skip
    legend(axes, "upper left")
    return figure


def radius_and_stiffness(data: ThesisData, stated: str) -> Figure:
    """Figure 17."""
    figure, (above, below) = canvas(stated, rows=2, height=5.0)
    steps = data.vehicles[THESIS].blowout.steps
    assert steps is not None
    above.step(steps.time_s, np.array(steps.radius_m) * 1e3, where="post", color=THESIS_LINE,
               label=f"{THESIS}: rolling radius (table 9)")  # fmt: skip
    below.step(steps.time_s, np.array(steps.stiffness_npm) / 1e3, where="post",
               color=THESIS_LINE, label=f"{THESIS} (table 9)")  # fmt: skip
    run, vehicle = data.steer[OURS], data.vehicles[OURS]
    height = run["tire_loaded_radius_steer_left_m"].between(-0.05, 0.6)
    pressure = run.at("tire_pressure_steer_left_pa", height.time_s)
    tire, law = vehicle.tire_specs["steer_left"], vehicle.blowout
    on_rim = height.value < law.rim_contact_radius_m
    rate = tire.stiffness_npm + tire.stiffness_npmppa * pressure + on_rim * law.rim_stiffness_npm
    above.plot(height.time_s, height.value * 1e3, color=OURS_LINE,
               label=f"{OURS}: loaded radius in the run")  # fmt: skip
    below.plot(height.time_s, rate / 1e3, color=OURS_LINE, label=f"{OURS}, in the run")
    below.set_yscale("log")
    plain_log_ticks(below.yaxis)
    above.set_ylabel("radius (mm)")
    below.set(xlabel="time after the blowout (s)", ylabel="radial stiffness (N/mm)")
    for axes in (above, below):
        blowout_line(axes, 0.0, "blowout" if axes is above else "")
        legend(axes)
    return figure


def _loop(axes: Axes, spec: AxleSpec, preload: float, color: str, label: str) -> None:
    own, travel = spec.suspension, _TRAVEL_MM / 1e3
    force = preload + own.spring_npm * travel
    force = force + own.stop_npm * np.maximum(travel - own.jounce_m, 0.0)
    force = force - own.stop_npm * np.maximum(-own.rebound_m - travel, 0.0)
    for sign, words in ((1.0, label), (-1.0, None)):
        axes.plot(_TRAVEL_MM, np.maximum(force + sign * own.friction_n, 0.0) / 1e3, color=color,
                  linewidth=1.4, label=words, linestyle="-" if label == OURS else (0, (4, 3)),
                  zorder=3)  # fmt: skip


def _arrow(axes: Axes, start: tuple[float, float], way: tuple[float, float], words: str) -> None:
    end = (start[0] + way[0], start[1] + way[1])
    axes.annotate("", end, start, arrowprops={"arrowstyle": "-|>", "color": OURS_LINE,
                                              "linewidth": 2.2})  # fmt: skip
    # beyond the point, which lies past the outline and the road
    height = 4 if way[1] >= 0.0 else -10
    axes.annotate(words, end, xytext=(6, height), textcoords="offset points", color=OURS_LINE)
