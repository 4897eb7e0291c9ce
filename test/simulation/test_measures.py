"""The few numbers that a run comes to."""

from __future__ import annotations

import math

import numpy as np
import pytest

from truck_blowout_sim.report.sweep_page import _left
from truck_blowout_sim.simulation import load_scenario, prepare
from truck_blowout_sim.simulation.drive import Drive as Drive_
from truck_blowout_sim.simulation.drive import Ran, execute
from truck_blowout_sim.simulation.measures import Measures, _beside, measure
from truck_blowout_sim.vehicle import Packed


@pytest.fixture(scope="module")
def fishhook(truck: Packed) -> tuple[Packed, Drive_, Ran]:
    packed, drive, _ = prepare(truck, load_scenario("fishhook"))
    return packed, drive, execute(packed, drive)


@pytest.fixture(scope="module")
def measured(fishhook: tuple[Packed, Drive_, Ran]) -> Measures:
    return measure(*fishhook, lane_width_m=3.66)


def test_peaks_are_taken_from_the_burst_on(measured: Measures) -> None:
    assert measured.blown_s == 3.5
    assert measured.ended_s == pytest.approx(10.0)
    assert measured.peak_hand_wheel_rad == 0.0  # it is held from 3.2 s on
    assert 0.02 < measured.peak_articulation_rad < 0.5
    assert 0.1 < measured.peak_load_transfer < 1.0
    assert not measured.rolled_over
    assert measured.stopped_s is None


def test_a_wider_lane_is_left_later(fishhook: tuple[Packed, Drive_, Ran]) -> None:
    narrow, wide, endless = (measure(*fishhook, lane_width_m=width).left_lane_s
                             for width in (3.66, 30.0, 300.0))
    assert narrow == pytest.approx(1.98)  # off it before the burst, at 3.5 s
    assert wide is not None
    assert 6.0 < wide < 10.0
    assert endless is None


def test_a_truck_that_was_off_the_lane_before_the_burst_does_not_count() -> None:
    assert [_left(left_s, blown_s) for left_s, blown_s in (
        (None, 3.5), (1.98, 3.5), (3.5, 3.5), (1.98, None))] == [0.0, 0.0, 1.0, 1.0]


def test_a_stop_is_timed_and_measured(truck: Packed) -> None:
    packed, drive, _ = prepare(truck, load_scenario("brake_stop"))
    found = measure(packed, drive, execute(packed, drive), 3.66)
    assert found.blown_s is None
    assert found.stopped_s is not None
    assert 3.0 < found.stopped_s < 6.0
    assert 40.0 < found.distance_m < 100.0
    assert found.left_lane_s is None
    assert found.lane_departure_m < 0.05
    assert found.sideways_m == pytest.approx(found.lane_departure_m, abs=1e-6)


def test_distance_from_a_bent_path_has_its_side() -> None:
    path = np.array([[0.0, 0.0], [10.0, 0.0], [20.0, 10.0]])
    x, y = np.array([5.0, 5.0, 15.0, 30.0]), np.array([1.0, -2.0, 5.0, 20.0])
    assert _beside(path, x, y) == pytest.approx([1.0, -2.0, 0.0, 0.0], abs=1e-12)
    assert _beside(path, np.array([15.0]), np.array([7.0]))[0] == pytest.approx(math.sqrt(2.0))
