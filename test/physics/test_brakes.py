from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.physics import brakes
from truck_blowout_sim.physics.layout import HUB_S, INPUT, N_INPUTS, TOPOLOGY
from truck_blowout_sim.simulation import (
    InitialState,
    Inputs,
    Truck,
    simulate,
    simulate_inputs,
)
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]
Block = Callable[[str], int]
Slot = Callable[[str, str], int]
PSI = 6894.757293168361


@pytest.mark.parametrize(("psi", "knm"), [(20, 2.3), (40, 5.4), (60, 8.3), (80, 11.2), (100, 13.9),
                                          (4, 0.0)])
def test_torque_curve(truck: Packed, state: Floats, block: Block, slot: Slot, psi: float,
                      knm: float) -> None:
    s, h = slot("hub", "trailer_1_left"), block("hub.trailer_1_left")
    state[s + HUB_S.chamber_pa] = psi * PSI
    torque = brakes.torque_nm(state, s, truck.params, h, 2)
    assert torque / 1000.0 == pytest.approx(knm, abs=0.06)


def test_a_disabled_brake_or_circuit_gives_nothing(truck: Packed, state: Floats, block: Block,
                                                   slot: Slot) -> None:
    s, h = slot("hub", "trailer_1_left"), block("hub.trailer_1_left")
    state[s + HUB_S.chamber_pa] = 60 * PSI
    for name in ("hub.trailer_1_left.brake_enabled", "circuit.trailer.enabled"):
        off = truck.with_values({name: 0.0})
        assert brakes.torque_nm(state, s, off.params, h, 2) == 0.0
    weak = truck.with_values({"hub.trailer_1_left.brake_gain": 0.35})
    assert brakes.torque_nm(state, s, weak.params, h, 2) == pytest.approx(
        0.35 * brakes.torque_nm(state, s, truck.params, h, 2))


def test_heat_fades_the_torque(truck: Packed, state: Floats, block: Block, slot: Slot) -> None:
    s, h = slot("hub", "drive_1_left"), block("hub.drive_1_left")
    state[s + HUB_S.chamber_pa], state[s + HUB_S.heat_j] = 60 * PSI, 1e6
    cold = brakes.torque_nm(state, s, truck.params, h, 1)
    hot = brakes.torque_nm(state, s, truck.with_values({"circuit.drive.fade_per_j": 1e-6}).params,
                           h, 1)
    assert hot == pytest.approx(0.5 * cold)


def test_pressure_arrives_after_delay_and_lag(truck: Packed, state: Floats, slot: Slot) -> None:
    """A step of control pressure: nothing for the delay, then 1 - exp(-t/lag)."""
    s, dt = slot("hub", "drive_1_left"), 0.001
    delay, lag = truck["circuit.drive.delay_s"], truck["circuit.drive.lag_s"]
    inputs = np.zeros(N_INPUTS)
    inputs[3] = 4e5
    pressure = []
    for _ in range(800):
        brakes.write_lines(state, truck.topology, inputs)
        arrived = brakes.delayed_pa(state, truck.params, truck.topology, 1, dt)
        brakes.advance_chamber(state, s, truck.params, 1, arrived, dt)
        pressure.append(state[s + HUB_S.chamber_pa])
    times = dt * np.arange(1, 801)
    expected = np.where(times > delay, 4e5 * (1.0 - np.exp(-(times - delay) / lag)), 0.0)
    assert np.abs(np.array(pressure) - expected).max() < 0.01 * 4e5
    assert pressure[round(delay / dt) - 2] == 0.0


def test_delays_between_two_steps_are_interpolated(truck: Packed, state: Floats) -> None:
    odd = truck.with_values({"circuit.drive.delay_s": 0.0104})
    inputs = np.zeros(N_INPUTS)
    for k in range(200):
        inputs[3] = 1000.0 * k
        brakes.write_lines(state, odd.topology, inputs)
    assert brakes.delayed_pa(state, odd.params, odd.topology, 1, 0.001) == pytest.approx(
        1000.0 * (199 - 10.4))


