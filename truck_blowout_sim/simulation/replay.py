"""Drive the model with a recording's inputs and blowouts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.physics.layout import INPUT
from truck_blowout_sim.recordings import INPUT_NAMES, Blowout, Recording, Series, channels_for
from truck_blowout_sim.recordings.stray_time import require_span
from truck_blowout_sim.simulation.drive import (
    Drive,
    Ran,
    execute,
    names_of,
    run_drive,
    total_mass_kg,
)
from truck_blowout_sim.simulation.equilibrium import InitialState
from truck_blowout_sim.simulation.flat import flat_at, flat_notes, split_at
from truck_blowout_sim.simulation.inputs import opening
from truck_blowout_sim.simulation.plausible import diverged, implausible
from truck_blowout_sim.simulation.rates import check_delays, check_rates
from truck_blowout_sim.simulation.silences import silences
from truck_blowout_sim.simulation.start import initial_state, start_time_s
from truck_blowout_sim.vehicle import Packed, Vehicle, pack
from truck_blowout_sim.vehicle.given import AnyVehicle, packed_of

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
__all__ = ["Drive", "as_recording", "drive_from", "implausible_inputs", "names_of", "run_drive",
           "simulate_inputs", "total_mass_kg"]
_COARSE_S = 0.01  # inputs are looked at on this grid
STATED_SPEED_WORDS = "speed imposed: throttle or brakes were not recorded"
_ASKED_SPEED_WORDS = "speed imposed, as asked"


def drive_from(recording: Recording, vehicle: Vehicle, *, step_s: float = 0.001,
               rate_hz: float = 100.0, initial: InitialState | None = None,
               impose_speed: bool | None = None) -> Drive:
    """Prepare a run on a recording's inputs.

    Args:
        impose_speed: None: impose the recorded speed where throttle or a brake pressure is missing.

    Raises:
        InputError: no steering, no speed to impose, a blown tire the vehicle does not have, a
            throttle beyond 0 to 1, or a log of more than a day.
    """
    require_span(recording)
    missing = _missing(recording, vehicle)
    if "steering_wheel_angle_rad" in missing:
        raise InputError("steering_wheel_angle_rad was not recorded", file=recording.name,
                         expected="the hand wheel angle, without which no run can be driven")
    impose = bool(missing) if impose_speed is None else impose_speed
    start, end = start_time_s(recording), recording.end_s
    n_steps = round((end - start) / step_s)
    if n_steps < 1:
        raise InputError(f"lasts {end - start:g} s", file=recording.name,
                         expected=f"inputs over {step_s:g} s or more, one step of the simulation")
    times = start + step_s * np.arange(n_steps, dtype=np.float64)
    speed = _speed(recording, times) if impose else np.zeros(0)
    _check_tires(recording, vehicle)
    before, timed = split_at(recording.blowouts, start, step_s)
    begin = initial or initial_state(recording)
    if before:
        begin = replace(begin, flat=flat_at(before, start))
    steps, tires = _blowouts(timed, vehicle, start, step_s)
    return Drive(begin, step_s, max(round(1.0 / rate_hz / step_s), 1),
                 _inputs(recording, times), speed, steps, tires)


def implausible_inputs(recordings: Sequence[Recording], vehicle: Vehicle, *,
                       impose_speed: bool | None = None) -> tuple[str, ...]:
    """What in the inputs of recordings no truck does, with the recording's name; mostly nothing.

    Raises:
        InputError: see :func:`drive_from`.
    """
    packed = pack(vehicle)
    drives = [(r, drive_from(r, vehicle, step_s=_COARSE_S, impose_speed=impose_speed))
              for r in recordings]
    return tuple(f"{r.name}: {clause}" for r, drive in drives
                 for clause in implausible(packed, drive))


def simulate_inputs(vehicle: AnyVehicle, recording: Recording, *, step_s: float = 0.001,
                    rate_hz: float = 100.0, initial: InitialState | None = None,
                    impose_speed: bool | None = None) -> Recording:
    """The model driven by a recording: a recording with the same clock.

    Raises:
        InputError: an impossible step or rate; and see :func:`drive_from`.
        DivergedError: the run left the range of the model.
    """
    check_rates(step_s, rate_hz)
    packed = packed_of(vehicle)
    check_delays(packed, step_s)
    drive = drive_from(recording, packed.vehicle, step_s=step_s, rate_hz=rate_hz, initial=initial,
                       impose_speed=impose_speed)
    return replayed(recording, packed, drive)


def replayed(recording: Recording, packed: Packed, drive: Drive) -> Recording:
    """The model's run on the inputs of a recording, as :func:`drive_from` prepared it.

    Raises:
        DivergedError: the run left the range of the model.
    """
    run = as_recording(
        f"{recording.name} (simulated)", packed, drive, execute(packed, drive), recording.blowouts,
        why_imposed=STATED_SPEED_WORDS if speed_is_missing(recording, packed.vehicle)
        else _ASKED_SPEED_WORDS)
    return replace(run, notes=(*run.notes, *flat_notes(drive.initial.flat),
                               *silences(recording)))


def speed_is_missing(recording: Recording, vehicle: Vehicle) -> bool:
    """Whether throttle or a brake pressure at work was not recorded, so that speed is imposed."""
    return bool(_missing(recording, vehicle) - {"steering_wheel_angle_rad"})


def _missing(recording: Recording, vehicle: Vehicle) -> set[str]:
    """Inputs at work in the vehicle that were not recorded."""
    return set(recording.missing_inputs) - _not_at_work(vehicle)


def as_recording(name: str, packed: Packed, drive: Drive, ran: Ran,
                 blowouts: Sequence[Blowout], metadata: dict[str, str] | None = None, *,
                 why_imposed: str = _ASKED_SPEED_WORDS) -> Recording:
    """Outputs and inputs of a run as a recording; up to the instant at which a unit rolled over.

    ``why_imposed``: the note of a run along a recorded speed.

    Raises:
        DivergedError: the run left the range of the model.
    """
    if ran.ending is not None and not ran.ending.rolled_over:
        raise diverged(packed, drive, ran.ending, name)
    out, vehicle = ran.out, packed.vehicle
    good = np.isfinite(out).all(axis=1)
    n = int(np.argmin(good)) if not good.all() else good.size
    times = drive.times_s[:n]
    known = _channels(vehicle)
    channels = {key: Series(times, out[:n, k]) for k, key in enumerate(names_of(vehicle))
                if key in known}
    held = ran.inputs[np.minimum(np.arange(n) * drive.every, len(ran.inputs) - 1)]
    channels |= {key: Series(times, held[:, k]) for k, key in enumerate(INPUT_NAMES)}
    text = {"vehicle": vehicle.name, "step_s": repr(drive.step_s), **(metadata or {})}
    notes: tuple[str, ...] = (why_imposed,) if drive.speed_imposed else ()
    if ran.ending is not None:
        text |= {"rolled_over_unit": ran.ending.unit, "rolled_over_s": f"{ran.ending.time_s:.3f}"}
        notes += (f"{ran.ending.words} at {ran.ending.time_s:.2f} s; the run ends there, because "
                  "what a side does on the ground is beyond the model",)
    return Recording(name, channels, tuple(blowouts), text, notes)


def _channels(vehicle: Vehicle) -> set[str]:
    """Names that the table of channels has for this vehicle."""
    steered = [hub for hub in vehicle.hubs if vehicle.spec.axles[vehicle.axle_of_hub(hub)].steered]
    table = channels_for(vehicle.hubs, vehicle.tires, vehicle.units, steered)
    return {channel.name for channel in table}


def _not_at_work(vehicle: Vehicle) -> set[str]:
    """Brake pressures that reach no brake of this vehicle, as a trailer's of a car."""
    at_work = {axle.circuit for axle in vehicle.spec.axles.values() if axle.brake is not None}
    return {name for name in INPUT_NAMES if name.startswith("brake_pressure_")
            and name.removeprefix("brake_pressure_").removesuffix("_pa") not in at_work}


