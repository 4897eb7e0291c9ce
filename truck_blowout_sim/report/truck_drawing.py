"""The truck from above: what is named, and the line along which the missing force acts.

Forward is to the right, left is up; the units stand in line. Lengths come from the vehicle file.

Validated with: test/report/test_truck_drawing.py.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import FancyBboxPatch, Rectangle

from truck_blowout_sim.diagnosis.result import Diagnosis, Location, Place
from truck_blowout_sim.report.style import BLUE, INK, ORANGE, SOFT, VERMILION, new_figure
from truck_blowout_sim.vehicle import Vehicle

_BODY_WIDTH_M = {"tractor": 2.2, "trailer": 2.5}
_TIRE_WIDTH_M = 0.29
_MARGIN_M = 1.0
_FRAME, _RUBBER = "#eef1f4", "#c4cbd2"
_ARROW_M = 1.5


@dataclass(frozen=True)
class Tire:
    """A tire from above, forward of the first unit's origin."""

    name: str
    x_m: float
    y_m: float
    radius_m: float


def draw_truck(vehicle: Vehicle, diagnosis: Diagnosis) -> Figure:
    """Top view with the named parts filled and the line of action across its body."""
    figure = new_figure((8.4, 2.75))
    axes = figure.add_subplot()
    for unit in vehicle.units:
        _body(axes, vehicle, unit)
    _limits(axes, vehicle)
    named = _tires_at(vehicle, [effect.where for effect in diagnosis.effects])
    others = _tires_at(vehicle, [c.where for c in diagnosis.evidence.candidates if c.aliased])
    for tire in tires_of(vehicle):
        color = VERMILION if tire.name in named else ORANGE if tire.name in others else None
        _tire(axes, tire, color)
    _line_of_action(axes, vehicle, diagnosis.location)
    _legend(figure, axes, bool(named), bool(others - named))
    axes.set_aspect("equal")
    axes.set_xlabel("forward of the first axle (m)")
    axes.set_ylabel("left (m)")
    axes.grid(visible=False)
    return figure


def tires_of(vehicle: Vehicle) -> Iterator[Tire]:
    """Every tire's place, units in line."""
    for hub in vehicle.hubs:
        axle = vehicle.spec.axles[vehicle.axle_of_hub(hub)]
        side = 1.0 if hub.endswith("_left") else -1.0
        names = vehicle.tires_of_hub(hub)
        spread = 0.5 * axle.dual_spacing_m if len(names) > 1 else 0.0
        for name, offset in zip(names, (spread, -spread), strict=False):
            x = unit_origin_m(vehicle, axle.unit) - axle.x_m
            y = side * (0.5 * axle.track_m + offset)
            yield Tire(name, x, y, vehicle.tire_specs[name].unloaded_radius_m)


def unit_origin_m(vehicle: Vehicle, unit: str) -> float:
    """Origin of a unit (steer axle, kingpin), forward of the first unit's origin."""
    first, hitch = vehicle.units[0], vehicle.unit_specs[vehicle.units[0]].hitch
    if unit == first or hitch is None:
        return 0.0
    own = vehicle.unit_specs[unit].hitch
    return -hitch.x_m + (own.x_m if own is not None else 0.0)


def base_link_m(vehicle: Vehicle, unit: str) -> float:
    """A unit's ``base_link``, forward of the first unit's origin."""
    return unit_origin_m(vehicle, unit) - vehicle.unit_specs[unit].base_link.x_m


