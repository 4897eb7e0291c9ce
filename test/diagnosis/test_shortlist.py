"""What is fitted anew in a round, and which form stands for an effect."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects import LIBRARY
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.ranked import Ranked
from truck_blowout_sim.diagnosis.fit.scatter import Chance, Scatter
from truck_blowout_sim.diagnosis.fit.shown import SCATTERS
from truck_blowout_sim.diagnosis.name.shortlist import _promising, best_forms
from truck_blowout_sim.diagnosis.result.parts import Place
from truck_blowout_sim.vehicle import load_vehicle

ASKED = 10.0
CHANCE = Chance(Scatter(np.eye(SCATTERS.size)[0]), 20.0, 0.009)


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


@pytest.mark.parametrize(("share", "fitted"), [(0.7, True), (0.5, False)])
def test_places_of_one_effect_that_are_alike_do_not_hide_an_alias(
    share: float, fitted: bool
) -> None:
    vehicle = load_vehicle("international_9400i_trailmobile")
    brake = next(e for e in LIBRARY if e.name == "brake_imbalance")
    fade = next(e for e in LIBRARY if e.name == "brake_fade")
    alike = [Ranked(Hypothesis(brake, place, -0.5), 0.0, 0.1, promise=1000.0 - k)
             for k, place in enumerate(brake.places(vehicle))]
    other = Ranked(Hypothesis(fade, fade.places(vehicle)[0], 0.5), 0.0, 0.1,
                   promise=1000.0 * share)
    chosen = _promising([*alike, other], CHANCE, 3)
    assert [one.hypothesis.effect.name for one in chosen] == (
        ["brake_imbalance"] * 3 + ["brake_fade"] * fitted)
