"""A prepared run: everything that drives a truck, on the step grid; made once, run many times."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics.layout import AXLE, GLOBAL_S, N_WORK, TIRE_S, TOPOLOGY, UNIT
from truck_blowout_sim.physics.observe import output_names
from truck_blowout_sim.physics.places import axle_params, unit_params
from truck_blowout_sim.simulation.ending import Ending, ending_of, rolled_over_rad
from truck_blowout_sim.simulation.equilibrium import InitialState, initial_vector
from truck_blowout_sim.simulation.loop import WATCH, run_loop
from truck_blowout_sim.vehicle import Packed, Vehicle

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Progress = Callable[[float], None]
_PART_S = 1.0  # simulated time between two reports of progress


@dataclass(frozen=True)
class Drive:
    """Everything that drives a run, on the step grid.

    Attributes:
        initial: how the run begins.
        step_s: step [s].
        every: steps between output rows.
        inputs: [n_steps, 5]; columns a driver works are his.
        speed: [n_steps] speed [m/s] imposed, or held by the driver; NaN: neither; or empty.
        blow_steps: step of each blowout; ``blown``: the tires' numbers.
        pilot: the driver's parameters (`loop.PILOT`), or empty.
        path: [n, 2] points the driver follows, in map.
        warm: equilibrium of a similar truck at the same start, to settle from; or None.
        watch: [n, len(WATCH)] conditions that events wait for.
        blow_watch: condition of each blowout whose step is -1; ``blow_delays``: steps after it.
        notes: what had to be assumed.
    """

    initial: InitialState
    step_s: float
    every: int
    inputs: Floats
    speed: Floats
    blow_steps: Integers
    blown: Integers
    pilot: Floats = field(default_factory=lambda: np.zeros(0))
    path: Floats = field(default_factory=lambda: np.zeros((0, 2)))
    warm: Floats | None = None
    watch: Floats = field(default_factory=lambda: np.zeros((0, len(WATCH))))
    blow_watch: Integers | None = None
    blow_delays: Integers | None = None
    notes: tuple[str, ...] = ()

    @property
    def n_rows(self) -> int:
        """Output rows, the first at the start."""
        return self.inputs.shape[0] // self.every + 1

    @property
    def times_s(self) -> Floats:
        """Times of the output rows."""
        rows = np.arange(self.n_rows, dtype=np.float64)
        return self.initial.time_s + self.every * self.step_s * rows

    @property
    def speed_imposed(self) -> bool:
        """Whether an outer force moves the truck along a recorded speed."""
        return self.speed.size > 0 and self.pilot.size == 0


@dataclass(frozen=True, eq=False)
class Ran:
    """What came out of a run.

    Attributes:
        out: [n_rows, n_outputs]; NaN after the run ended before its time.
        inputs: [n_steps, 5] as driven.
        blow_steps: step of each blowout, -1 of one that never came.
        ending: how the run ended before its time, or None.
    """

    out: Floats
    inputs: Floats
    blow_steps: Integers
    ending: Ending | None


def run_drive(packed: Packed, drive: Drive) -> Floats:
    """Run a prepared drive: [n_rows, n_outputs]; rows after its end before time are NaN."""
    return execute(packed, drive).out


def execute(packed: Packed, drive: Drive, progress: Progress | None = None, *,
            start: Floats | None = None) -> Ran:
    """Run a prepared drive.

    Args:
        progress: called now and then with the share that is done.
        start: the settled truck, where it is known already.
    """
    n, driven = drive.inputs.shape[0], Driven(packed, drive)
    x = (initial_vector(packed, drive.initial, drive.step_s, drive.warm) if start is None
         else start.copy())
    out = np.full((drive.n_rows, len(names_of(packed.vehicle))), np.nan)
    part = max(round(_PART_S / drive.step_s), 1) if progress else max(n, 1)
    for first in range(0, max(n, 1), part):
        last = min(first + part, n)
        if not driven.steps(x, first, last, out):
            break
        if progress:
            progress(last / max(n, 1))
    return driven.ran(x, out)


class Driven:
    """A truck and its drive, ready for the loop; what a run changes of them is its own copy."""

    def __init__(self, packed: Packed, drive: Drive) -> None:
        nothing = np.zeros_like(drive.blow_steps)
        self.drive, self.packed = drive, packed
        self.params, self.pilot = packed.params.copy(), drive.pilot.copy()
        self.inputs, self.blow_steps = drive.inputs.copy(), drive.blow_steps.copy()
        self.watch, self.rolls = drive.watch.copy(), rolled_over_rad(packed)
        self.blow_slots = packed.tire_states(TIRE_S.blown_time_s)[drive.blown]
        self.blow_watch = nothing if drive.blow_watch is None else drive.blow_watch
        self.blow_delays = nothing if drive.blow_delays is None else drive.blow_delays
        self.mass_kg = total_mass_kg(packed)

    def steps(self, x: Floats, first: int, last: int, out: Floats) -> bool:
        """Drive on from step ``first`` to ``last``, state ``x`` and rows ``out`` in place.

        Returns:
            False once the run ended before its time.
        """
        drive = self.drive
        return not run_loop(
            x, self.params, self.packed.topology, self.inputs, drive.step_s, drive.every, first,
            last, drive.initial.time_s, self.blow_steps, self.blow_slots, self.blow_watch,
            self.blow_delays, self.watch, drive.speed, self.mass_kg, self.pilot, drive.path,
            self.rolls, np.zeros(N_WORK), out)

    def ending(self, x: Floats) -> Ending | None:
        """How the run ended before its time in state ``x``; None if it did not."""
        return ending_of(x, self.packed, self.rolls, float(x[GLOBAL_S.time_s]),
                         self.drive.initial.time_s)

    def ran(self, x: Floats, out: Floats) -> Ran:
        """What came out, once the run is over with state ``x`` and rows ``out``."""
        return Ran(out, self.inputs, self.blow_steps, self.ending(x))


def names_of(vehicle: Vehicle) -> tuple[str, ...]:
    """Names of the output columns of a vehicle."""
    return output_names(vehicle.units, vehicle.hubs, vehicle.tires)


def total_mass_kg(packed: Packed) -> float:
    """Mass of bodies and axles."""
    p, topo = packed.params, packed.topology
    units = (unit_params(u) + UNIT.mass_kg for u in range(topo[TOPOLOGY.n_units]))
    axles = (axle_params(topo, i) + AXLE.mass_kg for i in range(topo[TOPOLOGY.n_axles]))
    return math.fsum(p[at] for at in (*units, *axles))
