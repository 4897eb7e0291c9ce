"""Which rows of a run can tell of a hypothesis, beside what is named already.

Three times something else may look like it. What a lost tire does differs among good models: it
tells of nothing at its own axle, of no moment or drag without a name on its unit and, where a law
of lost tires is named, of no force from outside.
A load that moves pushes its unit back by a course that nobody knows; what the fitted course leaves
rings for a swing. Up to 0.6 of the peak, forms of tires of equal slope and peak differ in slip by
the square of how much of the peak they use, but beyond, each bends in its own way
(`effects/roll_steer.py`): a wind that chooses its instants there explains what the form lacks.

References: Pacejka 2012, ch. 3 (brush) and 4 (Magic Formula); Dugoff et al. 1970.
Known limits: grip that is used is that of the first unit, by its yaw rate and speed.
Validated with: test/diagnosis/test_telling.py.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.case.runs import Run
from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.case.trust import asked_for_mps2, comparable_rows, grip_mps2
from truck_blowout_sim.diagnosis.effects.base import axles_at
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis

Floats = NDArray[np.float64]
_FORMS_AGREE = 0.6  # of the peak, as above


def tells_of(study: Study, run: Run, h: Hypothesis) -> Floats:
    """[rows] 1 where a run can tell of the hypothesis, else 0.

    Not from where only training lost a tire of the axle at which it acts, unless it is about the
    lost tire.
    """
    if h.effect.timed or h.effect.applies == "blowout" or not _at_lost_tire(study, run, h):
        return np.ones(run.measured.size)
    return comparable_rows(study, run)


def while_loads_rest(study: Study, run: Run, named: Sequence[Hypothesis]) -> Floats:
    """[rows] 0 while a load that is named moves in the run, and for a swing afterwards, else 1."""
    rest = np.ones(run.middles_s.size)
    for one in named:
        if one.effect.pushes_back and run.recording.name in one.times:
            start, end = one.times[run.recording.name]
            over = end + study.settings.swing_s
            rest[(run.edges_s[1:] > start) & (run.edges_s[:-1] < over)] = 0.0
    return np.repeat(rest, len(run.channels))


def hides_forces(h: Hypothesis) -> bool:
    """Whether a named cause has times that tell of no force from outside."""
    return h.effect.cuts_grip or h.effect.applies == "blowout"


def tells_of_forces(study: Study, run: Run, named: Sequence[Hypothesis]) -> Floats:
    """[rows] 1 where a run tells of forces from outside: of a wind, a slope, a load that moves.

    Not beside a named loss of grip while the tires slide, nor beside a named law of lost tires once
    one is lost.

    Args:
        named: what is in force, with the instants that the run has.
    """
    tells, ends = np.ones(run.middles_s.size), run.edges_s[1:]
    for h in named:
        if h.effect.applies == "blowout":
            tells[ends > run.lost_s] = 0.0
        if h.effect.cuts_grip and (not h.effect.timed or run.recording.name in h.times):
            since = h.times[run.recording.name][0] if h.effect.timed else -np.inf
            left = h.effect.amount.report(h.amount) * grip_mps2(study.packed)
            tells[(ends > since) & (asked_for_mps2(study, run) > _FORMS_AGREE * left)] = 0.0
    return np.repeat(tells, len(run.channels))


def _at_lost_tire(study: Study, run: Run, h: Hypothesis) -> bool:
    """Whether the hypothesis acts at an axle, or a hub of it, that loses a tire in the run.

    A moment or drag without a name acts at every axle of its unit: a flat tire turns the unit, and
    drags, as the body rolls onto it.
    """
    vehicle, place = study.packed.vehicle, h.place
    own = axles_at(vehicle, place) if place.axle else () if h.effect.listed else tuple(
        name for name, axle in vehicle.spec.axles.items() if axle.unit == place.body)
    lost = {vehicle.axle_of_hub(vehicle.hub_of_tire(tire))
            for event in run.recording.blowouts for tire in event.tires}
    return bool(lost & set(own))
