"""Whether a run is one that a truck can do, and why one left the range of the model.

References: nothing is measured here; each limit lies well beyond what road trucks do or are
allowed (steering stops near 45 deg, compressors cut out near 0.9 MPa, hydraulic units of cars reach
15 to 20 MPa; trucks are governed below 40 m/s).
Validated with: test/simulation/test_ending.py.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.physics.layout import INPUT, N_INPUTS
from truck_blowout_sim.simulation.drive import Drive
from truck_blowout_sim.simulation.ending import Ending
from truck_blowout_sim.simulation.pilot import PILOT
from truck_blowout_sim.vehicle import Packed, Vehicle, pack

MOST_SPEED_MPS = {"air": 60.0, "hydraulic": 100.0}  # trucks; cars reach 100 m/s on circuits
_MOST_ROAD_WHEEL_RAD = math.radians(60.0)
MOST_BRAKE_PA = {"air": 1.2e6, "hydraulic": 2.5e7}
_MOST_CHANGE = 5.0  # times, of a parameter against the vehicle's file
# Explicit steps follow a spring only while the phase they advance a step is small.
_MOST_PHASE_RAD = 0.5


def implausible(packed: Packed, drive: Drive) -> tuple[str, ...]:
    """What in a prepared run no truck does: one clause each, empty where all is plausible."""
    found = _speeds(drive, MOST_SPEED_MPS[packed.vehicle.spec.brakes])
    wheel = float(np.abs(drive.inputs[:, INPUT.steering_wheel_angle_rad]).max(initial=0.0))
    if wheel / packed["steering.ratio"] > _MOST_ROAD_WHEEL_RAD:
        found.append(f"a hand wheel of {math.degrees(wheel):.0f} deg turns the road wheels by "
                     f"{math.degrees(wheel / packed['steering.ratio']):.0f} deg")
    throttle = drive.inputs[:, INPUT.throttle]
    if throttle.min(initial=0.0) < 0.0 or throttle.max(initial=1.0) > 1.0:
        worst = throttle[np.abs(throttle - 0.5).argmax()]
        found.append(f"a throttle of {worst:g}, which goes from 0 to 1 and is likely in per cent")
    most = drive.inputs[:, INPUT.brake_pressure_steer_pa:N_INPUTS].max(initial=0.0)
    if drive.pilot.size:
        most = max(most, drive.pilot[PILOT.react_brake_pa])
    if words := too_much_pressure(packed.vehicle, float(most)):
        found.append(words)
    return tuple(found)


def too_much_pressure(vehicle: Vehicle, control_pa: float) -> str:
    """A clause on a control pressure that the vehicle's brakes never have; empty below it."""
    kind = vehicle.spec.brakes
    if control_pa <= MOST_BRAKE_PA[kind]:
        return ""
    return f"a control pressure of {control_pa / 1e3:.0f} kPa with {kind} brakes"


class DivergedError(InputError):
    """A run that left the range of the model: no result. Says the instant and likeliest cause."""


def diverged(packed: Packed, drive: Drive, ending: Ending, name: str) -> DivergedError:
    """The error for a run that ended in failure."""
    return DivergedError(
        f"the run left the range of the model at {ending.time_s:.3f} s: {ending.words}; "
        f"likeliest cause: {likeliest_cause(packed, drive)}", file=name)


def likeliest_cause(packed: Packed, drive: Drive) -> str:
    """Why a run left the range of the model, most obvious first."""
    if found := implausible(packed, drive):
        return f"implausible input ({'; '.join(found)})"
    if words := _too_stiff(packed, drive.step_s):
        return words
    if words := _largest_change(packed):
        return words
    return f"a step of {1e3 * drive.step_s:g} ms, or a parameter that does not fit the others"


def _speeds(drive: Drive, most_mps: float) -> list[str]:
    speeds = {"start": abs(drive.initial.speed_mps),
              "held": float(np.nanmax(np.abs(drive.speed), initial=0.0))}
    return [f"a {key} speed of {value:.0f} m/s" if key == "start" else
            f"a speed of {value:.0f} m/s to hold"
            for key, value in speeds.items() if value > most_mps]


def _too_stiff(packed: Packed, step_s: float) -> str:
    """The axle that swings fastest on its tires, if the step is too long for it; else empty."""
    worst, words = _MOST_PHASE_RAD, ""
    for axle in packed.names.axles:
        hubs = [h for h in packed.names.hubs if packed.vehicle.axle_of_hub(h) == axle]
        stiffness = sum(
            packed[f"tire.{t}.stiffness_npm"]
            + packed[f"tire.{t}.stiffness_npmppa"] * packed[f"tire.{t}.pressure_pa"]
            for hub in hubs for t in packed.vehicle.tires_of_hub(hub))
        phase = math.sqrt(stiffness / packed[f"axle.{axle}.mass_kg"]) * step_s
        if phase > worst:
            worst = phase
            words = (f"axle {axle} swings on its tires at {phase / step_s / 2.0 / math.pi:.0f} Hz, "
                     f"too fast for a step of {1e3 * step_s:g} ms")
    return words


def _largest_change(packed: Packed) -> str:
    """The parameter farthest from the vehicle's file, if it is far; else empty."""
    usual: NDArray[np.float64] = pack(packed.vehicle).params
    worst, words = _MOST_CHANGE, ""
    for name, at in packed.index.items():
        here, there = float(packed.params[at]), float(usual[at])
        if here == there or not (math.isfinite(here) and math.isfinite(there)) or there == 0.0:
            continue
        times = abs(here / there) if here else math.inf
        if max(times, 1.0 / times if times else math.inf) > worst:
            worst = max(times, 1.0 / times if times else math.inf)
            words = f"{name} is {here:g}, {there:g} in the vehicle's file"
    return words
