"""The compiled loop for eight trucks abreast: `loop.run_loop` for each of them, one step for all.

The driver, the conditions and the bursts of each truck are worked one after the other by the code
that works those of a single one; what they take is small beside the step.

References: none, this is bookkeeping.
Known limits: of runs begun late, all eight begin at one step.
Validated with: test/simulation/test_abreast.py.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics.choose import any_of
from truck_blowout_sim.physics.jit import core
from truck_blowout_sim.physics.layout import GLOBAL_S, N_INPUTS
from truck_blowout_sim.physics.observe import observe
from truck_blowout_sim.physics.octet import EIGHT
from truck_blowout_sim.physics.octet_arrays import bare, octets
from truck_blowout_sim.physics.step import step
from truck_blowout_sim.simulation.ending import GOING, ended
from truck_blowout_sim.simulation.equilibrium import settle
from truck_blowout_sim.simulation.loop import act

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Flags = NDArray[np.bool_]
N_STEPS, N_BLOWS, N_WATCH, N_SPEEDS, N_PILOT, N_PATH = range(6)  # columns of ``counts``


@core
def settle_abreast(x: Floats, p: Floats, topo: Integers, inputs: Floats, dt: float, n_steps: int,
                   held: Floats, work: Floats) -> None:
    """`equilibrium.settle` of eight trucks; every array but ``topo`` is [..., 8]."""
    settle(octets(x), octets(p), topo, octets(inputs), dt, n_steps, octets(held), octets(work))


@core
def run_abreast(x: Floats, p: Floats, topo: Integers, held: Floats, dt: float, every: int,
                begun: int, origin_s: Floats, rolls: Floats, work: Floats, seen: Floats,
                codes: Floats, ends: Floats, counts: Integers, inputs: Floats,
                blow_steps: Integers, blow_slots: Integers, blow_watch: Integers,
                blow_delays: Integers, watch: Floats, speed: Floats, mass_kg: Floats,
                pilot: Floats, path: Floats, out: Floats) -> None:
    """Run eight trucks to their ends, from the step ``begun`` on.

    Args:
        x, p, topo, work: states, parameters, topology, scratch; [..., 8].
        held: [5, 8] inputs of a step; ``seen`` [n_outputs, 8] outputs at an instant.
        origin_s, codes: [1, 8] times at step 0; how each stands (`ending.ended`).
        rolls: [n_units, 8], of `ending.rolled_over_rad`.
        ends: [n_state, 8] states at the end of each.
        counts: [8, 6] how much of the following belongs to each truck; 0 steps: there is none.
        inputs, blow_steps, ..., path: [8, ...] of each truck, as of `loop.run_loop`.
        out: [8, n_rows, n_outputs] rows.
    """
    xs, ps, ws = octets(x), octets(p), octets(work)
    us, limits, sights, found = octets(held), octets(rolls), octets(seen), octets(codes)
    starts, last = octets(origin_s), counts[:, N_STEPS].max()
    x, p, counts, inputs, watch = bare(x), bare(p), bare(counts), bare(inputs), bare(watch)
    blow_steps, blow_slots = bare(blow_steps), bare(blow_slots)
    blow_watch, blow_delays = bare(blow_watch), bare(blow_delays)
    speed, pilot, path = bare(speed), bare(pilot), bare(path)
    going = counts[:, N_STEPS] > 0
    left = going.sum()
    for k in range(begun, last + 1):
        found[0] = ended(xs, limits)
        if any_of(found[0] != GOING):
            for lane in range(EIGHT):
                left -= _leave(going, x, ends, lane, codes[0, lane] != GOING)
        xs[GLOBAL_S.time_s] = starts[0] + k * dt
        if k % every == 0 and left > 0:
            observe(xs, ps, topo, ws, sights)
            _note(going, seen, out, k // every)
        for lane in range(EIGHT):
            left -= _leave(going, x, ends, lane, k == counts[lane, N_STEPS])
            if going[lane] and _something_due(k, counts[lane], blow_steps[lane]):
                n = counts[lane]
                blows = n[N_BLOWS]
                act(x[:, lane], p[:, lane], inputs[lane, :n[N_STEPS]], k, dt,
                    blow_steps[lane, :blows], blow_slots[lane, :blows], blow_watch[lane, :blows],
                    blow_delays[lane, :blows], watch[lane, :n[N_WATCH]],
                    speed[lane, :n[N_SPEEDS]], mass_kg[lane], pilot[lane, :n[N_PILOT]],
                    path[lane, :n[N_PATH]])
            if going[lane]:
                for i in range(N_INPUTS):
                    held[i, lane] = inputs[lane, k, i]
        if left == 0:
            break
        step(xs, ps, topo, us, dt, ws)


@core
def _something_due(k: int, counts: Integers, blow_steps: Integers) -> bool:
    """Whether `act` has anything to do for a truck at step ``k``: most have nothing at most."""
    if counts[N_WATCH] + counts[N_SPEEDS] + counts[N_PILOT] > 0:
        return True
    due = False
    for b in range(counts[N_BLOWS]):
        due = due or blow_steps[b] == k
    return due


@core
def _note(going: Flags, seen: Floats, out: Floats, row: int) -> None:
    """Keep the outputs of the trucks that go."""
    for lane in range(EIGHT):
        if going[lane]:
            for i in range(seen.shape[0]):
                out[lane, row, i] = seen[i, lane]


@core
def _leave(going: Flags, x: Floats, ends: Floats, lane: int, over: bool) -> int:
    """Keep the state of a truck whose run is over; it goes on unheeded. The number that leave."""
    if not (going[lane] and over):
        return 0
    going[lane] = False
    for i in range(x.shape[0]):
        ends[i, lane] = x[i, lane]
    return 1
