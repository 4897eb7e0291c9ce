"""What a scenario takes from the recording that it names, laid on the scenario's own steps."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import Blowout, Recording, read_recording
from truck_blowout_sim.simulation.equilibrium import InitialState
from truck_blowout_sim.simulation.replay import drive_from
from truck_blowout_sim.simulation.scenario import Scenario
from truck_blowout_sim.vehicle import Vehicle

Floats = NDArray[np.float64]
_TOLD_S = 0.1  # commands held for less are those between two samples of a slow logger


@dataclass(frozen=True, eq=False)
class Logged:
    """A recording as a scenario drives it.

    Attributes:
        initial: how the log begins.
        inputs: [n_steps, 5]; before and after the log its first and last ones are held.
        speed: [n_steps] speed to impose; empty where throttle and brakes were recorded.
        blowouts: of the log.
        notes: which commands are held.
    """

    initial: InitialState
    inputs: Floats
    speed: Floats
    blowouts: tuple[Blowout, ...]
    notes: tuple[str, ...]


def logged(scenario: Scenario, vehicle: Vehicle, n_steps: int, *, step_s: float, rate_hz: float
           ) -> Logged:
    """The recording that a scenario names.

    Raises:
        InputError: no such recording, none at the scenario's time, or none to drive on.
    """
    spec, whole = scenario.spec, _recording(scenario)
    _check_span(scenario, whole)
    part = whole.between(spec.start_s, spec.end_s)
    base = drive_from(part, vehicle, step_s=step_s, rate_hz=rate_hz)
    late = max(round((base.initial.time_s - spec.start_s) / step_s), 0)
    speed = _on_steps(base.speed, late, n_steps) if base.speed.size else base.speed
    return Logged(base.initial, _on_steps(base.inputs, late, n_steps), speed, part.blowouts,
                  _held(scenario, whole))


def _recording(scenario: Scenario) -> Recording:
    """The recording, from the scenario's own folder or the shipped ones."""
    try:
        return read_recording(scenario.beside(scenario.spec.recording, "recordings"))
    except InputError as error:
        if error.file:
            raise
        raise scenario.places["recording"].error(error.problem, error.expected) from None


def _check_span(scenario: Scenario, log: Recording) -> None:
    """Refuse a scenario that begins after its log, or ends before it."""
    spec = scenario.spec
    for key, time_s, outside in (("start_s", spec.start_s, spec.start_s >= log.end_s),
                                 ("end_s", spec.end_s, spec.end_s <= log.start_s)):
        if outside:
            place = scenario.places.get(key, scenario.places["recording"])
            raise place.error(f"{time_s:g} s is outside {log.name}",
                              f"an instant of it, {log.start_s:g} s to {log.end_s:g} s")


def _on_steps(values: Floats, late: int, n_steps: int) -> Floats:
    """Values that begin ``late`` steps after the scenario, their ends held."""
    padding = ((late, max(n_steps - late - len(values), 0)), *((0, 0),) * (values.ndim - 1))
    return np.pad(values, padding, "edge")[:n_steps]


def _held(scenario: Scenario, log: Recording) -> tuple[str, ...]:
    """Notes on commands that hold before and after the log."""
    spec, notes = scenario.spec, []
    if log.start_s - spec.start_s > _TOLD_S:
        notes.append(f"the log begins at {log.start_s:g} s; its first commands are held from"
                     f" {spec.start_s:g} s on")
    if spec.end_s - log.end_s > _TOLD_S:
        notes.append(f"the log ends at {log.end_s:g} s; its last commands are held until"
                     f" {spec.end_s:g} s")
    return tuple(notes)
