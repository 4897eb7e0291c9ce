"""Which form stands for an effect, and which events the scatter of the case explains."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects import LIBRARY
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.attribute import Ranked
from truck_blowout_sim.diagnosis.fit.scatter import Chance, Scatter
from truck_blowout_sim.diagnosis.fit.shown import SCATTERS
from truck_blowout_sim.diagnosis.fit.support import Beside
from truck_blowout_sim.diagnosis.name import shortlist
from truck_blowout_sim.diagnosis.name.shortlist import best_forms
from truck_blowout_sim.diagnosis.result.parts import Place

ASKED = 10.0


def grade(timing: str, delta: float, support: float, *, refitted: bool = True) -> Ranked:
    effect = next(e for e in LIBRARY if e.name == "road_grade" and e.timing == timing)
    return Ranked(Hypothesis(effect, Place(), -0.002), delta, 1e-4, refitted=refitted,
                  support=support)


@pytest.mark.parametrize(("event", "chosen"), [
    (grade("step", 270.0, 7.0), "always"),  # its free instants explain more and support nothing
    (grade("step", 270.0, 12.0), "step"),
    (grade("step", 270.0, 12.0, refitted=False), "always"),
])  # fmt: skip
def test_a_form_that_is_not_supported_hides_no_other(event: Ranked, chosen: str) -> None:
    found = best_forms([event, grade("always", 180.0, 22.0)], ASKED)
    assert [one.hypothesis.effect.timing for one in found] == [chosen]


def test_where_none_is_supported_the_one_that_explains_more_is_kept() -> None:
    found = best_forms([grade("always", 30.0, 3.0), grade("step", 60.0, 1.0)], ASKED)
    assert [one.delta for one in found] == [60.0]


def test_different_places_are_no_forms_of_each_other(
    study_of: Callable[..., Study]
) -> None:
    drag = next(e for e in LIBRARY if e.name == "aerodynamic_drag")
    places = drag.places(study_of().packed.vehicle)
    found = best_forms([Ranked(Hypothesis(drag, place, 0.5), 20.0 + k, 0.1, refitted=True,
                               support=12.0) for k, place in enumerate(places)], ASKED)
    assert len(found) == len(places) > 1
    assert [one.delta for one in found] == sorted((one.delta for one in found), reverse=True)


CHANCE = Chance(Scatter(np.eye(SCATTERS.size)[0]), 20.0, 0.009)  # 12.4 of many, 6.8 alone


def moved(amount: float, delta: float, support: float) -> Ranked:
    effect = next(e for e in LIBRARY if e.name == "payload_shift" and not e.variant)
    place = Place(body="trailer")
    return Ranked(Hypothesis(effect, place, amount, {"run": (1.0, 2.0)}), delta, 0.01,
                  refitted=True, support=support)


@pytest.mark.parametrize(("delta", "again", "left"), [
    (300.0, [8.0, 8.0], 30.0),  # beyond chance as a single question
    (300.0, [2.0, 2.0], 2.0),  # other hypotheses scatter as much
    (300.0, [7.0, -30.0], 7.0 - 2.0 * np.log(2.0)),  # of two forms one holds: their mean odds
    (7.0, [8.0, 8.0], 7.0),  # explains hardly more than its free instants
])  # fmt: skip
def test_an_event_must_stand_out_of_what_all_hypotheses_scatter(
    study_of: Callable[..., Study], monkeypatch: pytest.MonkeyPatch, delta: float,
    again: list[float], left: float
) -> None:
    asked = iter(again)
    monkeypatch.setattr(shortlist, "supported", lambda study, one, beside, chance: replace(
        one, support=next(asked)))
    study = study_of()
    found = [moved(0.1, delta, 30.0), moved(0.2, delta, 30.0), moved(0.3, delta, 3.0)]
    checked = shortlist._confirmed(study, found, Beside.of(study, (), study.models), CHANCE)
    assert [one.support for one in checked] == pytest.approx([left, left, 3.0], abs=1e-3)