def _body(axes: Axes, vehicle: Vehicle, unit: str) -> None:
    """Frame, payload, hitch and instruments of one unit."""
    spec, origin = vehicle.unit_specs[unit], unit_origin_m(vehicle, unit)
    rear, front = _ends_m(vehicle, unit)
    tracks = [axle.track_m for axle in vehicle.spec.axles.values() if axle.unit == unit]
    width = min(_BODY_WIDTH_M.get(unit, 2.0), max(tracks, default=2.0) + _TIRE_WIDTH_M)
    axes.add_patch(FancyBboxPatch(
        (rear, -width / 2), front - rear, width, boxstyle="round,pad=0,rounding_size=0.15",
        facecolor=_FRAME, edgecolor=SOFT, linewidth=1.0, zorder=1.1 if unit == "tractor" else 1.0,
    ))  # fmt: skip
    for block in spec.payload.values():
        corner = (origin - block.x_m - block.length_m / 2, -block.width_m / 2)
        axes.add_patch(Rectangle(
            corner, block.length_m, block.width_m, fill=False, edgecolor=SOFT, linestyle=":",
            linewidth=0.9, zorder=2,
        ))  # fmt: skip
    if spec.hitch is not None:
        axes.plot(origin - spec.hitch.x_m, 0.0, "o", color=SOFT, markersize=4, zorder=3)
    axes.plot(base_link_m(vehicle, unit), 0.0, "+", color=SOFT, markersize=8, zorder=3)


def _ends_m(vehicle: Vehicle, unit: str) -> tuple[float, float]:
    """Rear and front end of a unit's frame."""
    frame, origin = vehicle.unit_specs[unit].frame, unit_origin_m(vehicle, unit)
    return origin - frame.rear_x_m, origin - frame.front_x_m


def _limits(axes: Axes, vehicle: Vehicle) -> None:
    ends = [end for unit in vehicle.units for end in _ends_m(vehicle, unit)]
    axes.set_xlim(min(ends) - _MARGIN_M, max(ends) + _MARGIN_M)
    axes.set_ylim(-2.6, 2.6)


def _tire(axes: Axes, tire: Tire, color: str | None) -> None:
    corner = (tire.x_m - tire.radius_m, tire.y_m - _TIRE_WIDTH_M / 2)
    axes.add_patch(FancyBboxPatch(
        corner, 2 * tire.radius_m, _TIRE_WIDTH_M, boxstyle="round,pad=0,rounding_size=0.08",
        facecolor=color or _RUBBER, edgecolor=color or SOFT, linewidth=0.8, zorder=4,
    ))  # fmt: skip


def _tires_at(vehicle: Vehicle, places: Iterable[Place]) -> set[str]:
    """Tires that a place means: itself, those of its hub, or those of its axle."""
    found: set[str] = set()
    for place in places:
        for tire in vehicle.tires:
            hub = vehicle.hub_of_tire(tire)
            axle = vehicle.axle_of_hub(hub)
            meant = place.tire or place.hub or place.axle
            if meant is not None and meant in (tire, hub, axle):
                found.add(tire)
    return found


def _line_of_action(axes: Axes, vehicle: Vehicle, location: Location) -> None:
    if location.body is None or location.line_of_action_x_m is None:
        return
    base = base_link_m(vehicle, location.body)
    x = base + location.line_of_action_x_m
    low, high = axes.get_xlim()
    if location.line_of_action_ci90_m is not None:
        bounds = np.clip(np.add(location.line_of_action_ci90_m, base), low, high)
        axes.axvspan(*bounds, color=BLUE, alpha=0.15, linewidth=0, zorder=2.5,
                     label="its 90 % interval")  # fmt: skip
    if low <= x <= high:
        axes.axvline(x, color=BLUE, linewidth=2.0, zorder=5, label="line of action")
        _arrow(axes, x, location)


def _arrow(axes: Axes, x: float, location: Location) -> None:
    """Direction of the lateral force."""
    if location.wrench is None or location.wrench.fy_n == 0.0:
        return
    way = float(np.sign(location.wrench.fy_n))
    axes.annotate("", (x, way * (1.0 + _ARROW_M)), (x, way * 1.0), zorder=6,
                  arrowprops={"arrowstyle": "-|>", "color": BLUE, "linewidth": 2.5})  # fmt: skip


def _legend(figure: Figure, axes: Axes, named: bool, aliased: bool) -> None:
    if named:
        axes.plot([], [], "s", color=VERMILION, markersize=9, label="named")
    if aliased:
        axes.plot([], [], "s", color=ORANGE, markersize=9, label="fits as well")
    axes.plot([], [], "+", color=SOFT, markersize=8, label="base_link")
    handles, words = axes.get_legend_handles_labels()
    figure.legend(handles, words, loc="outside upper center", ncols=5, labelcolor=INK)
