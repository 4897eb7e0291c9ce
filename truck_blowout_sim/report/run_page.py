"""The page a run ends with: what happened in one sentence, the truck, and the chief channels.

Validated with: test/report/test_run_page.py.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes

from truck_blowout_sim.comparison.units import display_unit
from truck_blowout_sim.motion import Motion
from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.report.channel_plots import PlotRequest, channel_plot
from truck_blowout_sim.report.page import render, write_text
from truck_blowout_sim.report.style import (
    INK,
    ORANGE,
    Picture,
    in_legend,
    new_figure,
    styled,
)
from truck_blowout_sim.report.ticks import tick_in
from truck_blowout_sim.report.truck_above import arrow_scale, draw_above, path_line
from truck_blowout_sim.vehicle import Vehicle

_AFTER_BLOWOUT_S = (0.0, 0.5, 1.0, 2.0)
_MARGIN_M, _WIDE_IN = 3.0, 8.4
_TURNED_RAD = 0.2


def write_run_page(run: Recording, motion: Motion, vehicle: Vehicle, sentence: str, path: Path, *,
                   facts: Mapping[str, str] | None = None, units: str = "us") -> Path:
    """Write the page of a run.

    Args:
        run: inputs and outputs.
        motion: of its parts.
        vehicle: that was driven.
        sentence: the result.
        path: HTML file.
        facts: further lines under the sentence.
        units: of the figures, ``us`` or ``si``.

    Raises:
        StorageError: it cannot be written.
    """
    write_text(render("run.html", {
        "name": run.name, "title": run.metadata.get("title", ""), "sentence": sentence,
        "facts": dict(facts or {}), "notes": run.notes, "vehicle": vehicle.title,
        "pictures": run_pictures(run, motion, vehicle, units),
    }), path)  # fmt: skip
    return path


def run_pictures(run: Recording, motion: Motion, vehicle: Vehicle, units: str = "us"
                 ) -> list[Picture]:
    """Every figure for which there are channels, in the units ``us`` or ``si``."""
    pictures = [_above(run, motion, vehicle, units), _path(run, motion, vehicle, units)]
    pictures += [_channels(run, name, title, words, groups, units)
                 for name, title, words, groups in _groups(run, vehicle)]  # fmt: skip
    return pictures


def five_instants(run: Recording, motion: Motion) -> list[int]:
    """Instants at which the truck is shown: the blowout, three after it, the end; else even."""
    start, end = float(motion.times_s[0]), float(motion.times_s[-1])
    times = list(np.linspace(start, end, 5))
    if run.blowouts:
        burst = run.blowouts[0].time_s
        left = max(end - burst, 0.0)
        shrink = min(1.0, left / 2.5)
        times = [burst + shrink * after for after in _AFTER_BLOWOUT_S] + [end]
    return [int(np.argmin(np.abs(motion.times_s - time))) for time in times]


@styled
def _above(run: Recording, motion: Motion, vehicle: Vehicle, units: str) -> Picture:
    """The truck at five instants, heading to the right: as first, or each time if it turned far."""
    picks = five_instants(run, motion)
    length_unit, force_unit = display_unit("tractor_x_m", units), display_unit("tire_fz_n", units)
    unit_n_per_m = length_unit.per_si / force_unit.per_si
    scale = arrow_scale(motion, picks, unit_n_per_m)
    first = motion.units[vehicle.units[0]]
    last = motion.units[vehicle.units[-1]]
    turned = np.ptp(first.yaw_rad[picks]) > _TURNED_RAD
    length = sum(s.frame.rear_x_m - s.frame.front_x_m for s in vehicle.unit_specs.values())
    half = 0.5 * length + _MARGIN_M
    high = 0.06 * length + 1.5
    figure = new_figure((_WIDE_IN, 0.3 + 5 * _WIDE_IN * high / half))
    strips = figure.subplots(5, 1, sharex=True)
    for axes, k in zip(strips, picks, strict=True):
        turn = -float(first.yaw_rad[picks[0]])
        if turned:
            turn = -0.5 * float(first.yaw_rad[k] + last.yaw_rad[k])
        middle = (float(first.x_m[k] + last.x_m[k]) / 2, float(first.y_m[k] + last.y_m[k]) / 2)
        draw_above(axes, vehicle, motion, k, n_per_m=scale and scale * unit_n_per_m,
                   turn_rad=turn, center=middle)
        c, s = np.cos(turn), np.sin(turn)
        x, y = first.x_m - middle[0], first.y_m - middle[1]
        path_line(axes, c * x - s * y, s * x + c * y)
        axes.set(xlim=(-half, half), ylim=_reach(axes, high))
        axes.set_aspect("equal")
        axes.set_yticks([])
        axes.spines["left"].set_visible(False)
        axes.annotate(f"{motion.times_s[k]:.2f} s", (0.0, 0.92), xycoords="axes fraction",
                      va="top", weight="bold", color=INK)  # fmt: skip
        axes.grid(visible=False)
    heights = [float(np.ptp(axes.get_ylim())) for axes in strips]
    strips[0].get_gridspec().set_height_ratios(heights)
    figure.set_size_inches(_WIDE_IN, 0.3 + _WIDE_IN * sum(heights) / (2.0 * half))
    figure.axes[-1].set_xlabel(length_unit.symbol)
    tick_in(figure.axes[-1].xaxis, length_unit.per_si)
    arrows = (f" Arrows: force of the road on each tire, 1 {length_unit.symbol} ="
              f" {scale:g} {force_unit.symbol}.") if scale else ""
    return Picture("truck_above", "The truck from above at five instants",
                   "To scale; the flat tire in color; the line is the path of the tractor."
                   + (" Each is turned by the mean heading of its units." if turned else "")
                   + arrows, figure)  # fmt: skip


def _reach(axes: Axes, least: float) -> tuple[float, float]:
    """Limits that hold every part drawn so far, at least so far to either side."""
    drawn = np.concatenate([np.asarray(patch.get_path().vertices)[:, 1] for patch in axes.patches])
    return min(-least, float(drawn.min()) - 0.5), max(least, float(drawn.max()) + 0.5)


@styled
def _path(run: Recording, motion: Motion, vehicle: Vehicle, units: str) -> Picture:
    """Paths of all units to scale, and below with the side stretched."""
    first = motion.units[vehicle.units[0]]
    yaw, x0, y0 = float(first.yaw_rad[0]), float(first.x_m[0]), float(first.y_m[0])
    c, s = np.cos(yaw), np.sin(yaw)
    reach = np.ptp(c * first.x_m + s * first.y_m) + 30.0
    side = np.ptp(c * first.y_m - s * first.x_m) + 14.0
    tall = float(np.clip(_WIDE_IN * side / reach, 0.7, 7.0))
    figure = new_figure((_WIDE_IN, tall + 2.9))
    scale, stretched = figure.subplots(2, 1, height_ratios=(tall, 1.9))
    for name, color in zip(vehicle.units, (INK, ORANGE), strict=False):
        track = motion.units[name]
        dx, dy = track.x_m - x0, track.y_m - y0
        along, across = c * dx + s * dy, c * dy - s * dx
        for axes in (scale, stretched):
            axes.plot(along, across, color=color, label=in_legend(name), zorder=3)
    for k in five_instants(run, motion):
        draw_above(scale, vehicle, motion, k, turn_rad=-yaw, center=(x0, y0))
    scale.margins(0.02, 0.15)
    scale.set_aspect("equal", adjustable="datalim")
    unit = display_unit("tractor_x_m", units)
    scale.set_ylabel(f"left ({unit.symbol})")
    stretched.set(xlabel=f"along the first heading ({unit.symbol})",
                  ylabel=f"left ({unit.symbol}), stretched")
    for axes in (scale, stretched):
        tick_in(axes.xaxis, unit.per_si)
        tick_in(axes.yaxis, unit.per_si)
    stretched.legend(loc="best")
    return Picture("path", "Path", "Above to scale, with the truck at the five instants; below the"
                   " same with the side stretched.", figure)  # fmt: skip


def _groups(run: Recording, vehicle: Vehicle
            ) -> Iterator[tuple[str, str, str, tuple[tuple[str, ...], ...]]]:
    units = vehicle.units

    def each(form: str) -> tuple[str, ...]:
        return tuple(form.format(unit) for unit in units)

    yield ("inputs", "Inputs", "What the driver did.",
           (("steering_wheel_angle_rad",), ("throttle",),
            tuple(f"brake_pressure_{c}_pa" for c in ("steer", "drive", "trailer"))))
    yield ("motion", "Motion", "Speeds, yaw rates, roll, articulation.",
           (each("{}_vx_mps"), each("{}_yaw_rate_radps"), each("{}_roll_rad"),
            ("articulation_rad",)))
    tires = _shown_tires(run, vehicle)
    yield ("tires", "Tires", "Pressure and forces of the blown tires and of their mirror images.",
           (tuple(f"tire_pressure_{t}_pa" for t in tires), tuple(f"tire_fz_{t}_n" for t in tires),
            tuple(f"tire_fy_{t}_n" for t in tires), tuple(f"tire_fx_{t}_n" for t in tires)))


def _shown_tires(run: Recording, vehicle: Vehicle) -> tuple[str, ...]:
    """The blown ones and those that mirror them; without a blowout those of the first axle."""
    blown = [tire for event in run.blowouts for tire in event.tires if tire in vehicle.tires]
    if not blown:
        return tuple(t for hub in vehicle.hubs[:2] for t in vehicle.tires_of_hub(hub))
    swap = {"left": "right", "right": "left"}
    found = []
    for tire in blown[:2]:
        mirror = "_".join(swap.get(part, part) for part in tire.split("_"))
        found += [tire, mirror]
    return tuple(dict.fromkeys(t for t in found if t in vehicle.tires))


def _channels(run: Recording, name: str, title: str, words: str,
              groups: tuple[tuple[str, ...], ...], units: str) -> Picture:
    there = tuple(tuple(c for c in group if c in run) for group in groups)
    request = PlotRequest(tuple(group for group in there if group) or (("throttle",),),
                          units=units)
    picture = channel_plot([run], request, name)
    return Picture(name, title, words, picture.figure)
