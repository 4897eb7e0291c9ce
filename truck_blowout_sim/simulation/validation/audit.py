"""Energy audit of a whole run: does every step's change of energy equal the work done in it?"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics.energy import energy_j
from truck_blowout_sim.physics.jit import core
from truck_blowout_sim.physics.layout import GLOBAL_S, N_WORK, TIRE_S
from truck_blowout_sim.physics.powers import N_POWERS, POWER, powers_w
from truck_blowout_sim.physics.step import step
from truck_blowout_sim.simulation.drive import Drive, execute
from truck_blowout_sim.simulation.equilibrium import initial_vector
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]


@dataclass(frozen=True)
class Audit:
    """Energy balance of a run.

    Attributes:
        start_j: kinetic and potential energy at the start, heights counted from the road.
        work_j: work of each element over the run, positive into the truck, by name.
        open_j: [n_steps] energy that no element accounts for, up to each step.
    """

    start_j: float
    work_j: dict[str, float]
    open_j: Floats

    @property
    def closure(self) -> float:
        """Largest open energy at any time against the energy at the start."""
        return float(np.abs(self.open_j).max() / self.start_j)


def audit(packed: Packed, drive: Drive) -> Audit:
    """Run a drive, the closed-loop driver's inputs replayed, and balance every step."""
    inputs = execute(packed, drive).inputs
    topo, params = packed.topology, packed.params.copy()
    x = initial_vector(packed, drive.initial, drive.step_s)
    slots = packed.tire_states(TIRE_S.blown_time_s)[drive.blown]
    work, open_j = np.zeros(N_POWERS), np.zeros(len(inputs))
    start = _balance(x, params, topo, inputs, drive.step_s, drive.initial.time_s,
                     drive.blow_steps, slots, np.zeros(N_WORK), work, open_j)
    return Audit(start, {name: float(work[k]) for k, name in enumerate(POWER._fields)}, open_j)


@core
def _balance(x: Floats, p: Floats, topo: Integers, inputs: Floats, dt: float, origin_s: float,
             blow_steps: Integers, blow_slots: Integers, scratch: Floats, work: Floats,
             open_j: Floats) -> float:
    """Step through a run; fills the work of each element and the open energy, returns the start."""
    before, middle, powers = np.empty_like(x), np.empty_like(x), np.empty(work.size)
    start = energy_j(x, p, topo, scratch)
    for k in range(inputs.shape[0]):
        x[GLOBAL_S.time_s] = origin_s + k * dt
        for b in range(blow_steps.size):
            if blow_steps[b] == k and x[blow_slots[b]] == np.inf:
                x[blow_slots[b]] = x[GLOBAL_S.time_s]
        before[:] = x
        step(x, p, topo, inputs[k], dt, scratch)
        powers_w(before, x, p, topo, dt, scratch, middle, powers)
        total = 0.0
        for j in range(work.size):
            work[j] += dt * powers[j]
            total += work[j]
        open_j[k] = energy_j(x, p, topo, scratch) - start - total
    return start
