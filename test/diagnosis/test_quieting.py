"""A law that takes away what training keeps beyond baseline runs is named by that alone."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from unittest.mock import patch

import pytest

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects import LIBRARY
from truck_blowout_sim.diagnosis.name import candidates, quieting, search
from truck_blowout_sim.diagnosis.name.judging import Found
from truck_blowout_sim.diagnosis.name.shortlist import shortlist
from truck_blowout_sim.diagnosis.name.trial import Fate

Studies = Callable[..., Study]
TURNED = {"axle.trailer_1.misalignment_rad": 0.02}
PUSHED = {"unit.trailer.probe_fy_n": 9000.0, "unit.trailer.probe_start_s": 2.4,
          "unit.trailer.probe_end_s": 4.4}


@pytest.fixture(autouse=True)
def short_library(monkeypatch: pytest.MonkeyPatch) -> None:
    few = tuple(e for e in LIBRARY if e.name in {"axle_misalignment", "steering_compliance"})
    monkeypatch.setattr(candidates, "LIBRARY", few)


def found_by_quieting(study: Study, sound: bool = True) -> Found:
    """A search in which scatter says of nothing that it is supported."""
    with patch.object(search, "weakness", lambda one, chance, strongest=0.0: Fate("support")):
        return search.search(study, most=1, sound=sound)


def test_what_takes_most_of_the_mismatch_away_is_found_with_its_share(study_of: Studies) -> None:
    study = study_of(TURNED, baseline=True)
    ranked = shortlist(study, [], None).ranked
    found = quieting.quieting(study, ranked)
    assert found[0].ranked.hypothesis.key == ("axle_misalignment", "trailer_1")
    assert 0.9 < found[0].share < 1.1
    assert all(one.share >= quieting.NAMING_SHARE for one in found)


def test_nothing_is_found_where_training_keeps_no_more_than_baseline(study_of: Studies) -> None:
    study = study_of(baseline=True)
    assert quieting.quieting(study, shortlist(study, [], None).ranked) == []


def test_without_baseline_runs_no_level_is_known(study_of: Studies) -> None:
    study = study_of(TURNED)
    assert quieting.quieting(study, shortlist(study, [], None).ranked) == []


def test_a_push_that_no_law_makes_stays_without_a_name(study_of: Studies) -> None:
    study = study_of(PUSHED, baseline=True)
    assert quieting.quieting(study, shortlist(study, [], None).ranked) == []


@pytest.mark.parametrize(("support", "named"), [(1.9, False), (2.1, True)])
def test_an_event_must_also_stand_out_of_its_own_force(
        study_of: Studies, support: float, named: bool) -> None:
    study = study_of(TURNED, baseline=True)
    ranked = shortlist(study, [], None).ranked
    best = max((r for r in ranked if r.refitted), key=lambda r: r.delta)
    steady = best.hypothesis.effect
    always = {study.runs[i].recording.name: (0.0, math.inf) for i in study.train}
    event = replace(best.hypothesis, effect=replace(steady, timed=lambda *_: {}), times=always)
    assert event.effect.adds_up
    assert not steady.adds_up
    weak, as_event = replace(best, support=0.0), replace(best, hypothesis=event, support=support)
    assert len(quieting.quieting(study, [weak])) == 1
    assert len(quieting.quieting(study, [as_event])) == named


def test_the_search_names_it_and_says_why(study_of: Studies) -> None:
    found = found_by_quieting(study_of(TURNED, baseline=True, holdout=TURNED))
    assert [r.hypothesis.key for r in found.named] == [("axle_misalignment", "trailer_1")]
    (fate,) = (t.fate for t in found.tried
               if t.ranked.hypothesis.key == found.named[0].hypothesis.key)
    assert fate.rule == "quiets"
    assert "of what training keeps beyond baseline runs" in str(fate)
    assert found.p_value <= found.more_by_chance < 0.01


def test_unseen_runs_may_refuse_it(study_of: Studies) -> None:
    assert found_by_quieting(study_of(TURNED, baseline=True, holdout={})).named == []


def test_beside_a_corrected_instrument_nothing_is_named_so(study_of: Studies) -> None:
    study = study_of(TURNED, baseline=True, holdout=TURNED)
    assert found_by_quieting(study, sound=False).named == []
