"""A truck to hold: state, step, blow, look."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.errors import InputError, quoted
from truck_blowout_sim.physics.layout import GLOBAL_S, INPUT, N_WORK, TIRE_S
from truck_blowout_sim.physics.observe import observe, output_names
from truck_blowout_sim.physics.step import advance
from truck_blowout_sim.simulation.ending import Ending, ending_of, rolled_over_rad
from truck_blowout_sim.simulation.equilibrium import InitialState, initial_vector
from truck_blowout_sim.simulation.inputs import Inputs, opening
from truck_blowout_sim.simulation.limits import check_inputs, check_steps, checked_start
from truck_blowout_sim.simulation.rates import check_delays, check_step
from truck_blowout_sim.vehicle.given import AnyVehicle, packed_of

Floats = NDArray[np.float64]


class Truck:
    """One truck in time.

    Args:
        vehicle: a vehicle, a vehicle already packed into parameters, a path, or the name of a
            shipped one.
        step_s: fixed step [s].
        initial: where and how fast it starts; settled there before time begins.

    Raises:
        InputError: a step that is none or too long, or too short for the delay of the brakes; a
            start that no truck makes.
    """

    def __init__(self, vehicle: AnyVehicle, *, step_s: float = 0.001,
                 initial: InitialState | None = None) -> None:
        check_step(step_s)
        self.packed = packed_of(vehicle)
        check_delays(self.packed, step_s)
        self.vehicle = self.packed.vehicle
        self.step_s = step_s
        self.initial = checked_start(initial or InitialState(), self.packed)
        self.output_names = output_names(self.vehicle.units, self.vehicle.hubs, self.vehicle.tires)
        self._params = self.packed.params
        self._topology = self.packed.topology
        self._blown_at = self.packed.tire_states(TIRE_S.blown_time_s)
        self._work = np.zeros(N_WORK)
        self._inputs = np.array(self.initial.inputs, dtype=np.float64)
        self._out = np.zeros(len(self.output_names))
        self._start = initial_vector(self.packed, self.initial, step_s)
        self.state = self._start.copy()
        self._steps = 0
        self._rolls = rolled_over_rad(self.packed)

    @property
    def time_s(self) -> float:
        """Simulation time [s]."""
        return self.initial.time_s + self._steps * self.step_s

    @property
    def finite(self) -> bool:
        """False once the core met a non-finite acceleration."""
        return bool(self.state[GLOBAL_S.nonfinite] == 0.0)

    @property
    def ending(self) -> Ending | None:
        """Why the truck cannot go on: rolled over, out of the model's range; None while it can."""
        return ending_of(self.state, self.packed, self._rolls, self.time_s, self.initial.time_s)

    def advance(self, inputs: Inputs, n_steps: int = 1) -> None:
        """Advance ``n_steps`` steps with ``inputs`` held.

        Raises:
            InputError: inputs that are none, or steps back in time.
        """
        check_steps(n_steps)
        check_inputs(inputs)
        self._inputs[:] = inputs
        self._inputs[INPUT.throttle] = opening(inputs.throttle)
        # the counter rules time, so that it never drifts from the step grid
        self.state[GLOBAL_S.time_s] = self.time_s
        advance(self.state, self._params, self._topology, self._inputs, self.step_s, n_steps,
                self._work)
        self._steps += n_steps

    def blow(self, tire: str) -> bool:
        """Burst a tire now. Returns False if it was blown already."""
        slot = self._blown_slot(tire)
        if self.state[slot] <= self.time_s:
            return False
        self.state[slot] = self.time_s
        return True

    @property
    def blown(self) -> tuple[str, ...]:
        """Names of the tires blown so far."""
        return tuple(t for t in self.vehicle.tires
                     if self.state[self._blown_slot(t)] <= self.time_s)

    def reset(self) -> None:
        """Back to the initial state and time; every tire whole again."""
        self.state[:] = self._start
        self._steps = 0

    def output_vector(self) -> Floats:
        """All outputs now, in the order of ``output_names``; a copy."""
        observe(self.state, self._params, self._topology, self._work, self._out)
        return self._out.copy()

    def outputs(self) -> dict[str, float]:
        """All outputs now by name; SI units as in the names, pressures gauge."""
        return dict(zip(self.output_names, self.output_vector().tolist(), strict=True))

    def _blown_slot(self, tire: str) -> int:
        """State position of the instant at which a tire burst."""
        if tire not in self.vehicle.tires:
            raise InputError(f"unknown tire {quoted(tire)}", file=self.vehicle.name,
                             expected="one of " + ", ".join(self.vehicle.tires))
        return int(self._blown_at[self.vehicle.tires.index(tire)])
