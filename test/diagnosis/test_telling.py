"""Which rows tell of a hypothesis: not while a load moves, not of a wind while the tires slide."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.case.trust import asked_for_mps2, grip_mps2
from truck_blowout_sim.diagnosis.effects import (
    aerodynamic_drag,
    blown_tire_drag,
    friction_change,
    payload_shift,
    road_grade,
    tire_relaxation,
    tire_saturation,
    yaw_moment,
)
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.telling import tells_of, tells_of_forces, while_loads_rest
from truck_blowout_sim.diagnosis.result.parts import Place
from truck_blowout_sim.recordings import Blowout
from truck_blowout_sim.vehicle import Packed

Studies = Callable[..., Study]
LAG = Hypothesis(tire_relaxation.EFFECT, Place(), 2.0)


def per_bin(study: Study, rows: np.ndarray) -> np.ndarray:  # type: ignore[type-arg]
    bins = rows.reshape(-1, len(study.runs[0].channels))
    assert (bins == bins[:, :1]).all()
    return bins[:, 0] > 0.0


def test_a_load_that_moves_hides_what_else_there_is_for_a_swing(study_of: Studies) -> None:
    study = study_of()
    run, swing_s = study.runs[0], study.settings.swing_s
    moved = Hypothesis(payload_shift.EFFECT, Place(body="trailer"), 0.2, {"run 1": (2.0, 2.6)})
    tells = per_bin(study, while_loads_rest(study, run, [moved]))
    hidden = (run.middles_s > 2.0) & (run.middles_s < 2.6 + swing_s)
    assert 0.0 < hidden.mean() < 1.0
    assert (tells == ~hidden).all()
    assert while_loads_rest(study, run, []).all()


@pytest.mark.parametrize("other", [
    Hypothesis(payload_shift.EFFECT, Place(body="trailer"), 0.2, {"run 2": (2.0, 2.6)}),
    Hypothesis(road_grade.EFFECT, Place(), 0.02, {"run 1": (2.0, 2.6)}),
], ids=["a load that moves in another run", "a slope, which begins slowly"])
def test_other_events_hide_nothing(study_of: Studies, other: Hypothesis) -> None:
    study = study_of()
    assert while_loads_rest(study, study.runs[0], [other]).all()


def test_tires_that_slide_tell_of_no_wind(study_of: Studies, truck: Packed) -> None:
    """From the loss of grip on, where the truck asks for more than 0.6 of what is left."""
    study = study_of()
    run, left = study.runs[0], 0.1
    icy = Hypothesis(friction_change.EFFECT, Place(), left - 1.0, {"run 1": (3.0, np.inf)})
    slides = asked_for_mps2(study, run) > 0.6 * left * grip_mps2(truck)
    later = run.edges_s[1:] > 3.0
    assert (slides & ~later).any()
    assert (slides & later).any()
    assert (per_bin(study, tells_of_forces(study, run, [icy])) == ~(slides & later)).all()


def test_tires_that_give_out_early_do_so_all_along(study_of: Studies, truck: Packed) -> None:
    study = study_of()
    run, left = study.runs[0], 0.1
    place = tire_saturation.EFFECT.places(truck.vehicle)[0]
    worn = Hypothesis(tire_saturation.EFFECT, place, left - 1.0)
    slides = asked_for_mps2(study, run) > 0.6 * left * grip_mps2(truck)
    assert (per_bin(study, tells_of_forces(study, run, [worn])) == ~slides).all()
    assert tells_of_forces(study, run, [LAG]).all()


def test_a_lost_tire_whose_law_is_named_tells_of_no_wind_from_then_on(study_of: Studies) -> None:
    study = study_of()
    lost = replace(study.runs[0].recording, blowouts=(Blowout(3.0, ("steer_left",)),))
    run = replace(study.runs[0], recording=lost)
    place = Place(body="tractor", axle="steer", hub="steer_left", tire="steer_left")
    dragging = Hypothesis(blown_tire_drag.EFFECT, place, 2.0)
    tells = per_bin(study, tells_of_forces(study, run, [dragging]))
    assert (tells == (run.edges_s[1:] <= 3.0)).all()
    assert tells_of_forces(study, run, [LAG]).all()
    assert tells_of_forces(study, study.runs[0], [dragging]).all()


def test_a_lost_tire_turns_its_unit_and_no_other(study_of: Studies) -> None:
    """So a moment without a name on that unit is no finding, where baseline runs lost no tire."""
    study = study_of(baseline=True)
    at = study.train[0]
    lost = replace(study.runs[at].recording, blowouts=(Blowout(3.0, ("steer_left",)),))
    run = replace(study.runs[at], recording=lost)
    turned, other = (Hypothesis(yaw_moment.WITH_ROLL, Place(body=unit), 0.1)
                     for unit in ("tractor", "trailer"))
    drag = Hypothesis(aerodynamic_drag.EFFECT, Place(body="tractor"), 2.0)
    assert (per_bin(study, tells_of(study, run, turned)) == (run.edges_s[1:] <= 3.0)).all()
    assert tells_of(study, run, other).all()
    assert tells_of(study, run, drag).all()
    assert tells_of(study, study.runs[at], turned).all()
    assert tells_of(study_of(), run, turned).all()  # no baseline run to be compared with
