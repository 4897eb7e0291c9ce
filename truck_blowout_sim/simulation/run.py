"""Run a scenario: from words to a recording."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from os import PathLike

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import Blowout, Recording
from truck_blowout_sim.recordings.stray_time import LONGEST_S
from truck_blowout_sim.simulation.drive import Drive, Progress, Ran, execute
from truck_blowout_sim.simulation.driver import input_table, pilot_of, speed_to_hold
from truck_blowout_sim.simulation.equilibrium import InitialState
from truck_blowout_sim.simulation.events import events_of
from truck_blowout_sim.simulation.flat import flat_at, split_at
from truck_blowout_sim.simulation.inputs import Inputs
from truck_blowout_sim.simulation.logged import Logged, logged
from truck_blowout_sim.simulation.rates import check_delays, check_rates
from truck_blowout_sim.simulation.replay import STATED_SPEED_WORDS, as_recording
from truck_blowout_sim.simulation.scenario import Scenario, load_scenario
from truck_blowout_sim.vehicle import Packed, load_road, road_values
from truck_blowout_sim.vehicle.given import AnyVehicle, packed_of

_MOST_STEPS = round(LONGEST_S / 0.001)  # a day at the usual step


def simulate(vehicle: AnyVehicle, scenario: Scenario | str | PathLike[str], *,
             step_s: float = 0.001, rate_hz: float = 100.0, progress: Progress | None = None
             ) -> Recording:
    """Run a scenario.

    Args:
        vehicle: a vehicle, one packed with parameters of its own, a path, or a shipped name.
        scenario: a loaded scenario, the name of a shipped one, or a path.
        step_s: fixed step [s].
        rate_hz: rate of the recording.
        progress: called now and then with the share that is done.

    Returns:
        Inputs as driven, outputs and blowouts; up to the instant at which a unit rolled over, which
        then stands in metadata and notes. The same arguments give the same bits.

    Raises:
        InputError: the scenario cannot be used, or not with this vehicle.
        DivergedError: the run left the range of the model.
    """
    loaded = scenario if isinstance(scenario, Scenario) else load_scenario(scenario)
    packed, drive, blowouts = prepare(vehicle, loaded, step_s=step_s, rate_hz=rate_hz)
    return recorded(packed, drive, execute(packed, drive, progress), blowouts, loaded)


def recorded(packed: Packed, drive: Drive, ran: Ran, blowouts: tuple[Blowout, ...],
             scenario: Scenario) -> Recording:
    """The recording of what `prepare` gave for a scenario and `execute` ran; see `simulate`."""
    metadata = {"scenario": scenario.name, "title": scenario.title}
    made = as_recording(scenario.name, packed, drive, ran, burst(packed, drive, ran, blowouts),
                        metadata, why_imposed=STATED_SPEED_WORDS)
    absent = tuple(f"blowout {name} did not occur: its condition was not met in time"
                   for name in _never_met(packed, drive, ran, scenario))
    return replace(made, notes=made.notes + drive.notes + absent)


def burst(packed: Packed, drive: Drive, ran: Ran, timed: tuple[Blowout, ...]
          ) -> tuple[Blowout, ...]:
    """What really burst: at its time, or when its condition was met, before the run ended.

    A tire bursts once; what a later event adds are its other tires.
    """
    waited: dict[int, list[str]] = {}
    for b in _met(drive, ran):
        tire = packed.names.tires[drive.blown[b]]
        waited.setdefault(int(ran.blow_steps[b]), []).append(tire)
    met = [Blowout(drive.initial.time_s + step * drive.step_s, tuple(tires))
           for step, tires in waited.items()]
    on_time = [e for e in timed if e.time_s <= _last_s(ran)]
    return _first_bursts(sorted((*on_time, *met), key=lambda e: e.time_s))


def _first_bursts(events: Sequence[Blowout]) -> tuple[Blowout, ...]:
    """Events in order of time without tires that have burst before; an empty one is left out."""
    blown: set[str] = set()
    first = []
    for event in events:
        tires = tuple(tire for tire in event.tires if tire not in blown)
        blown.update(tires)
        if tires:
            first.append(Blowout(event.time_s, tires))
    return tuple(first)


def _never_met(packed: Packed, drive: Drive, ran: Ran, scenario: Scenario) -> list[str]:
    """Blowouts that waited for a condition until the run was over."""
    waiting = [name for name, event in scenario.spec.blowouts.items() if event.when is not None]
    if not waiting or drive.blow_watch is None:
        return []
    came = set(drive.blow_watch[_met(drive, ran)].tolist())
    return [name for number, name in enumerate(waiting)
            if number not in came and scenario.tires_of(name, packed.vehicle)]


def _met(drive: Drive, ran: Ran) -> NDArray[np.int64]:
    """Numbers of the blowouts whose condition was met before the run ended."""
    step = ran.blow_steps
    in_time = (step < len(drive.inputs)) & (
        drive.initial.time_s + step * drive.step_s <= _last_s(ran))
    return np.flatnonzero((drive.blow_steps < 0) & (step >= 0) & in_time)


def _last_s(ran: Ran) -> float:
    """When a run ended early; never, if it did not."""
    return ran.ending.time_s if ran.ending else math.inf


def prepare(vehicle: AnyVehicle, scenario: Scenario, *, step_s: float = 0.001,
            rate_hz: float = 100.0) -> tuple[Packed, Drive, tuple[Blowout, ...]]:
    """The truck on the scenario's road, what drives it, and what bursts at which instant.

    Blowouts that wait for a condition are in the drive alone.

    Raises:
        InputError: see :func:`simulate`.
    """
    check_rates(step_s, rate_hz)
    packed = _on_the_road(packed_of(vehicle), scenario)
    check_delays(packed, step_s)
    spec = scenario.spec
    n_steps = _count_steps(scenario, step_s)
    times = spec.start_s + step_s * np.arange(n_steps, dtype=np.float64)
    every = _steps_a_row(step_s, rate_hz)
    blowouts = scenario.blowouts_of(packed.vehicle)
    base = None
    if spec.recording:
        base = logged(scenario, packed.vehicle, n_steps, step_s=step_s, rate_hz=rate_hz)
        blowouts = blowouts if spec.blowouts else base.blowouts
    inputs = input_table(spec, times, base.inputs if base else None)
    before, timed = split_at(blowouts, spec.start_s, step_s)
    initial = replace(_initial(scenario, base, inputs), flat=flat_at(before, spec.start_s))
    speed = speed_to_hold(spec, times)
    if base and base.speed.size and spec.hold is None:
        speed = base.speed
    events = events_of(scenario, packed.vehicle, timed, step_s)
    pilot, path = pilot_of(spec, packed, inputs[0], events.reaction)
    drive = Drive(initial, step_s, every, inputs, speed, events.steps, events.tires, pilot, path,
                  watch=events.watch, blow_watch=events.conditions, blow_delays=events.delays,
                  notes=base.notes if base else ())
    return packed, drive, blowouts


def row_times(scenario: Scenario, step_s: float, rate_hz: float) -> NDArray[np.float64]:
    """Times of the rows that a run of a scenario has, as far as it comes.

    Raises:
        InputError: an impossible step or rate.
    """
    check_rates(step_s, rate_hz)
    every = _steps_a_row(step_s, rate_hz)
    rows = _count_steps(scenario, step_s) // every + 1
    return scenario.spec.start_s + every * step_s * np.arange(rows, dtype=np.float64)


def _count_steps(scenario: Scenario, step_s: float) -> int:
    """Steps from its start to its end; at least one, and no more than fit into memory.

    Raises:
        InputError: what it lasts, and what is possible.
    """
    spec = scenario.spec
    if not spec.end_s - spec.start_s <= _MOST_STEPS * step_s:
        raise InputError(f"end_s: lasts {spec.end_s - spec.start_s:g} s", file=scenario.path,
                         expected=f"{_MOST_STEPS * step_s:g} s at most with steps of {step_s:g} s")
    n_steps = round((spec.end_s - spec.start_s) / step_s)
    if n_steps < 1:
        raise InputError(f"end_s: lasts {spec.end_s - spec.start_s:g} s", file=scenario.path,
                         expected=f"{step_s:g} s or more, one step of the simulation")
    return n_steps


def _steps_a_row(step_s: float, rate_hz: float) -> int:
    return max(round(1.0 / rate_hz / step_s), 1)


def _on_the_road(packed: Packed, scenario: Scenario) -> Packed:
    """The truck with the scenario's road and parameters."""
    if scenario.spec.road:
        place = scenario.places.get("road")
        try:
            road = load_road(scenario.beside(scenario.spec.road, "roads"))
        except InputError as error:
            if place is None or error.file:
                raise
            raise place.error(error.problem, error.expected) from None
        packed = packed.with_values(road_values(road))
    try:
        return packed.with_values(scenario.values)
    except InputError as error:
        raise InputError(error.problem, file=scenario.path, where=f"values {error.where}".strip(),
                         expected=error.expected) from None


def _initial(scenario: Scenario, base: Logged | None, inputs: NDArray[np.float64]) -> InitialState:
    """How the run begins: the start section, else what the recording shows."""
    spec = scenario.spec
    first = Inputs(*inputs[0].tolist())
    if spec.start is None:
        assert base is not None  # the check of the scenario has seen to it
        return replace(base.initial, inputs=first, time_s=spec.start_s)
    start = spec.start
    return InitialState(speed_mps=start.speed_mps, x_m=start.x_m, y_m=start.y_m,
                        yaw_rad=start.yaw_rad, time_s=spec.start_s, inputs=first)
