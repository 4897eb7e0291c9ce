from __future__ import annotations

import pytest

from truck_blowout_sim.physics.layout import STATE_UNIT_AT, UNIT_S
from truck_blowout_sim.simulation import InitialState, Inputs, Truck
from truck_blowout_sim.vehicle import Packed, load_vehicle, pack


def side_loads(out: dict[str, float], side: str) -> float:
    return sum(v for k, v in out.items() if k.startswith("tire_fz_") and f"_{side}" in k)


def test_static_loads_are_those_of_the_moment_balance(truck: Packed) -> None:
    out = Truck(truck).outputs()
    lb = 4.4482216152605
    steer = out["tire_fz_steer_left_n"] + out["tire_fz_steer_right_n"]
    drive = sum(v for k, v in out.items() if k.startswith("tire_fz_drive"))
    trailer = sum(v for k, v in out.items() if k.startswith("tire_fz_trailer"))
    assert (steer / lb, drive / lb, trailer / lb) == pytest.approx((11_925, 20_004, 20_070),
                                                                   rel=0.01)


def test_load_transfer_in_a_turn_balances_the_overturning_moment(truck: Packed) -> None:
    """Steady turn: (outer - inner) half track = lateral force at the heights of all masses."""
    run = Truck(truck, initial=InitialState(speed_mps=13.0))
    for k in range(100):
        run.advance(Inputs(min(0.02 * k, 2.0), 0.35), 10)
    for _ in range(60):
        run.advance(Inputs(2.0, 0.35), 100)
    out, p = run.outputs(), truck
    moment = 0.0
    for tire in run.vehicle.tires:
        hub = run.vehicle.hub_of_tire(tire)
        arm = p[f"hub.{hub}.y_m"] + p[f"tire.{tire}.y_m"]
        moment -= arm * out[f"tire_fz_{tire}_n"]
    overturning = 0.0
    for u, unit in enumerate(("tractor", "trailer")):
        s = STATE_UNIT_AT + u * len(UNIT_S)
        ay, height = run.state[s + UNIT_S.ay_mps2], run.state[s + UNIT_S.z_m]
        lean = run.state[s + UNIT_S.roll_rad]
        mass = p[f"unit.{unit}.mass_kg"]
        # the center of gravity also moves outward as the body leans about its roll axis
        overturning += mass * (ay * height + 9.81 * lean * (height - 0.65))
    for axle in run.vehicle.axles:
        overturning += p[f"axle.{axle}.mass_kg"] * ay * 0.5
    assert moment == pytest.approx(overturning, rel=0.05)
    assert side_loads(out, "right") > 1.5 * side_loads(out, "left")


def test_roll_steer_turns_the_drive_axles_out_of_a_lean(truck: Packed) -> None:
    """Understeer for a positive coefficient: in a left turn the axle steers to the left."""
    run = Truck(truck, initial=InitialState(speed_mps=13.0))
    for _ in range(40):
        run.advance(Inputs(1.5, 0.35), 100)
    out = run.outputs()
    assert out["tractor_roll_rad"] > 0.005
    assert out["drive_1_left_steer_rad"] > 0.1 * truck["axle.drive_1.roll_steer"] * 0.005


def test_a_misaligned_axle_pulls_alike_at_every_speed(truck: Packed) -> None:
    turned = truck.with_values({"axle.drive_1.misalignment_rad": 0.002,
                                "hub.steer_left.camber_rad": 0.0, "steering.compliance_on": 0.0})
    curvatures = []
    for speed in (10.0, 20.0):
        run = Truck(turned, initial=InitialState(speed_mps=speed))
        run.advance(Inputs(throttle=0.25), 4000)
        out = run.outputs()
        curvatures.append(out["tractor_yaw_rate_radps"] / out["tractor_vx_mps"])
    # a rear axle turned to the left pushes the tail to the left: the truck turns right
    assert curvatures[0] < -1e-5
    assert curvatures[1] == pytest.approx(curvatures[0], rel=0.2)


def test_a_two_axle_vehicle_without_trailer_runs_on_the_same_core() -> None:
    run = Truck(pack(load_vehicle("ferrari_250lm")), initial=InitialState(speed_mps=20.0))
    run.advance(Inputs(0.02, 0.2), 2000)
    out = run.outputs()
    assert run.finite
    assert out["tractor_yaw_rate_radps"] > 0.05
    assert out["articulation_rad"] == 0.0
