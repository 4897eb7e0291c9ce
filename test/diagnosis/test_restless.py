"""A channel that moves on by itself is noticed; one that does so in baseline runs too is not."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.case.runs import Run
from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.diagnose import _material
from truck_blowout_sim.diagnosis.effort import QUICK
from truck_blowout_sim.diagnosis.locate.restless import unrest
from truck_blowout_sim.diagnosis.name.judging import Found
from truck_blowout_sim.diagnosis.sensors import GateResult

Studies = Callable[..., Study]
CHANNEL, SWING_RADPS = "trailer_yaw_rate_radps", 0.012


def swinging(run: Run) -> Run:
    """The trailer sways once in 1.7 s, whatever is done to the truck."""
    middles = 0.5 * (run.edges_s[1:] + run.edges_s[:-1])
    moved = run.measured.copy()
    moved[:, run.channels.index(CHANNEL)] += SWING_RADPS * np.sin(2.0 * np.pi * middles / 1.7)
    return replace(run, measured=moved)


def with_swing(study: Study, *roles: str) -> Study:
    runs = tuple(swinging(run) if run.role in roles else run for run in study.runs)
    return replace(study, runs=runs)


def test_a_trailer_that_sways_by_itself_is_noticed(study_of: Studies) -> None:
    found = unrest(with_swing(study_of(baseline=True), "train"), []).channel
    assert found is not None
    assert (found.body, found.channel) == ("trailer", CHANNEL)
    assert found.left == pytest.approx(SWING_RADPS / np.sqrt(2.0), rel=0.25)
    assert found.left > found.usual > 0.0
    assert found.evidence > 0.0
    assert "trailer's yaw rate" in found.sentence
    assert f"{found.left:.3g} rad/s" in found.equation


def test_a_calm_truck_has_no_restless_channel(study_of: Studies) -> None:
    calm = unrest(study_of(baseline=True), [])
    assert calm.channel is None
    assert calm.chance > 0.02


def test_what_the_baseline_runs_have_too_is_how_the_model_errs(study_of: Studies) -> None:
    assert unrest(with_swing(study_of(baseline=True), "train", "baseline"), []).channel is None


def test_without_baseline_runs_no_channel_is_called_restless(study_of: Studies) -> None:
    assert unrest(with_swing(study_of(), "train"), []).channel is None


@pytest.mark.parametrize("faults", [0, 1])
def test_beside_a_faulty_instrument_no_stand_and_no_unrest_is_asked_for(
    study_of: Studies, faults: int
) -> None:
    study = with_swing(study_of(baseline=True), "train")
    found = Found(models_null=list(study.models))
    gate = cast(GateResult, SimpleNamespace(findings=("a faulty gyro",) * faults, notes=()))
    told = _material(study, found, gate, "a truck", QUICK, None)
    assert (told.unrest.channel is None) == bool(faults)
    assert told.posture is None
