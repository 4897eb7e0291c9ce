from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from truck_blowout_sim.physics.driveline import engine, hub_force_n
from truck_blowout_sim.physics.energy import energy_j
from truck_blowout_sim.physics.layout import HUB_S
from truck_blowout_sim.simulation import InitialState, Inputs, Truck
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]


RADIUS_M, INERTIA_KGM2, STEP_S = 0.5, 32.0, 0.001
DRIVEN = [f"drive_{axle}_{side}" for axle in (1, 2) for side in ("left", "right")]


def net_force_n(p: Floats, time_s: float, throttle: float, speed_mps: float) -> float:
    """Force of all driven hubs while none of them slips."""
    power, drag = engine(p, time_s, throttle, speed_mps)
    return hub_force_n(p, 1.0, (power, drag, speed_mps), speed_mps / RADIUS_M, RADIUS_M,
                       INERTIA_KGM2, STEP_S)


def spins(run: Truck) -> list[float]:
    out = run.outputs()
    return [out[f"hub_speed_{hub}_radps"] for hub in DRIVEN]


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


@pytest.mark.parametrize("throttle", [0.3, 1.0])
def test_wheels_that_spin_get_what_the_engine_has(
    truck: Packed, slot: Callable[[str, str], int], throttle: float
) -> None:
    """On ice, from rest: no more energy than power times time, nor more power at any instant."""
    ice = truck.with_values({"world.friction_scale": 0.05})
    run = Truck(ice)
    before = energy_j(run.state, ice.params, ice.topology, run._work)
    power = throttle * truck["driveline.power_w"]
    for second in range(1, 6):
        run.advance(Inputs(throttle=throttle), 1000)
        given = energy_j(run.state, ice.params, ice.topology, run._work) - before
        assert given < power * second
        torques = [run.state[slot("hub", hub) + HUB_S.drive_nm] for hub in DRIVEN]
        assert np.dot(torques, spins(run)) < 1.001 * power
    assert min(spins(run)) * 0.5 > 3.0 * run.outputs()["tractor_vx_mps"]


@pytest.mark.parametrize("step_s", [0.001, 0.005])
def test_engine_and_retarder_never_drive_a_wheel_backward(truck: Packed, step_s: float) -> None:
    """They hold more than a slippery road does: the wheels nearly stop, the truck rolls on."""
    held = truck.with_values({"world.friction_scale": 0.3, "driveline.retarder_n": 30_000.0})
    run = Truck(held, initial=InitialState(speed_mps=20.0), step_s=step_s)
    for _ in range(20):
        run.advance(Inputs(), round(0.2 / step_s))
        assert min(spins(run)) > 0.0
    assert run.outputs()["tractor_vx_mps"] > 15.0
    assert max(spins(run)) < 5.0


def test_drag_alone_stops_a_wheel_within_a_step_at_most(truck: Packed) -> None:
    """However light the wheel: the force takes its spin away and no more."""
    light = 1e-4
    force = hub_force_n(truck.params, 0.25, (0.0, 30_000.0, 20.0), 1.0, RADIUS_M, light, STEP_S)
    assert force * RADIUS_M * STEP_S / light == pytest.approx(-1.0)


def test_a_wheel_that_rolls_has_the_force_of_the_map_and_one_that_spins_the_power(truck: Packed
                                                                                  ) -> None:
    """In between the force falls without a step."""
    power, speed, slip = 90e3, 20.0, truck["driveline.rolling_slip"]

    def force(wheel_slip: float) -> float:
        spin = speed / (1.0 - wheel_slip) / RADIUS_M
        return hub_force_n(truck.params, 1.0, (power, 0.0, speed), spin, RADIUS_M, INERTIA_KGM2,
                           STEP_S)

    assert force(0.0) == force(0.9 * slip) == pytest.approx(power / speed)
    assert force(2.0 * slip) == pytest.approx(power / speed * (1.0 - 2.0 * slip))
    assert force(0.5) == pytest.approx(power / speed * 0.5)
    between = [force(s) for s in np.linspace(slip, 2.0 * slip, 101)]
    assert np.all(np.diff(between) < 0.0)
    assert np.min(np.diff(between)) > -0.01 * power / speed
