"""What the driver sets out to do: speed, hand-wheel program, throttle, brakes, blowout.

Every manoeuvre is drawn from a seed: amplitudes, speeds and instants vary a little.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from proving_ground.manoeuvres import blowouts, braking, lanes, ordinary, straight, turns, wheel
from proving_ground.task import Manoeuvre

Maker = Callable[[np.random.Generator], Manoeuvre]
MANOEUVRES: dict[str, Maker] = {maker.__name__: maker for maker in (
    ordinary.ordinary_drive,
    straight.straight, straight.coast_down, straight.coast_slow, straight.speed_step,
    straight.late_release, straight.coast_then_brake, straight.roll_out, straight.dab_and_roll,
    straight.dragging_brake, straight.roll_and_dabs, lanes.lane_change,
    lanes.double_lane_change, lanes.hard_double, lanes.swerve_and_return, lanes.hard_swerve,
    lanes.sine_dwell, lanes.slalom, lanes.hard_slalom, lanes.slow_drift, turns.ramp_hold,
    turns.hard_ramp, turns.slow_ramp, turns.hard_slow_ramp, turns.j_turn, turns.there_and_back,
    turns.hard_there_and_back, turns.tightening_turn, turns.hard_tightening,
    turns.lift_in_turn, turns.fishhook, turns.hard_fishhook, turns.s_bend, turns.hard_s_bend,
    wheel.sine_sweep, wheel.random_steer, wheel.weave, wheel.growing_triangles,
    wheel.stairs_steer, wheel.pulse_steer, wheel.small_pulses, braking.braking_trailer,
    braking.braking_all, braking.braking_steps, braking.braking_ramp, braking.braking_pulses,
    braking.braking_release, braking.braking_swap, braking.braking_growing,
    braking.braking_taper, braking.braking_added, blowouts.blowout, blowouts.blowout_free,
    blowouts.blowout_brake, blowouts.blowout_hold, blowouts.blowout_coast,
    blowouts.blowout_slow_hands, blowouts.blowout_dab, blowouts.blowout_pull_over,
    blowouts.blowout_quick_hands)}
_WITH_BLOWOUT = {maker.__name__: maker for maker in (
    blowouts.blowout, blowouts.blowout_free, blowouts.blowout_brake, blowouts.blowout_hold,
    blowouts.blowout_coast, blowouts.blowout_slow_hands, blowouts.blowout_dab,
    blowouts.blowout_pull_over, blowouts.blowout_quick_hands)}


def make(kind: str, seed: int, tires: tuple[str, ...] = ("steer_left",)) -> Manoeuvre:
    """A manoeuvre of a kind, its details drawn from a seed."""
    rng = np.random.default_rng([seed, 37])
    if kind in _WITH_BLOWOUT:
        return _WITH_BLOWOUT[kind](rng, tires)
    return MANOEUVRES[kind](rng)
