"""The compiled loop: many steps, driver, blowouts at steps or on conditions, outputs.

References: none, this is bookkeeping.
Known limits: an imposed speed moves the truck by a force at its center of gravity.
Validated with: test/simulation/test_driver.py, test/simulation/test_reaction.py,
test/simulation/test_ending.py.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics.jit import core
from truck_blowout_sim.physics.layout import GLOBAL_S, STATE_UNIT_AT, UNIT_S
from truck_blowout_sim.physics.observe import observe
from truck_blowout_sim.physics.scalar import EDGE_S
from truck_blowout_sim.physics.step import step
from truck_blowout_sim.simulation.ending import GOING, ended
from truck_blowout_sim.simulation.pilot import PILOT, drive_inputs, forward_speed, notice

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]


class WatchParams(NamedTuple):
    """Positions in one row of the conditions; what is NaN is not asked."""

    after_s: int = 0  # not before this time
    speed_below_mps: int = 1
    speed_above_mps: int = 2
    x_past_m: int = 3
    distance_m: int = 4  # driven since the start
    yaw_rate_above_radps: int = 5  # of the tractor, to either side
    met_s: int = 6  # memory: instant at which all were met; inf: not yet


WATCH = WatchParams()


@core
def run_loop(x: Floats, p: Floats, topo: Integers, inputs: Floats, dt: float, every: int,
             first: int, last: int, origin_s: float, blow_steps: Integers, blow_slots: Integers,
             blow_watch: Integers, blow_delays: Integers, watch: Floats, speed: Floats,
             mass_kg: float, pilot: Floats, path: Floats, rolls: Floats, work: Floats,
             out: Floats) -> int:
    """Run the steps ``first`` .. ``last`` of a run; row k of ``out`` is the truck after k * every.

    A run may be cut anywhere: the parts give the same bits as the whole.

    Args:
        x, p, topo, work: state (advanced in place), parameters, topology, scratch.
        inputs: [n_steps, 5] of the whole run, held over each step; a driver writes his into it.
        origin_s: time at step 0.
        blow_steps, blow_slots: step index and state position of each blowout time. A step of -1
            waits for row ``blow_watch`` of ``watch`` and then ``blow_delays`` steps, and is set.
        watch: [n, len(WATCH)] conditions.
        speed: [n_steps] forward speed [m/s] at the tractor's base_link, imposed or held by the
            driver; NaN where neither; or empty.
        mass_kg: mass an imposed speed moves.
        pilot: a driver (``PILOT``), or empty.
        path: [n, 2] points for the driver.
        rolls: roll at which each unit counts as rolled over (`ending.rolled_over_rad`).
        out: [n_rows, n_outputs] of the whole run.

    Returns:
        0, or how the run ended (`ending.ended`); the state then is that of the end.
    """
    n, end = inputs.shape[0], GOING
    for k in range(first, last + 1):
        end = ended(x, rolls)
        if end != GOING:
            return end
        x[GLOBAL_S.time_s] = origin_s + k * dt
        # the part's last instant is the next part's first
        if k % every == 0 and (k < last or k == n):
            observe(x, p, topo, work, out[k // every])
        if k == last:
            break
        act(x, p, inputs, k, dt, blow_steps, blow_slots, blow_watch, blow_delays, watch, speed,
            mass_kg, pilot, path)
        step(x, p, topo, inputs[k], dt, work)
    return ended(x, rolls)


@core
def act(x: Floats, p: Floats, inputs: Floats, k: int, dt: float, blow_steps: Integers,
        blow_slots: Integers, blow_watch: Integers, blow_delays: Integers, watch: Floats,
        speed: Floats, mass_kg: float, pilot: Floats, path: Floats) -> None:
    """What happens before step ``k``: conditions are met, tires burst, the driver acts."""
    for w in range(watch.shape[0]):
        _look(x, p, watch, w, dt)
    for b in range(blow_steps.size):
        _blow(x, k, b, blow_steps, blow_slots, blow_watch, blow_delays, watch)
    if pilot.size > 0 and _calls(x, pilot, blow_slots, watch):
        notice(x, p, inputs, k, pilot)
    drive_inputs(x, p, inputs, k, dt, speed, mass_kg, pilot, path)


@core
def _look(x: Floats, p: Floats, watch: Floats, w: int, dt: float) -> None:
    """Note the instant at which everything a condition asks for is met; count distance down."""
    if watch[w, WATCH.met_s] < np.inf:
        return
    speed = forward_speed(x, p)
    if not np.isnan(watch[w, WATCH.distance_m]):
        watch[w, WATCH.distance_m] -= dt * abs(speed)
    # a comparison with NaN is false: what is not asked does not stand in the way
    if (x[GLOBAL_S.time_s] < watch[w, WATCH.after_s] - EDGE_S
            or speed >= watch[w, WATCH.speed_below_mps]
            or speed <= watch[w, WATCH.speed_above_mps]
            or x[STATE_UNIT_AT + UNIT_S.x_m] < watch[w, WATCH.x_past_m]
            or watch[w, WATCH.distance_m] > 0.0
            or abs(x[STATE_UNIT_AT + UNIT_S.r_radps]) <= watch[w, WATCH.yaw_rate_above_radps]):
        return
    watch[w, WATCH.met_s] = x[GLOBAL_S.time_s]


@core
def _blow(x: Floats, k: int, b: int, blow_steps: Integers, blow_slots: Integers,
          blow_watch: Integers, blow_delays: Integers, watch: Floats) -> None:
    """Burst what is due; set the step of what its condition now calls for."""
    if blow_steps[b] < 0 and watch[blow_watch[b], WATCH.met_s] < np.inf:
        blow_steps[b] = k + blow_delays[b]
    if blow_steps[b] == k and x[blow_slots[b]] == np.inf:
        x[blow_slots[b]] = x[GLOBAL_S.time_s]


@core
def _calls(x: Floats, pilot: Floats, blow_slots: Integers, watch: Floats) -> bool:
    """Whether what the driver reacts to happens now."""
    if pilot[PILOT.react] == 0.0 or pilot[PILOT.noticed_s] < np.inf:
        return False
    w = int(pilot[PILOT.react_watch])
    if w >= 0:
        return watch[w, WATCH.met_s] < np.inf
    burst = False
    for b in range(blow_slots.size):
        burst = burst or x[blow_slots[b]] <= x[GLOBAL_S.time_s]
    return burst