def test_a_locked_wheel_stays_locked_and_is_never_driven(state: Floats, slot: Slot) -> None:
    s = slot("hub", "drive_1_left")
    state[s + HUB_S.spin_radps] = 2.0
    for _ in range(300):
        used = brakes.advance_spin(state, s, 30.0, 500.0, 3000.0, 0.001)
    assert state[s + HUB_S.spin_radps] == 0.0
    assert used == pytest.approx(500.0)


def test_heat_is_the_work_of_the_brake(state: Floats, slot: Slot) -> None:
    s, inertia = slot("hub", "drive_1_left"), 32.0
    state[s + HUB_S.spin_radps] = 40.0
    for _ in range(3000):
        brakes.advance_spin(state, s, inertia, 0.0, 1000.0, 0.001)
    assert state[s + HUB_S.heat_j] == pytest.approx(0.5 * inertia * 40.0**2, rel=1e-9)
    assert math.isclose(state[s + HUB_S.spin_radps], 0.0)


def test_trailer_brakes_come_later_than_the_tractors(truck: Packed) -> None:
    """60 % of full pressure after 0.24 s in the tractor's chambers, 0.33 s in the trailer's."""
    run, reached = Truck(truck, initial=InitialState(speed_mps=20.0)), {}
    for k in range(500):
        run.advance(Inputs(0.0, 0.0, 5e5, 5e5, 5e5))
        for hub in ("steer_left", "drive_2_right", "trailer_2_left"):
            if run.outputs()[f"brake_chamber_{hub}_pa"] > 3e5:
                reached.setdefault(hub, 0.001 * k)
    assert reached["steer_left"] == pytest.approx(0.10 + 0.15 * math.log(2.5), abs=0.003)
    assert reached["drive_2_right"] == reached["steer_left"]
    assert reached["trailer_2_left"] == pytest.approx(0.15 + 0.20 * math.log(2.5), abs=0.003)


def test_a_delay_is_as_long_as_it_says_or_refused(truck: Packed, slot: Slot) -> None:
    """The line holds 1,000 samples: a second has room in them at 2 ms, not at 1 ms."""
    late = truck.with_values({"circuit.steer.delay_s": 0.9, "circuit.steer.delay_extra_s": 0.1})
    words = r"the steer brakes come 1 s late; expected at most 0\.998 s with a step of 0\.001 s"
    with pytest.raises(InputError, match=words):
        Truck(late)
    for run in (simulate, lambda packed, name: simulate_inputs(packed, simulate(truck, name))):
        with pytest.raises(InputError, match="the steer brakes come 1 s late"):
            run(late, "brake_stop")
    braked = Truck(late, step_s=0.002)
    at = slot("hub", "steer_left") + HUB_S.chamber_pa
    for _ in range(510):
        if braked.state[at] > 0.0:
            break
        braked.advance(Inputs(brake_pressure_steer_pa=3e5))
    assert braked.time_s == pytest.approx(1.0, abs=0.005)


def test_a_delay_reads_its_own_line_wherever_that_is_written(truck: Packed, state: Floats) -> None:
    """0.3 s is 300 steps but for the last bit: no place of the ring may lead beyond it."""
    late = truck.with_values({f"circuit.{c}.{key}": value for c in ("drive", "trailer")
                              for key, value in (("delay_s", 0.1), ("delay_extra_s", 0.2))})
    n = int(late.topology[TOPOLOGY.line_length])
    room = np.concatenate([state, np.full(n, 777.0)])  # what lies behind the state
    inputs = np.zeros(N_INPUTS)
    inputs[INPUT.brake_pressure_steer_pa] = 5e5  # the line of another circuit is full
    for _ in range(n + 350):
        brakes.write_lines(room, late.topology, inputs)
        for circuit in (1, 2):
            assert brakes.delayed_pa(room, late.params, late.topology, circuit, 0.001) == 0.0
