"""Understeer, yaw gain and roll gradient against closed forms."""

from __future__ import annotations

from math import degrees
from pathlib import Path

import pytest

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.simulation.handling import handling
from truck_blowout_sim.vehicle import load_vehicle

CAR = """title: car
single_track:
  {{kind: car, mass_kg: 1500, wheelbase_m: 2.7, cg_x_m: 1.2, yaw_inertia_kgm2: 2300,
   front_cornering_nprad: {front}, rear_cornering_nprad: {rear}, steering_ratio: 15,
   tire: 205/55R16}}
"""


def car(folder: Path, front: float, rear: float) -> Path:
    path = folder / "car.yaml"
    path.write_text(CAR.format(front=front, rear=rear))
    return path


def test_understeer_is_that_of_the_single_track_model(tmp_path: Path) -> None:
    found = handling(load_vehicle(car(tmp_path, 110e3, 130e3)))
    stated = 1500 * 9.80665 / 2.7 * (1.5 / 110e3 - 1.2 / 130e3)  # rad/g
    # trail and load transfer of the full model add a few tenths of a degree
    assert degrees(found.understeer_rad) == pytest.approx(degrees(stated), abs=0.4)
    assert found.critical_speed_mps is None


def test_an_oversteering_car_has_a_critical_speed(tmp_path: Path) -> None:
    found = handling(load_vehicle(car(tmp_path, 130e3, 60e3)), speed_mps=12.0)
    assert found.understeer_rad < 0.0
    assert found.critical_speed_mps is not None
    expected = (2.7 * 9.80665 / -found.understeer_rad) ** 0.5
    assert found.critical_speed_mps == pytest.approx(expected, rel=0.01)


def test_roll_is_the_stated_rule_and_the_tires(tmp_path: Path) -> None:
    found = handling(load_vehicle(car(tmp_path, 110e3, 130e3)))
    assert 5.0 < degrees(found.roll_rad) < 7.0


def test_yaw_gain_agrees_with_understeer(tmp_path: Path) -> None:
    found = handling(load_vehicle(car(tmp_path, 110e3, 130e3)))
    v = found.speed_mps
    gain = v / (2.7 + found.understeer_rad * v * v / 9.80665) / 15
    assert found.yaw_gain_radps == pytest.approx(gain, rel=0.01)


def test_a_vehicle_without_steering_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "unsteered.yaml"
    path.write_text("extends: rigid_truck\naxles: {steer: {steered: false}}\n")
    with pytest.raises(InputError, match="no axle is steered"):
        handling(load_vehicle(path))
