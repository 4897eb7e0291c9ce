"""What is missing shows in a run that was not fitted, and in no other."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.answer.cautions import worst_run
from truck_blowout_sim.diagnosis.answer.material import Material
from truck_blowout_sim.diagnosis.answer.outcome import answer
from truck_blowout_sim.diagnosis.answer.verdict import only_unseen, shows_force
from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.locate.wrench import Wrenches
from truck_blowout_sim.diagnosis.model.law import Law
from truck_blowout_sim.diagnosis.name.judging import Found, predict_with
from truck_blowout_sim.diagnosis.result.evidence import ForceHistory
from truck_blowout_sim.diagnosis.sensors import GateResult

NO_LAW = Law("trailer", (("1", 0.0),), "F_y = 0", 0.0, {})


@pytest.fixture
def calm(study_of: Callable[..., Study]) -> Material:
    """Nothing is missing in training; one unseen run was made like it."""
    study = study_of(baseline=True, holdout={})
    chi2 = study.projector().chi2(study.residual())
    _, predicted = predict_with(study, [])
    found = Found(models_null=list(study.models), chi2_null=chi2, chi2_after=chi2,
                  before=predicted, after=predicted)
    gate = cast(GateResult, SimpleNamespace(findings=(), notes=()))
    one = np.ones(6)
    force = ForceHistory("run 1", "trailer", np.arange(6.0), 0.0 * one, 5e3 * one, 0.0 * one,
                         200.0 * one, 200.0 * one, 1e3 * one)
    left = (Wrenches(force, 1.0, 1e3, 18, 3.0, 0.2),)
    return Material(study, found, gate, left, left, NO_LAW, {}, "a truck")


def keeping(material: Material, train: float, unseen: float) -> Material:
    """With so many squares a row left of training and of the unseen run; 1 of baseline."""
    runs = range(len(material.study.runs))
    squares = (*(1.0 if i in material.study.baseline else train for i in runs), unseen)
    other = replace(material)
    vars(other).update(squares=squares, squares_unnamed=squares)
    return other


@pytest.mark.parametrize(("train", "unseen", "only"), [
    (0.9, 1e4, True), (30.0, 1e4, False), (0.9, 1.1, False)])
def test_an_unseen_run_may_keep_more_than_training(
    calm: Material, train: float, unseen: float, only: bool
) -> None:
    some = keeping(calm, train, unseen)
    assert only_unseen(some) == only
    assert shows_force(some) == (train > 1.0)


def test_it_is_said_with_the_run_that_shows_it_and_no_law_of_a_force(calm: Material) -> None:
    some = keeping(calm, 0.9, 1e4)
    (unseen,) = calm.study.holdout
    assert worst_run(some)[0] == unseen.recording.name
    told = answer(some)
    assert told.verdict == "unknown"
    assert told.sentence.startswith("Training shows nothing unusual, but ")
    assert unseen.recording.name in told.sentence
    assert "100.0 times as much" in told.sentence
    assert "F_y" not in told.sentence
    assert told.evidence.equations == ()
    assert told.location.wrench is None
    assert answer(keeping(calm, 30.0, 1e4)).location.wrench is not None
    assert told.next_test == f"Diagnose again with {unseen.recording.name} among the training runs."
