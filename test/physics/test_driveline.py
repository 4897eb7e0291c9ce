from __future__ import annotations

import pytest

from truck_blowout_sim.physics.driveline import net_force_n
from truck_blowout_sim.simulation import InitialState, Inputs, Truck
from truck_blowout_sim.vehicle import Packed


def test_map_of_the_recordings(truck: Packed) -> None:
    for throttle, speed in ((0.0, 20.0), (0.3, 15.0), (1.0, 25.0)):
        expected = throttle * 300e3 / speed - 1500.0 * (1.0 - throttle)
        assert net_force_n(truck.params, 0.0, throttle, speed) == pytest.approx(expected)


def test_force_is_bounded_at_rest_and_drag_fades(truck: Packed) -> None:
    assert net_force_n(truck.params, 0.0, 1.0, 0.0) == truck["driveline.max_force_n"]
    assert net_force_n(truck.params, 0.0, 0.0, 0.0) == 0.0


def test_an_open_clutch_leaves_the_axles_drag(truck: Packed) -> None:
    opened = truck.with_values({"driveline.clutch_open_time_s": 3.0})
    assert net_force_n(opened.params, 2.99, 0.0, 20.0) == pytest.approx(-1500.0)
    assert net_force_n(opened.params, 3.0, 1.0, 20.0) == pytest.approx(-300.0)


def test_an_added_drag_scales_with_the_closed_throttle(truck: Packed) -> None:
    more = truck.with_values({"driveline.drag_extra_n": 2000.0, "driveline.drag_extra_nspm": 10.0})
    assert net_force_n(more.params, 0.0, 0.0, 20.0) == pytest.approx(-3700.0)
    assert net_force_n(more.params, 0.0, 1.0, 20.0) == pytest.approx(15_000.0)


def test_the_truck_starts_from_rest_and_reaches_walking_pace(truck: Packed) -> None:
    run = Truck(truck)
    run.advance(Inputs(throttle=0.4), 5000)
    assert 2.0 < run.outputs()["tractor_vx_mps"] < 12.0
    # drive wheels roll, they do not spin away
    ratio = run.outputs()["hub_speed_drive_1_left_radps"] * 0.495 / run.outputs()["tractor_vx_mps"]
    assert ratio == pytest.approx(1.0, abs=0.1)


def test_it_stands_without_creeping(truck: Packed) -> None:
    run = Truck(truck, initial=InitialState())
    run.advance(Inputs(), 10_000)
    assert abs(run.outputs()["tractor_x_m"]) < 1e-3


def test_a_retarder_holds_back_while_the_throttle_is_closed(truck: Packed) -> None:
    held = truck.with_values({"driveline.retarder_n": 3000.0})
    assert net_force_n(held.params, 0.0, 0.0, 20.0) == pytest.approx(-4500.0)
    cruising = net_force_n(truck.params, 0.0, 0.2, 20.0)
    assert net_force_n(held.params, 0.0, 0.2, 20.0) == pytest.approx(cruising)
