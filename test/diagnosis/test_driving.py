"""What is named is taken back where its vehicle, driven, predicts unseen runs worse."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects import LIBRARY
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.attribute import Ranked
from truck_blowout_sim.diagnosis.model.vehicle import diagnosed_truck
from truck_blowout_sim.diagnosis.name.driving import take_back
from truck_blowout_sim.diagnosis.name.judging import Found, predict_with
from truck_blowout_sim.diagnosis.name.trial import Fate, Trial
from truck_blowout_sim.diagnosis.prove.unseen import gained
from truck_blowout_sim.vehicle import Packed

Studies = Callable[..., Study]
DRAG = {"driveline.drag_n": 4000.0}


def named_drag(study: Study, truck: Packed, more: float = 2500.0) -> Found:
    """The case as the search leaves it: a drag of the driveline is named that training has."""
    effect = next(e for e in LIBRARY if e.name == "driveline_drag" and not e.variant)
    place = effect.places(truck.vehicle)[0]
    one = Ranked(Hypothesis(effect, place, more), 500.0, 1.0, refitted=True, support=50.0)
    found = Found(named=[one], rivals=[(one,)], tried=[Trial(one, Fate("accepted"))],
                  models_null=list(study.models))
    found.before = predict_with(study, [])[1]
    study.models, found.after = predict_with(study, [one.hypothesis])
    return found


def test_a_vehicle_that_drives_unseen_runs_better_keeps_its_name(
        study_of: Studies, truck: Packed) -> None:
    study = study_of(DRAG, holdout=DRAG)
    found = named_drag(study, truck)
    take_back(study, found, truck)
    assert [one.hypothesis.effect.name for one in found.named] == ["driveline_drag"]


def test_one_that_makes_no_channel_better_loses_it(study_of: Studies, truck: Packed) -> None:
    study = study_of(holdout={})
    found = named_drag(study, truck, 400.0)
    usual = list(found.models_null)
    take_back(study, found, truck)
    assert not found.named
    assert not found.rivals
    assert found.tried[0].fate.rule == "driven"
    assert found.tried[0].fate.value < 0.0
    assert found.chi2_after == pytest.approx(study.projector().chi2(study.residual()))
    for model, before in zip(study.models, usual, strict=True):
        assert (model == before).all()


def test_without_unseen_runs_nothing_speaks_against_a_name(
        study_of: Studies, truck: Packed) -> None:
    study = study_of(DRAG)
    found = named_drag(study, truck)
    take_back(study, found, truck)
    assert len(found.named) == 1


def test_the_truth_gains_over_the_sheet_by_the_logarithm_of_its_squares(
        study_of: Studies, truck: Packed) -> None:
    study = study_of(DRAG, holdout=DRAG)
    true = truck.with_values(DRAG)
    assert gained(study, [0], truck, true).all_channels > 100.0
    assert gained(study, [0], truck, true).best > 0.7
    assert gained(study, [0], true, truck).all_channels == pytest.approx(
        -gained(study, [0], truck, true).all_channels)
    assert gained(study, [0], truck, truck).all_channels == 0.0


def test_the_driven_truck_goes_no_farther_than_simulation_confirms(
        study_of: Studies, truck: Packed) -> None:
    study = study_of({"unit.trailer.mass_kg": 1.03 * truck["unit.trailer.mass_kg"]})
    one = diagnosed_truck(study, truck, study.models, ())
    by = one.packed["unit.trailer.mass_kg"] / truck["unit.trailer.mass_kg"] - 1.0
    assert 0.0 <= by <= 0.06
    assert all(source for source in one.sources.values())