def _inputs(recording: Recording, times: Floats) -> Floats:
    """The recorded inputs on the step grid, 0 where not recorded."""
    found = np.nan_to_num(recording.inputs_at(times))
    throttle = found[:, INPUT.throttle]
    for end in (throttle.min(), throttle.max()):
        opening(float(end), recording.name)
    found[:, INPUT.throttle] = throttle.clip(0.0, 1.0)
    return found


def _speed(recording: Recording, times_s: Floats) -> Floats:
    """The recorded forward speed on the step grid."""
    if "tractor_vx_mps" not in recording:
        raise InputError("throttle or brakes were not recorded, nor was tractor_vx_mps",
                         file=recording.name, expected="throttle and brake pressures, or a speed")
    series = recording["tractor_vx_mps"]
    return np.interp(times_s, series.time_s, series.value)


def _check_tires(recording: Recording, vehicle: Vehicle) -> None:
    """Refuse a blowout of a tire that the vehicle does not have."""
    for event in recording.blowouts:
        for tire in event.tires:
            if tire not in vehicle.tires:
                raise InputError(f"blowout of unknown tire {tire!r}", file=recording.name,
                                 expected="one of " + ", ".join(vehicle.tires))


def _blowouts(timed: Sequence[Blowout], vehicle: Vehicle, start_s: float, step_s: float
              ) -> tuple[Integers, Integers]:
    """Steps and tire numbers of blowouts during the run."""
    steps, tires = [], []
    for event in timed:
        for tire in event.tires:
            steps.append(max(round((event.time_s - start_s) / step_s), 0))
            tires.append(vehicle.tires.index(tire))
    return np.array(steps, dtype=np.int64), np.array(tires, dtype=np.int64)
