"""Hubs with their tires inside the whole truck: rolling, sharing, losing a dual."""

from __future__ import annotations

import pytest

from truck_blowout_sim.simulation import InitialState, Inputs, Truck
from truck_blowout_sim.vehicle import Packed


def rolling(truck: Packed, speed: float = 20.0) -> Truck:
    run = Truck(truck, initial=InitialState(speed_mps=speed))
    run.advance(Inputs(throttle=0.25), 1000)
    return run


def test_free_wheels_roll_on_their_rolling_radius(truck: Packed) -> None:
    out = rolling(truck).outputs()
    for hub in ("steer_left", "trailer_1_right"):
        tire = hub if hub == "steer_left" else f"{hub}_outer"
        deflection = (truck[f"tire.{tire}.unloaded_radius_m"]
                      - out[f"tire_loaded_radius_{tire}_m"])
        radius = truck[f"tire.{tire}.unloaded_radius_m"] - deflection / 3.0
        assert out[f"hub_speed_{hub}_radps"] * radius == pytest.approx(
            out["tractor_vx_mps"], rel=2e-3)


def test_belt_of_a_flat_tire_keeps_the_wheel_speed(truck: Packed) -> None:
    """A rolling radius of 0.48 m on the rim: the hub gains 3 %, not 64 %."""
    run = rolling(truck)
    before = run.outputs()["hub_speed_steer_left_radps"]
    run.blow("steer_left")
    run.advance(Inputs(throttle=0.25), 1500)
    out = run.outputs()
    assert out["tire_loaded_radius_steer_left_m"] == pytest.approx(0.345, abs=0.004)
    assert 1.0 < out["hub_speed_steer_left_radps"] / before < 1.06


def test_a_blown_dual_hangs_clear_and_its_partner_carries_the_load(truck: Packed) -> None:
    run = rolling(truck)
    before = run.outputs()
    pair = sum(before[f"tire_fz_trailer_1_right_{k}_n"] for k in ("outer", "inner"))
    run.blow("trailer_1_right_outer")
    run.advance(Inputs(throttle=0.25), 3000)
    after = run.outputs()
    assert after["tire_fz_trailer_1_right_outer_n"] < 0.12 * pair
    assert after["tire_fz_trailer_1_right_inner_n"] > 0.8 * pair
    assert after["tire_loaded_radius_trailer_1_right_inner_m"] > 0.44


def test_loads_add_up_to_the_weight(truck: Packed) -> None:
    out = rolling(truck).outputs()
    total = sum(v for k, v in out.items() if k.startswith("tire_fz_"))
    weight = 9.81 * sum(truck[n] for n in truck.index if n.endswith(".mass_kg"))
    assert total == pytest.approx(weight, rel=2e-3)


def test_two_blown_tires_ride_on_the_rim(truck: Packed) -> None:
    run = rolling(truck)
    for dual in ("outer", "inner"):
        assert run.blow(f"drive_1_left_{dual}")
    assert not run.blow("drive_1_left_outer")
    run.advance(Inputs(throttle=0.25), 3000)
    out = run.outputs()
    assert out["tire_pressure_drive_1_left_outer_pa"] == 0.0
    assert out["tire_fz_drive_1_left_outer_n"] + out["tire_fz_drive_1_left_inner_n"] > 1000.0
    assert run.finite
