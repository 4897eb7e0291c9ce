"""Acceptance: what is named, what its rivals are, and what the holdout refuses."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.case.study import Progress, Study
from truck_blowout_sim.diagnosis.effects import LIBRARY
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.ranked import Ranked
from truck_blowout_sim.diagnosis.fit.scatter import Chance, Scatter
from truck_blowout_sim.diagnosis.name import candidates
from truck_blowout_sim.diagnosis.name import search as naming
from truck_blowout_sim.diagnosis.name.judging import (
    ODDS,
    POSITIVE,
    Found,
    excess_of,
    not_taken_back,
    slack,
)
from truck_blowout_sim.diagnosis.name.search import _Believed, _Tried, search
from truck_blowout_sim.diagnosis.name.shortlist import Round, shortlist
from truck_blowout_sim.diagnosis.sensors import GateResult
from truck_blowout_sim.diagnosis.settings import Settings
from truck_blowout_sim.vehicle import Packed

Studies = Callable[..., Study]
SHORT = {"axle_misalignment", "brake_imbalance", "steering_compliance", "road_bank"}


@pytest.fixture(autouse=True)
def short_library(monkeypatch: pytest.MonkeyPatch) -> None:
    """Four effects at all their places: enough to choose wrongly from."""
    few = tuple(e for e in LIBRARY if e.name in SHORT)
    monkeypatch.setattr(candidates, "LIBRARY", few)


def names(found: Found) -> list[str]:
    return [r.hypothesis.effect.name for r in found.named]


TURNED = {"axle.trailer_1.misalignment_rad": 0.02}


def test_a_turned_axle_is_named(study_of: Studies) -> None:
    study = study_of(TURNED, holdout=TURNED)
    found = search(study, most=1)
    assert names(found) == ["axle_misalignment"]
    assert found.named[0].hypothesis.place.axle == "trailer_1"
    assert found.rivals[0][0] is found.named[0]
    best = found.named[0]
    assert all(r.delta > best.delta - slack(best) for r in found.rivals[0])
    assert found.chi2_after < found.chi2_null
    assert sum(p.chi2 for p in found.after) < sum(p.chi2 for p in found.before)
    assert "accepted" in {trial.fate.rule for trial in found.tried
                          if trial.ranked.hypothesis.key == best.hypothesis.key}


@pytest.mark.parametrize(("sound", "episode_s", "baseline", "more"), [
    (True, 20.0, False, 0.0), (False, 20.0, False, ODDS),  # a run of 7 s is one episode
    (True, 2.0, False, POSITIVE), (False, 2.0, False, ODDS), (True, 2.0, True, 0.0)])
def test_beside_a_correction_and_in_one_long_log_more_than_chance_is_asked(
    study_of: Studies, monkeypatch: pytest.MonkeyPatch, sound: bool, episode_s: float,
    baseline: bool, more: float
) -> None:
    asked: list[float] = []

    def watched(study: Study, named: Sequence[Hypothesis], progress: Progress | None,
                further: float, placed: Sequence[Sequence[Hypothesis]]) -> Round:
        this = shortlist(study, named, progress, further, placed)
        asked.append(this.chance.asked - replace(this.chance, further=0.0).asked)
        return this

    monkeypatch.setattr("truck_blowout_sim.diagnosis.name.search.shortlist", watched)
    study = study_of(TURNED, holdout=TURNED, baseline=baseline)
    study = replace(study, settings=replace(study.settings, episode_s=episode_s))
    found = search(study, most=2, sound=sound)
    assert len(found.named) <= 1
    assert asked == pytest.approx([more] * (1 + len(found.named)))


def test_what_does_not_predict_the_holdout_is_refused(study_of: Studies, truck: Packed) -> None:
    weak = {"hub.trailer_2_left.brake_gain": 0.3 * truck["hub.trailer_2_left.brake_gain"]}
    found = search(study_of(weak, holdout={}, baseline=True), most=1)
    assert "brake_imbalance" not in names(found)
    fates = {trial.ranked.hypothesis.key: trial.fate for trial in found.tried}
    fate = fates["brake_imbalance", "trailer_2_left"]
    assert fate.rule == "support"  # unseen runs vote
    assert fate.value < fate.limit


def test_where_nothing_is_missing_nothing_is_named_and_every_reason_is_given(
    study_of: Studies,
) -> None:
    found = search(study_of(holdout={}))
    assert found.named == []
    assert found.rivals == []
    assert found.chi2_after == found.chi2_null
    assert found.tried
    assert all(str(trial.fate) for trial in found.tried)


def test_the_same_case_gives_the_same_answer_bit_by_bit(study_of: Studies) -> None:
    first, second = (search(study_of(TURNED), most=1) for _ in range(2))
    assert [(t.ranked.hypothesis.key, t.ranked.hypothesis.amount, t.ranked.delta, t.fate)
            for t in first.tried] == [
        (t.ranked.hypothesis.key, t.ranked.hypothesis.amount, t.ranked.delta, t.fate)
        for t in second.tried]


def test_an_instrument_that_the_search_takes_back_was_none(truck: Packed) -> None:
    def named(name: str) -> Ranked:
        effect = next(e for e in LIBRARY if e.name == name)
        return Ranked(Hypothesis(effect, effect.places(truck.vehicle)[0], 0.1), 1e4, 0.01)

    zero, gain = SimpleNamespace(name="steering_angle_offset"), SimpleNamespace(name="speed_scale")
    gate = cast(GateResult, SimpleNamespace(findings=(zero, gain)))
    assert not_taken_back(gate, Found()) == (zero, gain)
    assert not_taken_back(gate, Found(named=[named("axle_misalignment")])) == (zero, gain)
    assert not_taken_back(gate, Found(named=[named("steering_angle_offset")])) == (gain,)


def test_little_left_leaves_room_for_rivals(study_of: Callable[..., Study]) -> None:
    """Less than is usual makes no explanation the only one."""
    study = study_of()
    best = Ranked(None, 800.0, 0.1, refitted=True, support=20.0)  # type: ignore[arg-type]
    little, much = (slack(best, excess_of(study, Found(chi2_after=left))) for left in (0.0, 1e6))
    assert little == slack(best) == pytest.approx(ODDS * 800.0 / 20.0)
    assert much == pytest.approx(0.4 * 800.0)  # all that explain three fifths as much


def test_what_is_supported_as_well_stays_an_alias_of_what_explains_more(truck: Packed) -> None:
    turned, bank = (
        Hypothesis(effect, effect.places(truck.vehicle)[0], 0.01) for effect in (
            next(e for e in LIBRARY if e.name == name) for name in (
                "axle_misalignment", "road_bank")))
    best = Ranked(turned, 500.0, 1.0, refitted=True, support=9.0)
    for support, asked, aliases in ((18.0, 14.0, 2), (8.0, 7.0, 1), (12.0, 14.0, 1)):
        other = Ranked(bank, 250.0, 1.0, refitted=True, support=support)
        found = _Tried([best, other], asked).rivals(best, {turned.key}, slack(best))
        assert len(found) == aliases


def test_a_lost_tire_that_explains_more_is_named_instead_of_what_was_asked_among_many(
    truck: Packed, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Few runs support little of what is far from linear, and its instants are paid for."""
    def ranked(name: str, delta: float, support: float, timed: bool = True) -> Ranked:
        effect = next(e for e in LIBRARY if e.name == name and bool(e.timed) is timed)
        times = {"run 1": (3.0, 4.0)} if timed else {}
        return Ranked(Hypothesis(effect, effect.places(truck.vehicle)[0], 0.1, times), delta, 1.0,
                      refitted=True, evidence=delta, support=support)

    def passes(_study: object, _found: object, _this: object, one: Ranked) -> _Believed:
        return _Believed(one, one.delta, [], ())

    monkeypatch.setattr(naming, "_believed", passes)
    chance = Chance(Scatter(np.ones(1)), 40.0, 0.01)
    assert chance.alone.asked < 10.0 < chance.asked
    lost, wind = ranked("secondary_blowout", 9000.0, 10.0), ranked("crosswind", 9000.0, 10.0)
    bank = ranked("road_bank", 2000.0, 40.0)
    stronger_wind = 30000.0  # set aside as what may be a trace of the bank; so may the lost tire be
    for other, passing, aside, named in (
            (lost, bank, 0.0, True), (lost, bank, stronger_wind, False), (wind, bank, 0.0, False),
            (lost, ranked("road_bank", 2000.0, 40.0, timed=False), 0.0, True),
            (wind, ranked("road_bank", 2000.0, 40.0, timed=False), 0.0, False),
            (replace(lost, support=0.5 * chance.alone.asked), bank, 0.0, False),
            (replace(lost, delta=1000.0, evidence=1000.0), bank, 0.0, False)):
        this = cast(Round, SimpleNamespace(ranked=(other, passing), chance=chance))
        more = naming._explaining_more(cast(Study, None), Found(), this, [passing], aside)
        assert [one.ranked for one in more] == ([other] if named else [])


