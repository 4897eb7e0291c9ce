"""What the page overlays, what the sentence is about first, and the cells of its maps."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest

from truck_blowout_sim.diagnosis.answer.evidence import maps, overlays
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


@pytest.mark.parametrize(("bin_s", "bins"), [(0.1, 5), (0.2, 2), (2.0, 1)])
def test_a_cell_of_a_map_lasts_half_a_second_as_nearly_as_bins_allow(
        study_of: Callable[..., Study], bin_s: float, bins: int) -> None:
    usual = study_of(baseline=True)
    study = replace(usual, settings=replace(usual.settings, bin_s=bin_s))
    drawn = maps(study, Found(models_null=list(study.models)))
    assert len(drawn) == len(study.train)
    for one, index in zip(drawn, study.train, strict=True):
        cells = study.runs[index].measured.shape[0] // bins
        assert one.before.shape == one.after.shape == (len(one.channels), cells)
        assert one.time_s.tolist() == study.runs[index].edges_s[::bins][:cells + 1].tolist()
