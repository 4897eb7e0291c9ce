from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from truck_blowout_sim.physics import abs_logic
from truck_blowout_sim.physics.layout import (
    HUB_S,
    MAX_TIRES,
    N_WORK,
    SLIPS_AT,
    TIRE_S,
    TOPOLOGY,
    TOPOLOGY_SIZE,
)
from truck_blowout_sim.physics.step import fill_slips, sensed_slip
from truck_blowout_sim.simulation import InitialState, Inputs, Truck
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]


def released(truck: Packed, state: Floats, slip: float, speed: float = 20.0, steps: int = 1
             ) -> bool:
    s = int(truck.topology[TOPOLOGY.state_hub_at])
    for _ in range(steps):
        abs_logic.decide(state, s, truck.params, slip, speed, 0.001)
    return bool(state[s + HUB_S.released] > 0.0)


def test_thesis_thresholds(thesis: Packed, state: Floats) -> None:
    assert not released(thesis, state, 0.0799)
    assert released(thesis, state, 0.0801)
    assert released(thesis, state, 0.0601)
    assert not released(thesis, state, 0.0599)


def test_a_release_lasts_its_hold_time(truck: Packed, state: Floats) -> None:
    hold = round(truck["abs.hold_s"] / 0.001)
    assert released(truck, state, truck["abs.slip_off"] + 0.01)
    assert released(truck, state, 0.0, steps=hold - 2)
    assert not released(truck, state, 0.0, steps=4)


def test_nothing_is_released_below_the_cut_out_speed_or_with_the_abs_off(truck: Packed,
                                                                        state: Floats) -> None:
    assert not released(truck, state, 0.9, speed=truck["abs.cutout_speed_mps"] - 0.1)
    assert not released(truck.with_values({"abs.mode": 0.0}), state, 0.9)


def test_who_senses_what(truck: Packed, state: Floats, work: Floats) -> None:
    """Trailer: the worse wheel of the rear axle for all; drive: first axle, side by side."""
    vehicle, at = truck.vehicle, int(truck.topology[TOPOLOGY.state_tire_at])
    for number, tire in enumerate(vehicle.tires):
        hub = vehicle.hub_of_tire(tire)
        state[at + number * len(TIRE_S) + TIRE_S.fz_n] = 1e4
        slips = {"trailer_2_left": -0.3, "drive_1_right": -0.2, "drive_2_right": -0.4,
                 "steer_left": -0.1}
        state[at + number * len(TIRE_S) + TIRE_S.slip] = slips.get(hub, 0.0)

    fill_slips(state, truck.topology, work)

    def slip(axle: str, side: int) -> float:
        number = vehicle.axles.index(axle)
        circuit = {"s": 0, "d": 1, "t": 2}[axle[0]]
        return sensed_slip(truck.params, truck.topology, number, side, circuit, work)

    assert [slip("trailer_1", k) for k in (0, 1)] == pytest.approx([0.3, 0.3])
    assert [slip("drive_2", k) for k in (0, 1)] == pytest.approx([0.0, 0.2])
    assert [slip("steer", k) for k in (0, 1)] == pytest.approx([0.1, 0.0])
    per_wheel = truck.with_values({"abs.mode": 1.0})
    number = vehicle.axles.index("drive_2")
    assert sensed_slip(per_wheel.params, truck.topology, number, 1, 1, work) == pytest.approx(0.4)


def test_every_hub_has_room_for_its_slip() -> None:
    """As many hubs as tires can be: nothing is written behind the working memory."""
    topology = np.zeros(TOPOLOGY_SIZE + MAX_TIRES, dtype=np.int64)
    topology[[TOPOLOGY.n_hubs, TOPOLOGY.n_tires]] = MAX_TIRES
    topology[TOPOLOGY_SIZE:] = np.arange(MAX_TIRES)
    state, work = np.zeros(MAX_TIRES * len(TIRE_S)), np.full(N_WORK + 100, np.nan)
    state[TIRE_S.fz_n::len(TIRE_S)] = 1e4
    state[TIRE_S.slip::len(TIRE_S)] = -0.2
    fill_slips(state, topology, work)
    assert work[SLIPS_AT:N_WORK] == pytest.approx(0.2)
    assert np.isnan(work[N_WORK:]).all()


@pytest.mark.parametrize("speed", [15.0, -15.0])
def test_no_wheel_stays_locked_either_way(truck: Packed, speed: float) -> None:
    """Braked hard on a wet road: wheels turn, and the truck slows down alike in reverse."""
    wet = truck.with_values({"world.friction_scale": 0.3})
    run = Truck(wet, initial=InitialState(speed_mps=speed))
    turning = []
    for _ in range(100):
        run.advance(Inputs(0.0, 0.0, 6e5, 6e5, 6e5), 20)
        out = run.outputs()
        turning += [abs(out[f"hub_speed_{hub}_radps"]) > 1.0 for hub in wet.names.hubs]
    assert np.mean(turning) > 0.95
    lost = abs(speed) - abs(run.outputs()["tractor_vx_mps"])
    assert lost == pytest.approx(3.4, abs=0.2)