@pytest.mark.parametrize(("support", "named"), [(8.0, True), (2.0, False)])
def test_what_ran_to_the_end_of_the_search_shows_that_something_is_missing(
    truck: Packed, few: Settings, monkeypatch: pytest.MonkeyPatch, support: float, named: bool
) -> None:
    """So a cause that explains more is asked as a single question."""
    def ranked(name: str, amount: float, delta: float, support: float) -> Ranked:
        effect = next(e for e in LIBRARY if e.name == name and not e.timed)
        return Ranked(Hypothesis(effect, effect.places(truck.vehicle)[0], amount), delta, 1.0,
                      refitted=True, evidence=delta, support=support)

    monkeypatch.setattr(naming, "_believed",
                        lambda _study, _found, _this, one: _Believed(one, one.delta, [], ()))
    monkeypatch.setattr(naming, "_named", lambda _study, _found, best, _fate: best.ranked)
    monkeypatch.setattr(naming, "excess_of", lambda _study, _found: 0.0)
    chance = Chance(Scatter(np.ones(1)), 40.0, 0.01)
    assert chance.alone.asked < 8.0 < chance.asked < 30.0
    end = ranked("yaw_moment", -1.0, 11000.0, 30.0)
    soft = ranked("steering_compliance", 8.0, 15000.0, support)
    this = cast(Round, SimpleNamespace(ranked=(soft, end), chance=chance))
    study = cast(Study, SimpleNamespace(settings=few))
    best, _ = naming._accept(study, Found(), this, [soft.hypothesis])
    assert best is (soft if named else None)
