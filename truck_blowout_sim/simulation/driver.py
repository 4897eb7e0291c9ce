"""From the words of a scenario to the arrays of the compiled driver."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics.layout import INPUT
from truck_blowout_sim.recordings import INPUT_NAMES
from truck_blowout_sim.simulation.loop import WATCH
from truck_blowout_sim.simulation.pilot import PILOT, PILOT_SIZE, REACT_STEERING, REACT_THROTTLE
from truck_blowout_sim.simulation.scenario_schema import (
    FollowSpec,
    HoldSpec,
    ReactionSpec,
    ScenarioSpec,
    SweepSpec,
    WhenSpec,
)
from truck_blowout_sim.vehicle import Packed
from truck_blowout_sim.vehicle.schema.axle import CIRCUITS

Floats = NDArray[np.float64]


def input_table(spec: ScenarioSpec, times_s: Floats, recorded: Floats | None) -> Floats:
    """Inputs [n, 5] at ``times_s``: what the scenario says, over what was recorded, over zero."""
    table = np.zeros((times_s.size, len(INPUT_NAMES))) if recorded is None else recorded.copy()
    steering = spec.steering
    if steering and steering.table:
        table[:, INPUT.steering_wheel_angle_rad] = np.interp(
            times_s, steering.table.time_s, steering.table.angle_rad)
    elif steering and steering.sweep:
        table[:, INPUT.steering_wheel_angle_rad] = sweep(steering.sweep, times_s)
    if spec.throttle:
        table[:, INPUT.throttle] = np.interp(times_s, spec.throttle.time_s, spec.throttle.opening)
    elif spec.hold:
        table[:, INPUT.throttle] = 0.0
    for circuit in CIRCUITS:
        pressure = getattr(spec.brakes, circuit) if spec.brakes else None
        if pressure:
            table[:, getattr(INPUT, f"brake_pressure_{circuit}_pa")] = np.interp(
                times_s, pressure.time_s, pressure.pressure_pa)
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
    hold = spec.hold
    if hold is None:
        reacts = spec.reaction is not None and spec.reaction.throttle == "speed_held"
        return np.full(times_s.size, np.nan) if reacts else np.zeros(0)
    wanted = (np.interp(times_s, hold.profile.time_s, hold.profile.speed_mps) if hold.profile
              else np.full(times_s.size, _held_mps(spec, hold)))
    return np.where(times_s <= hold.until_s, wanted, np.nan)


def _held_mps(spec: ScenarioSpec, hold: HoldSpec) -> float:
    """Speed [m/s] held first: the one that is said, else that of the start."""
    if hold.profile:
        return hold.profile.speed_mps[0]
    return spec.start.speed_mps if spec.start and math.isnan(hold.speed_mps) else hold.speed_mps


def pilot_of(spec: ScenarioSpec, packed: Packed, inputs: Floats, watch: int) -> tuple[Floats,
                                                                                      Floats]:
    """The compiled driver's parameters and path; both empty if nothing is closed-loop.

    Args:
        inputs: the first ones of the run; ``watch``: number of the reaction's condition, or -1.
    """
    follow = spec.steering.follow if spec.steering else None
    if spec.hold is None and follow is None and spec.reaction is None:
        return np.zeros(0), np.zeros((0, 2))
    pilot = np.zeros(PILOT_SIZE)
    pilot[PILOT.hand_wheel_rad] = inputs[INPUT.steering_wheel_angle_rad]
    pilot[PILOT.throttle_sum] = inputs[INPUT.throttle]
    pilot[PILOT.noticed_s] = np.inf
    if spec.hold:
        _hold(pilot, spec.hold)
        pilot[PILOT.throttle_sum] = steady_throttle(packed, _held_mps(spec, spec.hold))
    if spec.reaction:
        _react(pilot, spec.reaction, watch)
        if spec.hold is None and spec.reaction.throttle == "speed_held" and not spec.recording:
            _hold(pilot, HoldSpec())
    return _with_path(pilot, follow)


def watch_row(when: WhenSpec) -> Floats:
    """A condition as a row of the compiled loop's table."""
    row = np.full(len(WATCH), np.nan)
    row[WATCH.met_s] = np.inf
    for key in WATCH._fields[:-1]:
        row[getattr(WATCH, key)] = getattr(when, key)
    return row


def _hold(pilot: Floats, hold: HoldSpec) -> None:
    pilot[PILOT.hold] = 1.0
    pilot[PILOT.hold_gain_spm] = hold.gain_spm
    pilot[PILOT.hold_integral_pm] = hold.integral_pm


def _react(pilot: Floats, reaction: ReactionSpec, watch: int) -> None:
    pilot[PILOT.react] = 1.0
    pilot[PILOT.react_watch] = watch
    pilot[PILOT.react_time_s] = reaction.time_s
    pilot[PILOT.react_steering] = REACT_STEERING.index(reaction.steering)
    pilot[PILOT.react_throttle] = REACT_THROTTLE.index(reaction.throttle)
    pilot[PILOT.react_throttle_over_s] = reaction.throttle_over_s
    pilot[PILOT.react_brake_pa] = reaction.brake_pa
    pilot[PILOT.react_brake_delay_s] = reaction.brake_delay_s
    pilot[PILOT.react_brake_over_s] = reaction.brake_over_s
    if pilot[PILOT.hold_gain_spm] == 0.0:  # a speed held only in answer: the usual driver's gains
        pilot[PILOT.hold_gain_spm] = HoldSpec().gain_spm
        pilot[PILOT.hold_integral_pm] = HoldSpec().integral_pm


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
