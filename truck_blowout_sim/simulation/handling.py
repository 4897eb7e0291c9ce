"""Steady-state handling of a vehicle, measured by driving its model through two gentle turns.

References: ISO 4138 (steady-state circular driving behavior), constant speed, variable steer;
Gillespie, Fundamentals of Vehicle Dynamics, chapter 6.
Known limits: gentle turns on the vehicle's own road; speed imposed, so no drive force in the turn.
Validated with: test/simulation/test_handling.py (the closed form of the single-track model).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.simulation.drive import Drive, names_of, run_drive
from truck_blowout_sim.simulation.equilibrium import InitialState
from truck_blowout_sim.vehicle import Packed
from truck_blowout_sim.vehicle.given import AnyVehicle, packed_of
from truck_blowout_sim.vehicle.statics import axle_groups

STEP_S = 0.002
SETTLE_S = 8.0
MEAN_S = 1.0
LATERAL_MPS2 = (0.5, 1.5)  # where a turn is gentle: tires linear, load transfer small
USUAL_UNDERSTEER_RADPS2PM = 0.004  # of 2 deg/g: only to choose how far the hand wheel is turned


@dataclass(frozen=True)
class Handling:
    """Steady-state handling at one speed.

    Attributes:
        speed_mps: forward speed of the turns.
        wheelbase_m: steer axle to the middle of the rear axles.
        understeer_rad: road-wheel angle beyond L / R for each 1 g of lateral acceleration.
        yaw_gain_radps: yaw rate per hand-wheel angle [rad/s per rad].
        roll_rad: roll of the front unit for each 1 g of lateral acceleration, tires included.
        critical_speed_mps: speed of instability; None where the vehicle understeers.
    """

    speed_mps: float
    wheelbase_m: float
    understeer_rad: float
    yaw_gain_radps: float
    roll_rad: float
    critical_speed_mps: float | None


def handling(vehicle: AnyVehicle, speed_mps: float = 20.0) -> Handling:
    """Drive two gentle left turns at one speed and take the differences.

    Args:
        vehicle: the vehicle; one axle must be steered.
        speed_mps: imposed forward speed.

    Raises:
        InputError: nothing is steered, or the truck does not settle in a turn.
    """
    packed = packed_of(vehicle)
    spec = packed.vehicle.spec
    if spec.steering is None or not any(axle.steered for axle in spec.axles.values()):
        raise InputError("no axle is steered", file=packed.vehicle.path, expected="a steered axle")
    front, rear = axle_groups(spec.axles, "tractor")
    base = rear.x_m - front.x_m
    gravity = packed.vehicle.road.gravity_mps2
    per_lateral = spec.steering.ratio * (base / speed_mps**2 + USUAL_UNDERSTEER_RADPS2PM)
    angles = [0.5 * spec.steering.lash_rad + per_lateral * ay for ay in LATERAL_MPS2]
    (rate_1, roll_1), (rate_2, roll_2) = (_turn(packed, angle, speed_mps) for angle in angles)
    angle, rate = angles[1] - angles[0], rate_2 - rate_1
    if not np.isfinite(rate) or rate <= 0.0:
        raise InputError("does not settle in a gentle turn", file=packed.vehicle.path,
                         expected=f"a vehicle that can drive at {speed_mps:g} m/s")  # fmt: skip
    lateral_g = speed_mps * rate / gravity
    understeer = (angle / spec.steering.ratio - base * rate / speed_mps) / lateral_g
    critical = float(np.sqrt(-base * gravity / understeer)) if understeer < 0.0 else None
    return Handling(speed_mps, base, understeer, rate / angle, (roll_2 - roll_1) / lateral_g,
                    critical)  # fmt: skip


def _turn(packed: Packed, hand_wheel_rad: float, speed_mps: float) -> tuple[float, float]:
    """Yaw rate and outward roll [rad] in a steady left turn, means of the last second."""
    n = round(SETTLE_S / STEP_S)
    inputs = np.zeros((n, 5))
    inputs[:, 0] = hand_wheel_rad
    none = np.zeros(0, dtype=np.int64)
    drive = Drive(initial=InitialState(speed_mps=speed_mps), step_s=STEP_S, every=10, inputs=inputs,
                  speed=np.full(n, speed_mps), blow_steps=none, blown=none)  # fmt: skip
    out = run_drive(packed, drive)
    names = names_of(packed.vehicle)
    late = out[-round(MEAN_S / (10 * STEP_S)):]
    rate = late[:, names.index("tractor_yaw_rate_radps")].mean()
    roll = late[:, names.index("tractor_roll_rad")].mean()
    return float(rate), float(roll)
