"""Where the model is believed less: near the limit of grip."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.case.trust import grip_used

Studies = Callable[..., Study]


def test_grip_is_used_the_more_the_less_there_is(study_of: Studies) -> None:
    study = study_of()
    usual = grip_used(study)
    assert 0.02 < usual < 0.5
    slippery = replace(study, packed=study.packed.with_values({"world.friction_scale": 0.5}))
    assert grip_used(slippery) == pytest.approx(2.0 * usual)
    icy = replace(study, packed=study.packed.with_values({"world.friction_scale": 0.01}))
    assert grip_used(icy) == 1.0


def test_without_the_yaw_rate_no_turn_counts(study_of: Studies) -> None:
    study = study_of()
    runs = tuple(replace(run, channels=tuple(
        name.replace("yaw_rate", "other") for name in run.channels)) for run in study.runs)
    assert grip_used(replace(study, runs=runs)) == 0.0
