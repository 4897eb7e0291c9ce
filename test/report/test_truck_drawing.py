from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.colors import to_rgba
from matplotlib.patches import FancyBboxPatch

from truck_blowout_sim.diagnosis.result import Diagnosis, Effect, Place
from truck_blowout_sim.report.style import ORANGE, VERMILION
from truck_blowout_sim.report.truck_drawing import base_link_m, draw_truck, tires_of
from truck_blowout_sim.vehicle import Vehicle, load_vehicle


def filled(axes: Axes, color: str) -> set[tuple[float, float]]:
    """Middles of the boxes of one color."""
    boxes = [p for p in axes.patches if isinstance(p, FancyBboxPatch)]
    return {
        (round(b.get_x() + b.get_width() / 2, 6), round(b.get_y() + b.get_height() / 2, 6))
        for b in boxes
        if b.get_facecolor() == to_rgba(color)
    }


def places(vehicle: Vehicle, *names: str) -> set[tuple[float, float]]:
    return {(round(t.x_m, 6), round(t.y_m, 6)) for t in tires_of(vehicle) if t.name in names}


def test_tires_stand_where_the_vehicle_file_says(vehicle: Vehicle) -> None:
    tires = {tire.name: tire for tire in tires_of(vehicle)}
    assert list(tires) == list(vehicle.tires)
    assert tires["steer_left"].x_m == 0.0
    assert tires["steer_left"].y_m == pytest.approx(vehicle.spec.axles["steer"].track_m / 2)
    rear = tires["trailer_2_right_outer"]
    assert rear.x_m == pytest.approx(-5.50 - vehicle.spec.axles["trailer_2"].x_m)
    assert rear.y_m < tires["trailer_2_right_inner"].y_m < 0
    assert base_link_m(vehicle, "tractor") == pytest.approx(-2.42)
    assert base_link_m(vehicle, "trailer") == pytest.approx(-5.50 - 5.613)


def test_the_named_hub_and_its_look_alikes_are_filled(
    vehicle: Vehicle, diagnosis: Diagnosis
) -> None:
    axes = draw_truck(vehicle, diagnosis).axes[0]
    left = ("trailer_2_left_outer", "trailer_2_left_inner")
    right = ("trailer_2_right_outer", "trailer_2_right_inner")
    assert filled(axes, VERMILION) == places(vehicle, *left)
    assert filled(axes, ORANGE) == places(vehicle, *right)


def test_a_named_tire_is_filled_alone(vehicle: Vehicle, diagnosis: Diagnosis) -> None:
    where = Place("tractor", "drive_1", "drive_1_right", "drive_1_right_inner")
    effect = Effect("blown_tire_drag", "physics", where, {}, "", "")
    axes = draw_truck(vehicle, replace(diagnosis, effects=(effect,))).axes[0]
    assert filled(axes, VERMILION) == places(vehicle, "drive_1_right_inner")


def test_the_line_of_action_stands_on_its_body(vehicle: Vehicle, diagnosis: Diagnosis) -> None:
    axes = draw_truck(vehicle, diagnosis).axes[0]
    base = -5.50 - 5.613
    lines = {line.get_label(): line for line in axes.lines}
    assert lines["line of action"].get_xdata()[0] == pytest.approx(base - 5.9)
    band = next(p for p in axes.patches if p.get_label() == "its 90 % interval")
    edges = band.get_extents().transformed(axes.transData.inverted())
    assert (edges.x0, edges.x1) == (pytest.approx(base - 6.8), pytest.approx(base - 5.1))


def test_an_open_interval_ends_at_the_edge(vehicle: Vehicle, diagnosis: Diagnosis) -> None:
    location = replace(diagnosis.location, line_of_action_ci90_m=(-np.inf, np.inf))
    axes = draw_truck(vehicle, replace(diagnosis, location=location)).axes[0]
    band = next(p for p in axes.patches if p.get_label() == "its 90 % interval")
    edges = band.get_extents().transformed(axes.transData.inverted())
    assert (edges.x0, edges.x1) == pytest.approx(axes.get_xlim())


def test_a_car_is_drawn_as_well() -> None:
    car = load_vehicle("ferrari_250lm")
    axes = draw_truck(car, Diagnosis("consistent", "")).axes[0]
    boxes = [p for p in axes.patches if isinstance(p, FancyBboxPatch)]
    assert len(boxes) == len(car.units) + len(car.tires)
