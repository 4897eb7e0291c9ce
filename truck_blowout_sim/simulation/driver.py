"""From the words of a scenario to the arrays of the compiled driver."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.recordings import INPUT_NAMES
from truck_blowout_sim.simulation.loop import PILOT
from truck_blowout_sim.simulation.scenario_schema import FollowSpec, ScenarioSpec, SweepSpec
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]
_CIRCUITS = ("steer", "drive", "trailer")


def input_table(spec: ScenarioSpec, times_s: Floats, recorded: Floats | None) -> Floats:
    """Inputs [n, 5] at ``times_s``: what the scenario says, over what was recorded, over zero."""
    table = np.zeros((times_s.size, len(INPUT_NAMES))) if recorded is None else recorded.copy()
    steering = spec.steering
    if steering and steering.table:
        table[:, 0] = np.interp(times_s, steering.table.time_s, steering.table.angle_rad)
    elif steering and steering.sweep:
        table[:, 0] = sweep(steering.sweep, times_s)
    if spec.throttle:
        table[:, 1] = np.interp(times_s, spec.throttle.time_s, spec.throttle.opening)
    elif spec.hold:
        table[:, 1] = 0.0
    for column, circuit in enumerate(_CIRCUITS, start=2):
        pressure = getattr(spec.brakes, circuit) if spec.brakes else None
        if pressure:
            table[:, column] = np.interp(times_s, pressure.time_s, pressure.pressure_pa)
    return table


def sweep(spec: SweepSpec, times_s: Floats) -> Floats:
    """Sine whose frequency rises exponentially; zero before and after."""
    duration = spec.end_s - spec.start_s
    t = times_s - spec.start_s
    growth = math.log(spec.end_hz / spec.start_hz)
    if abs(growth) < 1e-9:
        phase = spec.start_hz * t
    else:
        phase = spec.start_hz * duration / growth * np.expm1(growth * t / duration)
    inside = (t >= 0.0) & (t <= duration)
    return np.asarray(np.where(inside, spec.amplitude_rad * np.sin(2.0 * np.pi * phase), 0.0))


def speed_to_hold(spec: ScenarioSpec, times_s: Floats) -> Floats:
    """Speed [m/s] to hold at ``times_s``, NaN where the throttle table rules; empty without."""
    if spec.hold is None:
        return np.zeros(0)
    return np.where(times_s <= spec.hold.until_s, spec.hold.speed_mps, np.nan)


def pilot_of(spec: ScenarioSpec, packed: Packed, hand_wheel_rad: float) -> tuple[Floats, Floats]:
    """The compiled driver's parameters and path; both empty if nothing is closed-loop."""
    follow = spec.steering.follow if spec.steering else None
    if spec.hold is None and follow is None:
        return np.zeros(0), np.zeros((0, 2))
    pilot = np.zeros(len(PILOT))
    pilot[PILOT.hand_wheel_rad] = hand_wheel_rad
    if spec.hold:
        pilot[PILOT.hold] = 1.0
        pilot[PILOT.hold_gain_spm] = spec.hold.gain_spm
        pilot[PILOT.hold_integral_pm] = spec.hold.integral_pm
        pilot[PILOT.throttle_sum] = steady_throttle(packed, spec.hold.speed_mps)
    return _with_path(pilot, follow)


def _with_path(pilot: Floats, follow: FollowSpec | None) -> tuple[Floats, Floats]:
    if follow is None:
        return pilot, np.zeros((0, 2))
    pilot[PILOT.follow] = 1.0
    pilot[PILOT.preview_s] = follow.preview_s
    pilot[PILOT.least_preview_m] = follow.least_preview_m
    pilot[PILOT.lag_s] = follow.lag_s
    pilot[PILOT.fastest_radps] = follow.fastest_radps
    pilot[PILOT.most_rad] = follow.most_rad
    pilot[PILOT.understeer_rads2pm] = follow.understeer_rads2pm
    pilot[PILOT.trim_radpms] = follow.trim_radpms
    pilot[PILOT.follow_until_s] = follow.until_s
    return pilot, np.column_stack([follow.x_m, follow.y_m])


def steady_throttle(packed: Packed, speed_mps: float) -> float:
    """Throttle that about balances air, rolling and engine drag at a speed; the driver's start."""
    units, tires = packed.names.units, packed.names.tires
    area = sum(packed[f"unit.{u}.drag_area_m2"] for u in units)
    mass = sum(packed[f"unit.{u}.mass_kg"] for u in units)
    mass += sum(packed[f"axle.{a}.mass_kg"] for a in packed.names.axles)
    rolling = sum(packed[f"tire.{t}.rolling_0"] + packed[f"tire.{t}.rolling_spm"] * speed_mps
                  for t in tires) / len(tires)
    resistance = (0.5 * packed["world.air_density_kgpm3"] * area * speed_mps**2
                  + mass * packed["world.gravity_mps2"]
                  * (rolling + math.sin(packed["world.road_grade_rad"])))
    drag = packed["driveline.drag_n"]
    pull = packed["driveline.power_w"] / max(speed_mps, packed["driveline.creep_speed_mps"])
    pull = min(pull, packed["driveline.max_force_n"])
    if pull + drag <= 0.0:
        return 0.0
    return min(max((resistance + drag) / (pull + drag), 0.0), 1.0)
