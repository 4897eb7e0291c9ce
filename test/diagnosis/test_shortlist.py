"""Which form stands for an effect."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects import LIBRARY
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.attribute import Ranked
from truck_blowout_sim.diagnosis.name.shortlist import best_forms
from truck_blowout_sim.diagnosis.result.parts import Place

ASKED = 10.0


def grade(timing: str, delta: float, support: float, *, refitted: bool = True) -> Ranked:
    effect = next(e for e in LIBRARY if e.name == "road_grade" and e.timing == timing)
    return Ranked(Hypothesis(effect, Place(), -0.002), delta, 1e-4, refitted=refitted,
                  support=support)


@pytest.mark.parametrize(("event", "chosen"), [
    (grade("ramp", 270.0, 7.0), "always"),  # its free instants explain more and support nothing
    (grade("ramp", 270.0, 12.0), "ramp"),
    (grade("ramp", 270.0, 12.0, refitted=False), "always"),
])  # fmt: skip
def test_a_form_that_is_not_supported_hides_no_other(event: Ranked, chosen: str) -> None:
    found = best_forms([event, grade("always", 180.0, 22.0)], ASKED)
    assert [one.hypothesis.effect.timing for one in found] == [chosen]


def test_where_none_is_supported_the_one_that_explains_more_is_kept() -> None:
    found = best_forms([grade("always", 30.0, 3.0), grade("ramp", 60.0, 1.0)], ASKED)
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
