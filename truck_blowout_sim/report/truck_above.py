"""The truck from above, as it stood: outlines to scale at instants of a run.

Validated with: test/report/test_run_page.py.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Polygon
from numpy.typing import NDArray

from truck_blowout_sim.motion import Motion
from truck_blowout_sim.report.style import BLUE, INK, SOFT, VERMILION
from truck_blowout_sim.vehicle import Vehicle
from truck_blowout_sim.vehicle.places import HubPlace, hub_places

Floats = NDArray[np.float64]
_TIRE_WIDTH_OF_RADIUS, _BODY, _RUBBER, _FLAT = 0.56, "#dfe5ea", "#3a4149", VERMILION
_FLAT_BELOW = 0.3  # part of the air left
_LONGEST_M = 2.5


def draw_above(axes: Axes, vehicle: Vehicle, motion: Motion, index: int, *,
               n_per_m: float | None = None, turn_rad: float = 0.0,
               center: tuple[float, float] = (0.0, 0.0)) -> None:
    """Draw the truck at one instant of its motion.

    Args:
        axes: map coordinates, x to the right.
        vehicle: lengths.
        motion: where its parts were.
        index: instant.
        n_per_m: force that an arrow of one meter stands for; None draws no arrows.
        turn_rad, center: the map is turned by this about that point.
    """
    def placed(points: Floats) -> Floats:
        c, s = np.cos(turn_rad), np.sin(turn_rad)
        moved = points - np.array(center)
        return moved @ np.array([[c, s], [-s, c]])

    for unit in reversed(vehicle.units):
        axes.add_patch(Polygon(placed(_outline(vehicle, motion, unit, index)), facecolor=_BODY,
                               edgecolor=SOFT, linewidth=0.8, zorder=2))  # fmt: skip
        for box in _payload(vehicle, motion, unit, index):
            axes.add_patch(Polygon(placed(box), facecolor="none", edgecolor=SOFT, linestyle=":",
                                   linewidth=0.7, zorder=2.1))  # fmt: skip
    for hub in hub_places(vehicle):
        for tire, outline, contact, force in _tires(motion, hub, index):
            flat = float(motion.wheels[hub.hub].air[tire][index]) < _FLAT_BELOW
            axes.add_patch(Polygon(placed(outline), facecolor=_FLAT if flat else _RUBBER,
                                   edgecolor="none", zorder=3))  # fmt: skip
            if n_per_m and force is not None and np.hypot(*force) > 0.04 * n_per_m:
                a, b = placed(np.stack([contact, contact + force / n_per_m]))
                axes.annotate("", b, a, zorder=4, arrowprops={
                    "arrowstyle": "-|>", "color": BLUE, "linewidth": 1.1, "shrinkA": 0,
                    "shrinkB": 0, "mutation_scale": 7})  # fmt: skip


def arrow_scale(motion: Motion, picks: Sequence[int], unit_n_per_m: float) -> float | None:
    """Force for each length of an arrow, so that the longest arrow stays short.

    Args:
        motion: with the forces.
        picks: instants that are drawn.
        unit_n_per_m: one unit of the scale, such as 1000 for kN/m.

    Returns:
        1, 2 or 5 times a power of ten, in that unit; None without forces.
    """
    most = [float(np.hypot(force[0][list(picks)], force[1][list(picks)]).max())
            for wheel in motion.wheels.values() for force in wheel.forces_n.values()]
    if not most or max(most) <= 0.0:
        return None
    least = max(most) / (_LONGEST_M * unit_n_per_m)
    power = 10.0 ** math.floor(math.log10(least))
    return next(n * power for n in (1.0, 2.0, 5.0, 10.0) if n * power >= least)


def _pose(motion: Motion, unit: str, index: int) -> tuple[Floats, float]:
    track = motion.units[unit]
    return np.array([track.x_m[index], track.y_m[index]]), float(track.yaw_rad[index])


def _in_map(points: Floats, motion: Motion, unit: str, index: int) -> Floats:
    at, yaw = _pose(motion, unit, index)
    c, s = np.cos(yaw), np.sin(yaw)
    return at + points @ np.array([[c, s], [-s, c]])


def _rectangle(x: float, y: float, length: float, width: float) -> Floats:
    a, b = length / 2, width / 2
    return np.array([[x - a, y - b], [x + a, y - b], [x + a, y + b], [x - a, y + b]])


def _outline(vehicle: Vehicle, motion: Motion, unit: str, index: int) -> Floats:
    spec = vehicle.unit_specs[unit]
    front, rear = (spec.base_link.x_m - x for x in (spec.frame.front_x_m, spec.frame.rear_x_m))
    mine = [place for place in hub_places(vehicle) if place.unit == unit]
    half = max(place.y_m + max(y for _, y, _ in place.tires) for place in mine if place.y_m > 0)
    box = _rectangle((front + rear) / 2, 0.0, front - rear, 2 * half)
    return _in_map(box, motion, unit, index)


def _payload(vehicle: Vehicle, motion: Motion, unit: str, index: int) -> Iterator[Floats]:
    spec = vehicle.unit_specs[unit]
    for block in spec.payload.values():
        box = _rectangle(spec.base_link.x_m - block.x_m, 0.0, block.length_m, block.width_m)
        yield _in_map(box, motion, unit, index)


def _tires(motion: Motion, hub: HubPlace, index: int
           ) -> Iterator[tuple[str, Floats, Floats, Floats | None]]:
    """Name, outline, place and force on the road, in the map."""
    _, yaw = _pose(motion, hub.unit, index)
    wheel = motion.wheels[hub.hub]
    heading = yaw + float(wheel.steer_rad[index])
    c, s = np.cos(heading), np.sin(heading)
    turned = np.array([[c, s], [-s, c]])
    middle = _in_map(np.array([[hub.x_m, hub.y_m]]), motion, hub.unit, index)[0]
    for name, y, radius in hub.tires:
        place = middle + np.array([0.0, y]) @ turned
        box = _rectangle(0.0, 0.0, 2 * radius, _TIRE_WIDTH_OF_RADIUS * radius) @ turned + place
        found = wheel.forces_n.get(name)
        force = None if found is None else found[:2, index] @ turned
        yield name, box, place, force


def path_line(axes: Axes, x: Floats, y: Floats, label: str = "") -> None:
    """A path under the outlines."""
    axes.plot(x, y, color=INK, linewidth=0.8, zorder=1, label=label or None)
