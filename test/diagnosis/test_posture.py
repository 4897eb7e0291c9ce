"""A body that stands turned is named, and by how much; one that is rolled by a bank is not."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects import LIBRARY, secondary_blowout
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.models import models_at
from truck_blowout_sim.diagnosis.fit.ranked import Ranked
from truck_blowout_sim.diagnosis.fit.refit import refit
from truck_blowout_sim.diagnosis.fit.scatter import SCATTERS, Scatter
from truck_blowout_sim.diagnosis.locate.posture import postures, turned_body
from truck_blowout_sim.recordings import Blowout
from truck_blowout_sim.vehicle import Packed

Studies = Callable[..., Study]
STILL = Scatter(np.eye(SCATTERS.size)[0])  # no amount scatters


def leaning(study_of: Studies, by_rad: float, baseline: bool = True) -> Study:
    """The tractor's springs let it lean to one side in training: its gyro shows it, no force."""
    study = study_of(baseline=baseline)
    runs = list(study.runs)
    run = runs[study.train[0]]
    turned = run.measured.copy()
    turned[:, run.channels.index("tractor_roll_rad")] += by_rad
    runs[study.train[0]] = replace(run, measured=turned)
    return replace(study, runs=tuple(runs))


@pytest.mark.parametrize(("by_rad", "low"), [(0.012, "right"), (-0.02, "left")])
def test_a_body_that_stands_turned_is_named_and_by_how_much(
    study_of: Studies, by_rad: float, low: str
) -> None:
    found = turned_body(leaning(study_of, by_rad), [], STILL)
    assert found is not None
    assert (found.body, found.angle) == ("tractor", "roll")
    assert found.turned_rad == pytest.approx(by_rad, rel=0.15)
    assert abs(found.turned_rad - by_rad) < 4.0 * found.sigma
    assert f"{low} low" in found.sentence
    assert f"{found.turned_rad:+.5f}" in found.equation


def test_without_a_baseline_the_instrument_may_sit_crooked(study_of: Studies) -> None:
    assert turned_body(leaning(study_of, 0.02, baseline=False), [], STILL) is None


def test_a_truck_that_stands_as_modelled_is_left_alone(study_of: Studies) -> None:
    study = study_of(baseline=True)
    assert turned_body(study, [], STILL) is None
    assert {(p.body, p.angle) for p in postures(study, [], STILL)} == {
        (body, "roll") for body in ("tractor", "trailer")}  # the only angles recorded


def test_a_bank_that_is_named_turns_nothing(study_of: Studies, truck: Packed) -> None:
    effect = next(e for e in LIBRARY if e.name == "road_bank" and not e.variant)
    named = Hypothesis(effect, effect.places(truck.vehicle)[0], 0.02)
    study = study_of(dict(effect.values(truck, named.place, 0.02)), baseline=True)
    chi2 = study.projector().chi2(study.residual())
    named = refit(study, Ranked(named, 0.0, 100.0), chi2).hypothesis
    for i, model in models_at(study, [named], ())[0].items():
        study.models[i] = model
    assert turned_body(study, [named], STILL) is None


def test_a_body_that_leans_on_a_flat_tire_stands_on_its_springs(study_of: Studies) -> None:
    study = leaning(study_of, 0.012)
    i = study.train[0]
    run = study.runs[i]
    flat = replace(run, recording=replace(run.recording, blowouts=(Blowout(2.0, ("steer_left",)),)))
    blown = replace(study, runs=tuple(flat if k == i else r for k, r in enumerate(study.runs)))
    assert turned_body(blown, [], STILL) is None
    place = next(p for p in secondary_blowout.EFFECT.places(study.packed.vehicle) if p.tire)
    assert turned_body(study, [Hypothesis(secondary_blowout.EFFECT, place, 1.0)], STILL) is None
