"""Which events the scatter of the case explains."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects import LIBRARY
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.beside import Beside
from truck_blowout_sim.diagnosis.fit.ranked import Ranked
from truck_blowout_sim.diagnosis.fit.scatter import Chance, Scatter
from truck_blowout_sim.diagnosis.fit.shown import SCATTERS
from truck_blowout_sim.diagnosis.name import events
from truck_blowout_sim.diagnosis.result.parts import Place
from truck_blowout_sim.vehicle import load_vehicle

CHANCE = Chance(Scatter(np.eye(SCATTERS.size)[0]), 20.0, 0.009)  # 12.4 of many, 6.8 alone


def moved(amount: float, delta: float, support: float) -> Ranked:
    effect = next(e for e in LIBRARY if e.name == "payload_shift" and not e.variant)
    place = Place(body="trailer")
    return Ranked(Hypothesis(effect, place, amount, {"run": (1.0, 2.0)}), delta, 0.01,
                  refitted=True, support=support)


def scanned(name: str, delta: float, support: float) -> Ranked:
    effect = next(e for e in LIBRARY if e.name == name and e.timed)
    place = next(p for p in effect.places(load_vehicle("international_9400i_trailmobile"))
                 if p.body != "trailer" or name != "crosswind")
    return Ranked(Hypothesis(effect, place, effect.amount.step, {"run 1": (1.0, 2.0)}), delta, 0.1,
                  support=support, evidence=delta)


def test_the_event_that_explains_most_is_fitted_though_others_scatter_less(
    study_of: Callable[..., Study], monkeypatch: pytest.MonkeyPatch
) -> None:
    study = study_of()
    found = [scanned("crosswind", 300.0, 20.0), scanned("payload_shift", 200.0, 50.0),
             scanned("secondary_blowout", 5000.0, 0.0), scanned("road_bank", 250.0, 0.0)]
    monkeypatch.setattr(events, "_scanned", lambda *_: found)
    monkeypatch.setattr(events, "_confirmed", lambda study, found, *_, **__: list(found))
    monkeypatch.setattr(events, "supported", lambda study, one, *_: one)
    for fit in ("refine_times", "refit", "fit_event"):
        monkeypatch.setattr(events, fit, lambda study, one, *_: replace(one, refitted=True))
    assert study.refits[1] == 2
    ranked = events.rank_events(study, Beside.of(study, (), study.models), 1e4, CHANCE, (), (),
                                None)
    assert {one.hypothesis.effect.name for one in ranked if one.refitted} == {
        "crosswind", "payload_shift", "secondary_blowout"}


@pytest.mark.parametrize(("left_open", "fitted"), [(1e4, True), (50.0, False)])
def test_a_loss_of_grip_that_shows_only_when_large_is_simulated_where_much_is_open(
    study_of: Callable[..., Study], monkeypatch: pytest.MonkeyPatch, left_open: float, fitted: bool
) -> None:
    """Brakes that use half of the grip do not show that a third of it is gone."""
    study = study_of()
    small = scanned("friction_change", 0.0, 0.0)
    small = replace(small, hypothesis=replace(small.hypothesis, times={}))
    other = replace(scanned("payload_shift", left_open, 0.0), refitted=True)
    large = replace(small, hypothesis=replace(small.hypothesis, amount=-0.85,
                                              times={"run 1": (2.0, np.inf)}))
    monkeypatch.setattr(events, "_scanned", lambda *_: [small])
    monkeypatch.setattr(events, "simulated_starts", lambda *_: [large])
    monkeypatch.setattr(events, "fitted_event", lambda study, one, *_: replace(
        one, delta=500.0, refitted=True))
    monkeypatch.setattr(events, "supported", lambda study, one, *_: one)
    chi2 = 1e4 + study.level * study.columns.shape[0]
    ranked = events.rank_events(study, Beside.of(study, (), study.models), chi2, CHANCE,
                                (other,), (), None)
    assert [one.hypothesis.amount for one in ranked if one.refitted] == ([-0.85] if fitted else [])


@pytest.mark.parametrize(("delta", "again", "unseen", "least", "trusted", "left"), [
    (300.0, [8.0, 8.0], 0.0, 0.0, True, 30.0),  # beyond chance as a single question
    (300.0, [2.0, 2.0], 0.0, 0.0, True, 2.0),  # other hypotheses scatter as much
    (300.0, [5.0, 5.0], 9.0, 0.0, True, 30.0),  # but unseen runs show the same event
    (300.0, [5.0, 5.0], 9.0, 0.0, False, 5.0),  # and so does a cause that acts all the time
    (300.0, [5.0, 5.0], 5.0, 0.0, True, 5.0),  # or not clearly enough
    (300.0, [2.0, 2.0], 40.0, 0.0, True, 2.0),  # a form of model that errs in all runs alike
    (300.0, [7.0, -30.0], 0.0, 0.0, True, 7.0 - 2.0 * np.log(2.0)),  # one of two forms: mean odds
    (7.0, [8.0, 8.0], 0.0, 0.0, True, 7.0),  # explains hardly more than its free instants
    (300.0, [8.0, 8.0], 9.0, 400.0, True, 0.0),  # something else explains ten times as much
])  # fmt: skip
def test_an_event_must_stand_out_of_what_all_hypotheses_scatter(
    study_of: Callable[..., Study], monkeypatch: pytest.MonkeyPatch, delta: float,
    again: list[float], unseen: float, least: float, trusted: bool, left: float
) -> None:
    asked = iter(again)
    monkeypatch.setattr(events, "supported", lambda study, one, beside, chance: replace(
        one, support=next(asked)))
    study = study_of()
    found = [replace(moved(amount, delta, support), unseen=unseen)
             for amount, support in ((0.1, 30.0), (0.2, 30.0), (0.3, 3.0))]
    checked = events._confirmed(study, found, Beside.of(study, (), study.models), CHANCE, least,
                                trusted)
    assert [one.support for one in checked] == pytest.approx([left, left, 3.0], abs=1e-3)
