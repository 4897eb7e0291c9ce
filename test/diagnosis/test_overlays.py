"""What the page overlays: first what the sentence is about, then what changed most."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from truck_blowout_sim.diagnosis.answer.evidence import overlays
from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.name.judging import Found


@pytest.mark.parametrize("about", ["trailer_yaw_rate_radps", "tractor_roll_rad"])
def test_what_the_sentence_is_about_comes_first(
        study_of: Callable[..., Study], about: str) -> None:
    study = study_of(baseline=True)
    found = Found(models_null=list(study.models))
    drawn = overlays(study, found, [about])
    assert [one.channel for one in drawn].count(about) == len(study.train)
    assert drawn[0].channel == about
    usual = overlays(study, found)
    assert len(usual) == len(drawn)
    assert len({one.channel for one in usual}) == len({one.channel for one in drawn})
